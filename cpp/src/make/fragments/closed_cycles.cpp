// SPDX-License-Identifier: MIT
#include "fragments/closed_cycles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "base/quantile.hpp"
#include "fragments/gait_cycle.hpp"
#include "fragments/gait_heights.hpp"
#include "fragments/speed_range.hpp"
#include "motion/contacts.hpp"
#include "motion/cycle.hpp"

namespace fragmotion {
namespace {

constexpr double kClosed = 3 / kTunedReach;  // m a metre of reach between the ends of a cycle

Control mean(const Control& a, const Control& b, double w) {
  return {a.x + w * (b.x - a.x), a.y + w * (b.y - a.y), a.turn + w * (b.turn - a.turn), a.jump + w * (b.jump - a.jump)};
}

ClosedCycle backward(const ClosedCycle& cycle) {
  const Control& ev = cycle.evident;
  return {cycle.clip, cycle.end, cycle.begin, cycle.image, {-ev.x, -ev.y, -ev.turn, ev.jump}, cycle.flaw};
}

// How far a fragment's poses get from its first, m, but for the way of all.
double farthest_within(const Trajectories& t, int fragment) {
  const std::vector<float> rows = t.whole.read(fragment);
  const auto place = [&](int pose, int tip) {
    const std::size_t at = static_cast<std::size_t>(pose) * t.tips + tip, stride = t.whole.stride();
    return Vector3{rows[at], rows[at + stride], rows[at + 2 * stride]};
  };
  double farthest = 0;
  for (int pose = 1; pose < kPoses; ++pose) {
    Vector3 way = Vector3::Zero();
    for (int tip = 0; tip < t.tips; ++tip) way += (place(pose, tip) - place(0, tip)) / t.tips;
    double sum = 0;
    for (int tip = 0; tip < t.tips; ++tip) sum += (place(pose, tip) - place(0, tip) - way).norm();
    farthest = std::max(farthest, sum);
  }
  return farthest;
}

// The fragments of mirror images, by the clip and the frame in which they begin.
std::map<std::pair<int, int>, int> beginnings(const FragmentPool& pool, std::size_t takes) {
  std::map<std::pair<int, int>, int> found;
  for (std::size_t f = 0; f < pool.fragments.size(); ++f) {
    const Fragment& fragment = pool.fragments[f];
    const bool image = fragment.origin == Origin::mirrored && fragment.clip >= static_cast<int>(takes);
    if (image) found[{fragment.clip - static_cast<int>(takes), fragment.begin}] = static_cast<int>(f);
  }
  return found;
}

// The poses of a gait at their frames, from there on.
void append_poses(const Kinematics& kinematics, const GaitCycle& gait, const CharacterFrame& from, Clip& to) {
  const CharacterFrame first = gait.poses[0].frame;
  const double turn = from.heading - first.heading;
  for (const BodyPose& pose : gait.poses) {
    append(kinematics, to,
           {from.position + turned(pose.frame.position - first.position, turn), pose.frame.heading + turn}, pose);
  }
}

// Adds the markers of frames begin .. end of a clip, from a frame of another on.
void append_markers(const Clip& from, int begin, int end, int at, std::vector<Marker>& to) {
  for (Marker marker : markers_in_rounds(from.markers, begin, end - begin, end - begin)) {
    marker.frame += at;
    to.push_back(std::move(marker));
  }
}

}  // namespace

double effort_of_direction(const Control& gait, const Control& control) {
  return std::abs(wrapped(std::atan2(control.y, control.x) - std::atan2(gait.y, gait.x))) / (kPi / 4);
}

double effort_of_speed(double faster) {
  const double times = std::log(faster) / std::log(1.5);
  return times > 0 ? times * times : -times;
}

namespace {

// The directions in which gaits go.
class Ways {
 public:
  Ways(const std::vector<ClosedCycle>& cycles, double moving) : moving_(moving) {
    for (const ClosedCycle& cycle : cycles) {
      if (cycle.evident.speed() <= moving) continue;
      for (const double round : {-2 * kPi, 0.0, 2 * kPi}) angles_.push_back(round + angle_of(cycle.evident));
    }
    std::sort(angles_.begin(), angles_.end());
  }

