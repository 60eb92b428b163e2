// SPDX-License-Identifier: MIT
#include "motion/in_place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/rates.hpp"
#include "motion/contacts.hpp"
#include "motion/cycle.hpp"
#include "motion/skate.hpp"
#include "motion/soles.hpp"

namespace fragmotion {
namespace {

// Of a character of 1.8 m.
constexpr double kStays = 0.4;       // m that hips on the spot go at most
constexpr double kTurns = kPi / 12;  // rad/s: feet that stand turn by less in a gait that goes straight
constexpr double kLevel = 0.05;      // m it rises or falls for a m back: steeper is a foot that lands or leaves
constexpr double kAsFast = 0.95;     // of what grip tells: slower is a foot that lands or leaves
constexpr double kSmooth[] = {0.5, 0.2, 0.1, 0.03};  // s, of the guesses, one after the other
constexpr double kTreads = 0.5;                      // of the way: feet that tread come back, and none of them stands

using Velocities = std::vector<Vector2>;

Vector2 mean_of(const Velocities& velocities) {
  const Vector2 sum = std::accumulate(velocities.begin(), velocities.end(), Vector2{0, 0});
  return velocities.empty() ? sum : Vector2(sum / static_cast<double>(velocities.size()));
}

// Weighted by Gaussians and weights; 0 where there is no weight.
Velocities smoothed(const Velocities& values, const std::vector<double>& weights, double sigma) {
  const int count = static_cast<int>(values.size()), reach = static_cast<int>(std::ceil(3 * sigma));
  Velocities result(count, Vector2::Zero());
  for (int f = 0; f < count; ++f) {
    double sum = 0;
    for (int g = std::max(0, f - reach); g <= std::min(count - 1, f + reach); ++g) {
      const double x = (f - g) / std::max(sigma, 1e-3), weight = weights[g] * std::exp(-0.5 * x * x);
      result[f] += weight * values[g];
      sum += weight;
    }
    if (sum > 0) result[f] /= sum;
  }
  return result;
}

// How the ground goes back under a clip's soles, over windows of `span` frames.
class Treading {
 public:
  Treading(const std::vector<SolePath>& soles, double rate, double scale)
      : soles_(soles), rate_(rate), scale_(scale), span_(std::max(1, static_cast<int>(std::lround(rate / kPoseRate)))) {
    windows_ = static_cast<int>(soles[0].heel().path.size()) - span_;
    for (const SolePath& sole : soles) stands_.push_back(stand_of(sole, [](const SolePoint&, int) { return true; }));
  }

  bool is_long_enough() const { return windows_ > 0; }

  // The mean turn of what is flat on the ground, rad/s, to the other side: as the body turns against it.
  double turn() const {
    double sum = 0;
    int count = 0;
    for (const SolePath& sole : soles_) {
      for (int f = 0; f < windows_; ++f) {
        if (std::max(height(sole.heel(), f), height(sole.ball(), f)) > kFlatSole) continue;
        sum -= wrapped(direction(sole, f + span_) - direction(sole, f)) * rate_ / span_;
        ++count;
      }
    }
    return count > 0 ? sum / count : 0;
  }

  // The body's velocity in each window, m/s, as it turns at `turn` about `center`; empty where no sole is low.
  Velocities velocities(double turn, const Vector2& center, const std::vector<double>& headings) const {
    Velocities way = guess(turn, center);
    if (is_stiff() && mean_of(way).norm() < kTreads * slowest()) return striding(turn, center, headings);
    for (std::size_t round = 1; round < std::size(kSmooth); ++round) {
      const Told told = fastest(way, turn, center);
      if (told.windows.empty()) return {};
      way = smoothed(joined(told), std::vector<double>(windows_, 1), kSmooth[round] * rate_);
    }
    return way;
  }

  // The speed at which what is low goes back, of the slower foot where both are, m/s: a mean.
  double slowest() const {
    double sum = 0;
    int count = 0;
    for (int f = 0; f < windows_; ++f) {
      double slowest = std::numeric_limits<double>::infinity();
      for (std::size_t side = 0; side < soles_.size(); ++side) {
        const double foot = fastest_low(side, f);
        if (foot >= 0) slowest = std::min(slowest, foot);
      }
      if (std::isfinite(slowest)) sum += slowest, ++count;
    }
    return count > 0 ? sum / count : 0;
  }

  // For each step from a frame to the next the window about it.
  Velocities steps(const Velocities& windows) const {
    Velocities steps;
    for (int f = 0; f + 1 < windows_ + span_; ++f)
      steps.push_back(windows[std::clamp(f - (span_ - 1) / 2, 0, windows_ - 1)]);
    return steps;
  }

