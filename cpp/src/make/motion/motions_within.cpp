// SPDX-License-Identifier: MIT
#include "motion/motions_within.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>

#include "base/rounding.hpp"
#include "motion/contacts.hpp"
#include "motion/cycle.hpp"
#include "motion/gait_scale.hpp"
#include "motion/in_place.hpp"
#include "motion/treading.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

// The bone tips of a clip in all of its frames, in the world: it stays where it is.
class Tips {
 public:
  Tips(const Kinematics& kinematics, const Clip& clip) : bones_(measured_bones(kinematics.skeleton())) {
    PosedBones posed(kinematics.bones());
    for (int f = 0; f < clip.frames; ++f) {
      world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
      for (const int b : bones_)
        tips_.emplace_back(posed.heads[b] + posed.rotations[b] * kinematics.skeleton().tips[b]);
    }
  }

  // The sum of their distances, m; where that is more than `most`, any number that is.
  double distance(int a, int b, double most = std::numeric_limits<double>::infinity()) const {
    const std::size_t count = bones_.size();
    double sum = 0;
    for (std::size_t i = 0; i < count && sum <= most; ++i) sum += (tips_[a * count + i] - tips_[b * count + i]).norm();
    return sum;
  }

 private:
  std::vector<int> bones_;
  std::vector<Vector3> tips_;
};

// How fast the fastest and the slowest foot go in each frame, seen from the hips and in the world, m/s of a character
// of 1.8 m.
struct FootSpeeds {
  std::vector<double> slowest_from_hips, fastest;

  FootSpeeds(const Kinematics& kinematics, const Clip& clip) {
    const double scale = gait_scale(standard_scale(kinematics.skeleton())) * clip.rate;
    const std::size_t hips = kinematics.skeleton().roles.hips;
    const std::vector<LegRoles> legs = legs_with_feet(kinematics.skeleton().roles);
    PosedBones posed(kinematics.bones()), before(kinematics.bones());
    for (int f = 0; f < clip.frames; ++f, std::swap(posed, before)) {
      world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
      if (f == 0) continue;
      double slow = std::numeric_limits<double>::infinity(), fast = 0;
      for (const LegRoles& leg : legs) {
        const auto way = [&](int bone) {
          return Vector3(posed.heads[bone] + posed.rotations[bone] * kinematics.skeleton().tips[bone] -
                         before.heads[bone] - before.rotations[bone] * kinematics.skeleton().tips[bone]);
        };
        const Vector3 gone = way(leg.foot);
        slow = std::min(slow, (gone - (posed.heads[hips] - before.heads[hips])).norm() * scale);
        fast = std::max(fast, gone.norm() * scale);
      }
      slowest_from_hips.push_back(slow), fastest.push_back(fast);
    }
  }
};

// Of a clip on the spot.
class Timeline {
 public:
  Timeline(const Kinematics& kinematics, const Clip& clip)
      : kinematics_(kinematics), clip_(clip), tips_(kinematics, clip), feet_(kinematics, clip) {
    for (int f = 0; f + 1 < clip.frames; ++f) steps_.push_back(tips_.distance(f, f + 1));
    for (const double speed : feet_.slowest_from_hips) moved_.push_back(moved_.back() + speed);
  }