  // Whether one goes the way of another gait, or that stands.
  bool hold(const Control& gait) const {
    const double angle = angle_of(gait);
    const auto near = std::lower_bound(angles_.begin(), angles_.end(), angle - kSameDirection);
    return gait.speed() > moving_ && near != angles_.end() && *near <= angle + kSameDirection;
  }

 private:
  static double angle_of(const Control& gait) { return std::atan2(gait.y, gait.x); }

  double moving_;
  std::vector<double> angles_;  // sorted, and each a round before and after, too
};

// Looks for the cycles of a pool.
struct CycleSearch {
  const FragmentPool& pool;
  const Trajectories& trajectories;
  const GaitHeights usual;
  double moving;                                         // m/s
  std::map<std::pair<int, int>, int> images;             // beginnings()
  std::array<std::vector<ClosedCycle>, 2> whole, steps;  // of the walk and of the run

  // m a metre of reach.
  double gap(int last, int again) const {
    return double{transition_distance(trajectories, last, again)} / trajectories.reach;
  }

  // Whether fragments first .. last come back to where the first begins, twice as near as they were on the way: the
  // pose of who limps slowly is near to what it was for long.
  bool closes(int first, int last) const {
    const double end = gap(last, first);
    if (end > kClosed) return false;
    for (int f = first; f < last; ++f) {
      if (2 * end <= gap(f, first)) return true;
    }
    return 2 * end <= farthest_within(trajectories, first) / trajectories.reach;
  }

  // Where fragments first .. last lead to the beginning of that one.
  void add(ClosedCycle cycle, int first, int last, int again, std::array<std::vector<ClosedCycle>, 2>& to) const {
    const double gap = this->gap(last, again), speed = cycle.evident.speed();
    if (gap > kClosed) return;
    cycle.flaw += gap + usual.excess(first, last, speed);
    to[usual.gait_at(speed)].push_back(cycle);
  }

  // Of a step the gait goes straight on.
  void add_step(const ClosedCycle& cycle, int first, int last) {
    const auto image = images.find({cycle.clip, cycle.begin});
    const Control straight{0, cycle.evident.y, 0, cycle.evident.jump};
    if (image == images.end() || straight.speed() <= moving) return;
    const double bent = effort_of_direction(cycle.evident, straight) + effort_of_turn(cycle.evident, straight);
    add({cycle.clip, cycle.begin, cycle.end, pool.fragments[image->second].clip, straight, bent / kFlawed}, first, last,
        image->second, steps);
  }

  // Tells of the fragments from `first` to each further one of its take, while that is wanted: the cycle that they
  // would be, the last of them, and the seconds that they last.
  template <typename Each>
  void from(int first, Each each) const {
    ClosedCycle cycle;
    double seconds = 0;
    for (int last = first; last < static_cast<int>(pool.fragments.size()); ++last) {
      const Fragment& f = pool.fragments[last];
      if (last > first && (f.clip != cycle.clip || f.begin != cycle.end)) break;
      const double length = pool.seconds(f), share = length / (seconds += length);
      if (last == first) cycle.clip = f.clip, cycle.begin = f.begin;
      cycle.end = f.end;
      cycle.evident = mean(cycle.evident, f.evident, share);
      if (!each(cycle, last, seconds)) break;
    }
  }

  // All that begin with a fragment.
  void look(int first) {
    from(first, [&](const ClosedCycle& cycle, int last, double seconds) {
      if (seconds > kLongestCycle) return false;
      const bool stands = cycle.evident.speed() <= moving;
      if (seconds >= kShortestCycle && (stands || closes(first, last))) add(cycle, first, last, first, whole);
      if (2 * seconds >= kShortestCycle && 2 * seconds <= kLongestCycle) add_step(cycle, first, last);
      return true;
    });
  }

  double seconds(const ClosedCycle& cycle) const { return (cycle.end - cycle.begin) / pool.clips[cycle.clip].rate; }

  // Who goes round sooner than half of the gait do, who go round once, is about to turn, to stop or to start.
  void blame_haste(std::vector<ClosedCycle>& cycles) const {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < cycles.size(); ++i) {
      const bool once = i == 0 || cycles[i].clip != cycles[i - 1].clip || cycles[i].begin != cycles[i - 1].begin;
      if (once && cycles[i].evident.speed() > moving) lengths.push_back(seconds(cycles[i]));
    }
    if (lengths.empty()) return;
    const double usual = median(std::move(lengths));
    for (ClosedCycle& cycle : cycles) {
      if (cycle.evident.speed() > moving)
        cycle.flaw += effort_of_speed(std::max(1.0, usual / seconds(cycle))) / kFlawed;
    }
  }