 private:
  // Windows in which a sole stands, and what it tells there.
  struct Told {
    std::vector<int> windows;
    Velocities velocities;
  };

  bool is_stiff() const {
    return std::all_of(soles_.begin(), soles_.end(), [](const SolePath& sole) { return sole.points.size() == 1; });
  }

  // Rigid legs that pass each other are as low, and go forth as fast as back, where they are on the ground for a frame
  // alone: then the body goes where it faces, in each step as far as its legs open.
  Velocities striding(double turn, const Vector2& center, const std::vector<double>& headings) const {
    Velocities ahead;
    double gone = 0;
    for (int f = 0; f < windows_; ++f) {
      ahead.emplace_back(Eigen::Rotation2Dd(headings[f]) * Vector2::UnitY());
      double fastest = 0;
      for (const SolePath& sole : soles_)
        fastest = std::max(fastest, velocity(sole.heel(), f, turn, center).dot(ahead[f]));
      gone += fastest;
    }
    for (Vector2& velocity : ahead) velocity *= gone / windows_;
    return ahead;
  }

  double height(const SolePoint& point, int f) const {
    return (std::max(point.path[f].z(), point.path[f + span_].z()) - point.lowest) * scale_;
  }

  // How a foot is on the ground: how high at most, m, and how steeply its sole goes there.
  struct Stand {
    double low = kFlatSole, level = kLevel;
  };

  // That of a foot which is nowhere low or level, as fast as it goes, is where it is lowest, of where it `may` stand.
  template <typename May>
  Stand stand_of(const SolePath& sole, const May& may) const {
    double lowest = std::numeric_limits<double>::infinity(), flattest = lowest;
    each_window(sole, [&](const SolePoint& point, int f) {
      if (may(point, f)) lowest = std::min(lowest, height(point, f));
    });
    const double low = std::max(kFlatSole, lowest);
    each_window(sole, [&](const SolePoint& point, int f) {
      if (may(point, f) && height(point, f) <= low) flattest = std::min(flattest, steepness(point, f));
    });
    return {low, std::max(kLevel, flattest)};
  }

  template <typename Visitor>
  void each_window(const SolePath& sole, Visitor visitor) const {
    for (const SolePoint& point : sole.points) {
      for (int f = 0; f < windows_; ++f) visitor(point, f);
    }
  }

  // How far it rises or falls, of how far it goes over the ground, or would if it just went.
  double steepness(const SolePoint& point, int f) const {
    const Vector3 way = point.path[f + span_] - point.path[f];
    return std::abs(way.z()) / std::max(way.head<2>().norm(), kMoving / scale_ * span_ / rate_);
  }

  bool is_low(std::size_t side, const SolePoint& point, int f) const { return height(point, f) <= stands_[side].low; }
  // m/s, of a foot's points that are low; -1 where none is.
  double fastest_low(std::size_t side, int f) const {
    double fastest = -1;
    for (const SolePoint& point : soles_[side].points) {
      if (is_low(side, point, f)) fastest = std::max(fastest, velocity(point, f, 0, Vector2::Zero()).norm());
    }
    return fastest;
  }

  static double direction(const SolePath& sole, int f) {
    const Vector3 foot = sole.ball().path[f] - sole.heel().path[f];
    return std::atan2(foot.y(), foot.x());
  }

  Vector2 velocity(const std::vector<Vector3>& path, int f, double turn, const Vector2& center) const {
    const Vector2 back = (path[f] - path[f + span_]).head<2>() * rate_ / span_;
    const Vector2 arm = 0.5 * (path[f] + path[f + span_]).head<2>() - center;
    return back - turn * Vector2(-arm.y(), arm.x());
  }
  Vector2 velocity(const SolePoint& point, int f, double turn, const Vector2& center) const {
    return velocity(point.path, f, turn, center);
  }

  // What an ankle does over the ground while it is higher than about then, it does to where the body goes; while it is
  // lower, to where that comes from. So the area that its path circles, seen from the side, tells forth from back,
  // however long and high a foot is thought to be. By the spread of its heights that is a speed, m/s: the feet's mean.
  Velocities guess(double turn, const Vector2& center) const {
    Velocities sum(windows_, Vector2::Zero());
    for (const SolePath& sole : soles_) add_circled(sole.ankle, turn, center, sum);
    for (Vector2& velocity : sum) velocity /= static_cast<double>(soles_.size());
    return sum;
  }