  std::vector<Span> motions() const {
    if (goes_steadily(clip_) && stands({}, shortest_round()).empty()) return {};
    const std::vector<Span> rounds = gaits();
    std::vector<Span> found = joined(rounds);
    if (found.empty()) return found;
    int shortest = clip_.frames;
    for (const Span& gait : found) shortest = std::min(shortest, gait.last - gait.first);
    const std::vector<Span> stands = this->stands(found, shortest);
    if (found.size() + stands.size() == 1 || is_one_gait(rounds, stands)) return {};
    found.insert(found.end(), stands.begin(), stands.end());
    std::sort(found.begin(), found.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
    return found;
  }

 private:
  struct Round {
    Span span;
    double gap = 0;  // between its ends, in frames

    // The shorter and the more surely closed, the more likely it is one motion, and not that and what is around.
    double length() const { return (span.last - span.first) * (1 + gap) * (1 + gap); }
  };

  // Whether it ends as near to where it begins as a frame is to the next, nearer than frames beside, goes on as it came
  // and not back, and both feet move in it.
  std::optional<Round> round(int first, int last) const {
    if (moved_[last] - moved_[first] < kMoving * (last - first)) return std::nullopt;
    const double most = std::max(steps_[first], steps_[last - 1]);
    const double gap = tips_.distance(first, last, most);
    if (gap > most || most == 0) return std::nullopt;
    if (2 * tips_.distance(first + 1, last - 1, most) < most) return std::nullopt;
    for (int a = std::max(first - 1, 0); a <= first + 1; ++a) {
      for (int b = last - 1; b <= std::min(last + 1, clip_.frames - 1); ++b) {
        if (tips_.distance(a, b, gap) < gap - kFileRounding) return std::nullopt;
      }
    }
    return Round{{first, last}, gap / most};
  }

  int shortest_round() const { return std::max(4, static_cast<int>(std::lround(kShortestCycle * clip_.rate))); }

  // In the order of their lengths, none of which is less than the frames of its round. What cannot be apart from a gait
  // that is found is not looked at.
  std::vector<Span> gaits() const {
    const auto before = [](const Round& a, const Round& b) {
      return std::make_tuple(a.length(), a.span.first, a.span.last) <
             std::make_tuple(b.length(), b.span.first, b.span.last);
    };
    const auto after = [&](const Round& a, const Round& b) { return before(b, a); };
    std::priority_queue<Round, std::vector<Round>, decltype(after)> rounds(after);
    std::vector<Span> gaits;
    std::vector<int> most(clip_.frames, clip_.frames - 1), firsts(clip_.frames);  // the last frame from each first one
    std::iota(firsts.begin(), firsts.end(), 0);
    const auto look = [&](double shorter) {
      for (; !rounds.empty() && rounds.top().length() < shorter; rounds.pop()) {
        const Span span = rounds.top().span;
        if (span.last > most[span.first] || !goes(span)) continue;
        gaits.push_back(span);
        for (int f = 0; f < span.last; ++f) most[f] = f < span.first ? std::min(most[f], span.first) : -1;
      }
    };
    for (int frames = shortest_round(); !firsts.empty(); ++frames) {
      const auto ends = [&](int first) { return first + frames > most[first]; };
      firsts.erase(std::remove_if(firsts.begin(), firsts.end(), ends), firsts.end());
      for (const int first : firsts) {
        if (const auto found = round(first, first + frames)) rounds.push(*found);
      }
      look(frames + 1);
    }
    look(std::numeric_limits<double>::infinity());
    return gaits;
  }

  // Whether it goes from end to end as its feet tell, faster and slower, and does not stop or was not drawn: no
  // captured round ends where it began.
  bool is_one_gait(const std::vector<Span>& rounds, const std::vector<Span>& stands) const {
    const std::optional<FeetWay> whole = find_feet_way(kinematics_, clip_);
    if (!whole || whole->by_legs) return false;
    return stands.empty() || !std::all_of(rounds.begin(), rounds.end(), [&](const Span& round) {
             return cycle_of(kinematics_, part(clip_, round.first, round.last)) == round.last - round.first;
           });
  }

  // Rounds of as many frames that follow each other are one gait.
  static std::vector<Span> joined(std::vector<Span> rounds) {
    std::sort(rounds.begin(), rounds.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
    std::vector<Span> joined;
    int frames = 0;  // of the round before
    for (const Span& round : rounds) {
      const bool goes_on = !joined.empty() && joined.back().last + 1 >= round.first;
      if (goes_on && round.last - round.first == frames) {
        joined.back().last = round.last;
      } else {
        joined.push_back(round);
      }
      frames = round.last - round.first;
    }
    return joined;
  }

  bool goes(const Span& span) const { return goes_steadily(without_held_end(part(clip_, span.first, span.last))); }

  bool goes_steadily(const Clip& clip) const {
    const std::optional<FeetWay> way = find_feet_way(kinematics_, clip);
    if (!way || way->by_legs) return false;
    const Vector2 mean = mean_velocity(way->velocities);
    return std::all_of(way->velocities.begin(), way->velocities.end(), [&](const Vector2& velocity) {
      return 2 * velocity.dot(mean) >= mean.squaredNorm() && velocity.squaredNorm() <= 4 * mean.squaredNorm();
    });
  }

  // Of at least so many frames.
  std::vector<Span> stands(const std::vector<Span>& gaits, int least) const {
    std::vector<char> still(clip_.frames - 1, 0);
    for (int f = 0; f + 1 < clip_.frames; ++f) still[f] = feet_.fastest[f] < kMoving;
    for (const Span& gait : gaits) std::fill(still.begin() + gait.first, still.begin() + gait.last, 0);
    std::vector<Span> stands;
    for (int f = 0; f + 1 < clip_.frames; ++f) {
      if (!still[f]) continue;
      int last = f;
      while (last + 1 < clip_.frames && still[last]) ++last;
      if (last - f >= least) stands.push_back({f, last});
      f = last;
    }
    return stands;
  }

  const Kinematics& kinematics_;
  const Clip& clip_;
  Tips tips_;
  FootSpeeds feet_;
  std::vector<double> steps_;        // m, from each frame to the next
  std::vector<double> moved_ = {0};  // the sum up to each frame of how fast the slower foot goes
};

}  // namespace

std::vector<Span> motions_within(const Kinematics& kinematics, const Clip& clip) {
  if (legs_with_feet(kinematics.skeleton().roles).empty() || !stays_mostly(kinematics, clip)) return {};
  return Timeline(kinematics, clip).motions();
}

}  // namespace fragmotion