  // The first of those that are longer, as of who limps or is large, and that come back nearest.
  void look_further(int first, const std::array<Ways, 2>& held, std::array<std::vector<ClosedCycle>, 2>& longer) const {
    ClosedCycle nearest;
    int end = -1;
    from(first, [&](const ClosedCycle& cycle, int last, double seconds) {
      const double speed = cycle.evident.speed();
      if (seconds <= kLongestCycle || speed <= moving || held[usual.gait_at(speed)].hold(cycle.evident)) return true;
      const bool nearer = end < 0 ? closes(first, last) : gap(last, first) < gap(end, first);
      if (nearer) nearest = cycle, end = last;
      return nearer || end < 0;
    });
    if (end >= 0) add(nearest, first, end, first, longer);
  }
};

}  // namespace

std::vector<ClosedCycle> closed_cycles(const FragmentPool& pool, const Trajectories& trajectories,
                                       const ControlSpace& space, std::size_t takes) {
  CycleSearch search{
      pool, trajectories, {trajectories, pool.fragments, space}, kMoving / space.scale(), beginnings(pool, takes), {},
      {}};
  const int fragments = static_cast<int>(pool.fragments.size());
  for (int f = 0; f < fragments; ++f) search.look(f);
  const std::array<Ways, 2> held{Ways(search.whole[0], search.moving), Ways(search.whole[1], search.moving)};
  std::array<std::vector<ClosedCycle>, 2> longer;
  for (int f = 0; f < fragments; ++f) search.look_further(f, held, longer);
  std::vector<ClosedCycle> found;
  for (std::size_t gait = 0; gait < held.size(); ++gait) {
    std::vector<ClosedCycle> cycles = std::move(search.whole[gait]);
    search.blame_haste(cycles);
    std::copy_if(search.steps[gait].begin(), search.steps[gait].end(), std::back_inserter(cycles),
                 [&](const ClosedCycle& step) { return !held[gait].hold(step.evident); });
    cycles.insert(cycles.end(), longer[gait].begin(), longer[gait].end());
    const Ways all(cycles, search.moving);
    for (const ClosedCycle& cycle : cycles) {
      found.push_back(cycle);
      const ClosedCycle reversed = backward(cycle);
      if (!all.hold(reversed.evident)) found.push_back(reversed);
    }
  }
  return found;
}

GaitSource gait_of_step(const Kinematics& kinematics, const FragmentPool& pool, const ClosedCycle& step,
                        const Contacts& contacts, const Contacts& image_contacts) {
  const auto [begin, end] = std::minmax(step.begin, step.end);
  const Clip &clip = pool.clips[step.clip], &image = pool.clips[step.image];
  const BodyPose first = body_pose(kinematics, clip, begin), other = body_pose(kinematics, image, begin);
  const GaitCycle one = gait_cycle_of(kinematics, clip, begin, end, other),
                  two = gait_cycle_of(kinematics, image, begin, end, first);
  const int length = end - begin;
  GaitSource gait{{clip.name, clip.rate, 0, {}, {}, {}}, contacts, 0, 2 * length};
  append_poses(kinematics, one, one.poses[0].frame, gait.clip);
  append_poses(kinematics, two, one.end, gait.clip);
  const double turn = one.end.heading - two.poses[0].frame.heading;
  append(kinematics, gait.clip,
         {one.end.position + turned(two.end.position - two.poses[0].frame.position, turn), two.end.heading + turn},
         first);
  append_markers(clip, begin, end, 0, gait.clip.markers);
  append_markers(image, begin, end, length, gait.clip.markers);
  for (std::size_t foot = 0; foot < contacts.feet.size(); ++foot) {
    std::vector<bool>& stands = gait.contacts.feet[foot];
    stands.clear();
    if (contacts.feet[foot].empty()) continue;
    for (int f = 0; f <= 2 * length; ++f)
      stands.push_back((f / length == 1 ? image_contacts : contacts).stands(foot, begin + f % length));
  }
  if (step.backward()) std::swap(gait.begin, gait.end);
  return gait;
}

}  // namespace fragmotion