  void add_circled(const std::vector<Vector3>& path, double turn, const Vector2& center, Velocities& sum) const {
    const std::vector<double> even(windows_, 1);
    const auto about = [&](const Velocities& values) { return smoothed(values, even, kSmooth[0] * rate_); };
    Velocities forth, over, spread;  // what is one number is an x
    for (int f = 0; f < windows_; ++f) {
      forth.emplace_back(-velocity(path, f, turn, center));
      over.emplace_back((path[f].z() + path[f + span_].z()) / 2, 0);
    }
    const Velocities usual = about(over), drift = about(forth);
    for (int f = 0; f < windows_; ++f) {
      const double height = over[f].x() - usual[f].x();
      spread.emplace_back(height * height, 0), forth[f] = height * (forth[f] - drift[f]);
    }
    const Velocities circled = about(forth), square = about(spread);
    for (int f = 0; f < windows_; ++f) {
      if (square[f].x() > 0) sum[f] += circled[f] / std::sqrt(square[f].x());
    }
  }

  // Of the low points the one that tells the greatest speed along the way, where that is no slower than its
  // neighbours and the body's grip allow. A foot that goes forth does not stand, as low as it may be.
  Told fastest(const Velocities& way, double turn, const Vector2& center) const {
    Velocities best(windows_, Vector2::Zero());
    std::vector<double> along(windows_, -std::numeric_limits<double>::infinity());
    const auto speed = [&](const SolePoint& point, int f) {
      return velocity(point, f, turn, center).dot(way[f].normalized());
    };
    for (const SolePath& sole : soles_) {
      const Stand stand = stand_of(sole, [&](const SolePoint& point, int f) { return speed(point, f) > 0; });
      each_window(sole, [&](const SolePoint& point, int f) {
        if (height(point, f) > stand.low || steepness(point, f) > stand.level) return;
        const double told = speed(point, f);
        if (told > along[f]) along[f] = told, best[f] = velocity(point, f, turn, center);
      });
    }
    const std::vector<double> least = gripped(along);
    Told told;
    for (int f = 0; f < windows_; ++f) {
      if (along[f] <= 0 || along[f] < kAsFast * least[f]) continue;
      told.windows.push_back(f);
      told.velocities.push_back(best[f]);
    }
    return told;
  }

  // The least speeds that are as great as these and change no faster than by gravity: friction seldom gives more than
  // the weight.
  std::vector<double> gripped(std::vector<double> speeds) const {
    const double step = kGravity / scale_ / rate_;
    for (int f = 1; f < windows_; ++f) speeds[f] = std::max(speeds[f], speeds[f - 1] - step);
    for (int f = windows_ - 2; f >= 0; --f) speeds[f] = std::max(speeds[f], speeds[f + 1] - step);
    return speeds;
  }

  // What is told, and between that on the way from the one to the other.
  Velocities joined(const Told& told) const {
    Velocities joined(windows_);
    std::size_t next = 0;
    for (int f = 0; f < windows_; ++f) {
      while (next < told.windows.size() && told.windows[next] < f) ++next;
      if (next == 0 || next == told.windows.size()) {
        joined[f] = told.velocities[next == 0 ? 0 : next - 1];
        continue;
      }
      const int before = told.windows[next - 1];
      const double w = static_cast<double>(f - before) / (told.windows[next] - before);
      joined[f] = (1 - w) * told.velocities[next - 1] + w * told.velocities[next];
    }
    return joined;
  }

  const std::vector<SolePath>& soles_;
  double rate_, scale_;
  int span_, windows_ = 0;
  std::vector<Stand> stands_;  // by foot
};

Vector2 root_at(const Clip& clip, int f) { return load_vector(&clip.root_positions[std::size_t{3} * f]).head<2>(); }

// Where the clip is turned about: the middle of its hips' places.
Vector2 middle(const Clip& clip) {
  Vector2 sum = Vector2::Zero();
  for (int f = 0; f < clip.frames; ++f) sum += root_at(clip, f);
  return sum / clip.frames;
}

bool stays(const Clip& clip, double scale) {
  for (int f = 1; f < clip.frames; ++f) {
    if ((root_at(clip, f) - root_at(clip, 0)).norm() * scale > kStays) return false;
  }
  return true;
}

// Whether the feet, which go back as they stand, come back.
bool tread(const std::vector<SolePath>& soles, double way) {
  double gone = 0;
  for (const SolePath& sole : soles) {
    const std::vector<Vector3>& path = sole.heel().path;
    gone += 0.5 * (path.back() - path.front()).head<2>().norm();
  }
  return gone < kTreads * way;
}

// Whether the body is seen to turn: its feet may then turn with it as they stand.
bool turns(const Clip& clip) {
  return std::abs(clip.headings.back() - clip.headings.front()) * clip.rate > kTurns * (clip.frames - 1);
}

// The mean, as the body sees it.
Vector2 mean_of(const Velocities& velocities, const Clip& clip) {
  Velocities seen;
  for (std::size_t f = 0; f < velocities.size(); ++f)
    seen.emplace_back(Eigen::Rotation2Dd(-clip.headings[f]) * velocities[f]);
  return mean_of(seen);
}

// As a pair of feet tells it.
std::optional<FeetWay> way_of(const std::vector<SolePath>& soles, const Clip& clip, double scale) {
  const Treading treading(soles, clip.rate, scale);
  if (!treading.is_long_enough()) return std::nullopt;
  FeetWay way;
  if (!turns(clip)) way.turn = treading.turn();
  if (std::abs(way.turn) < kTurns) way.turn = 0;
  const Velocities windows = treading.velocities(way.turn, middle(clip), clip.headings);
  if (windows.empty()) return std::nullopt;
  way.velocities = treading.steps(windows);
  way.mean = mean_of(way.velocities, clip);
  const double speed = way.mean.norm();
  const bool treads = treading.slowest() > kTreads * speed && tread(soles, speed * (clip.frames - 1) / clip.rate);
  if (speed * std::max(scale, std::sqrt(scale)) < kMoving || !treads) return std::nullopt;
  return way;
}

FeetWay mean_of(FeetWay a, const FeetWay& b) {
  for (std::size_t f = 0; f < a.velocities.size(); ++f) a.velocities[f] = (a.velocities[f] + b.velocities[f]) / 2;
  return {std::move(a.velocities), (a.turn + b.turn) / 2, (a.mean + b.mean) / 2};
}

// Of a four-legged body the mean of what the hind feet and the fore feet tell, if both do.
std::optional<FeetWay> way_of(const Kinematics& kinematics, const Clip& clip) {
  const double scale = standard_scale(kinematics.skeleton());
  const std::vector<SolePath> soles = find_soles(kinematics, clip);
  const std::optional<FeetWay> way = way_of({soles.begin(), soles.begin() + 2}, clip, scale);
  if (!way || soles.size() == 2) return way;
  const std::optional<FeetWay> fore = way_of({soles.begin() + 2, soles.end()}, clip, scale);
  return fore ? std::optional(mean_of(*way, *fore)) : std::nullopt;
}

}  // namespace

std::optional<FeetWay> find_feet_way(const Kinematics& kinematics, const Clip& held) {
  const Clip clip = without_held_end(held);
  const Skeleton& skeleton = kinematics.skeleton();
  if (legs_with_feet(skeleton.roles).empty() || !stays(clip, standard_scale(skeleton))) return std::nullopt;
  const int period = cycle_of(kinematics, clip);
  const Clip round = period > 0 ? unrolled(kinematics, clip, period, 2 * period + clip.frames) : clip;
  std::optional<FeetWay> way = way_of(kinematics, round);
  if (!way) return way;
  way->velocities.erase(way->velocities.begin(), way->velocities.begin() + period);
  way->velocities.resize(clip.frames - 1);
  way->mean = mean_of(way->velocities, clip);
  way->velocities.resize(held.frames - 1, Vector2::Zero());
  return way;
}

std::vector<CharacterFrame> placements(const FeetWay& way, const Clip& clip, double faster) {
  const Vector2 center = middle(clip);
  std::vector<CharacterFrame> result(clip.frames);
  Vector2 gone = Vector2::Zero();
  for (int f = 0; f < clip.frames; ++f) {
    const double turned = way.turn * faster * f / clip.rate;
    const Eigen::Rotation2Dd rotation(turned);
    result[f] = {center + gone - rotation * center, turned};
    if (f + 1 < clip.frames) gone += rotation * way.velocities[f] * faster / clip.rate;
  }
  return result;
}

Clip led(const Kinematics& kinematics, Clip clip, const FeetWay& way, double faster) {
  const std::vector<CharacterFrame> places = placements(way, clip, faster);
  const std::size_t bones = kinematics.bones(), hips = kinematics.skeleton().roles.hips;
  for (int f = 0; f < clip.frames; ++f) {
    const Vector2 place = places[f].position + Eigen::Rotation2Dd(places[f].heading) * root_at(clip, f);
    clip.root_positions[std::size_t{3} * f] = place.x();
    clip.root_positions[std::size_t{3} * f + 1] = place.y();
    double* rotation = &clip.rotations[4 * (bones * f + hips)];
    store_quaternion(places[f].rotation() * load_quaternion(rotation), rotation);
    clip.headings[f] += places[f].heading;
  }
  return clip;
}

}  // namespace fragmotion
