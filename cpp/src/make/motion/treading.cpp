// SPDX-License-Identifier: MIT
#include "motion/treading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/rates.hpp"
#include "base/rounding.hpp"
#include "motion/contacts.hpp"
#include "motion/gait_scale.hpp"
#include "motion/steadiest_speed.hpp"

namespace fragmotion {
namespace {

// Of a character of 1.8 m.
constexpr double kLevel = 0.05;  // m it rises or falls for a m back: steeper is a foot that lands or leaves
constexpr double kSmooth[] = {0.5, 0.2, 0.1, 0.03};  // s, of the guesses, one after the other

// Weighted by Gaussians.
Velocities smoothed(const Velocities& values, double sigma) {
  const int count = static_cast<int>(values.size()), reach = static_cast<int>(std::ceil(3 * sigma));
  Velocities result(count, Vector2::Zero());
  for (int f = 0; f < count; ++f) {
    double sum = 0;
    for (int g = std::max(0, f - reach); g <= std::min(count - 1, f + reach); ++g) {
      const double x = (f - g) / std::max(sigma, 1e-3), weight = std::exp(-0.5 * x * x);
      result[f] += weight * values[g];
      sum += weight;
    }
    result[f] /= sum;
  }
  return result;
}

// Of a series with so many values a second, at a time: on the straight line between two.
template <typename Value>
Value at(const std::vector<Value>& series, double place) {
  const double last = static_cast<double>(series.size() - 1), within = std::clamp(place, 0.0, last);
  const std::size_t before = static_cast<std::size_t>(std::min(within, std::max(last - 1, 0.0)));
  const double weight = within - static_cast<double>(before);
  if (weight == 0) return series[before];
  return series[before] + weight * (series[before + 1] - series[before]);
}

template <typename Value>
void bring_to(std::vector<Value>& series, double step, int count) {
  std::vector<Value> result;
  for (int i = 0; i < count; ++i) result.push_back(at(series, i * step));
  series = std::move(result);
}

double direction(const SolePath& sole, int f) {
  const Vector3 foot = sole.ball().path[f] - sole.heel().path[f];
  return std::atan2(foot.y(), foot.x());
}

}  // namespace

Vector2 mean_velocity(const Velocities& velocities) {
  const Vector2 sum = std::accumulate(velocities.begin(), velocities.end(), Vector2{0, 0});
  return velocities.empty() ? sum : Vector2(sum / static_cast<double>(velocities.size()));
}

Treading::Treading(std::vector<SolePath> soles, const Clip& clip, double scale)
    : clip_rate_(clip.rate),
      rate_(clip.rate < kPostureRate ? clip.rate : kGameRate),
      scale_(scale),
      clip_frames_(clip.frames),
      span_(std::max(1, static_cast<int>(std::lround(rate_ / kPoseRate)))),
      soles_(std::move(soles)),
      headings_(clip.headings) {
  const double step = clip_rate_ / rate_;
  const int count = static_cast<int>(std::floor((clip_frames_ - 1) / step + 1e-6)) + 1;
  windows_ = count - span_;
  bring_to(headings_, step, count);
  for (std::size_t side = 0; side < soles_.size(); ++side) {
    bring_to(soles_[side].ankle, step, count);
    for (SolePoint& point : soles_[side].points) {
      bring_to(point.path, step, count);
      point.lowest = floor_of(point.path);
      treads_.push_back({side, &point, {}});
    }
  }
  low_.assign(soles_.size(), std::numeric_limits<double>::infinity());
  for (Tread& tread : treads_) {
    for (int f = 0; f < windows_; ++f) {
      low_[tread.sole] = std::min(low_[tread.sole], height(*tread.point, f));
      tread.stands.push_back(stands(*tread.point, f));
    }
  }
  for (double& low : low_) low = std::max(kFlatSole, low);
}

double Treading::turn() const {
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

Velocities Treading::velocities(double turn, const Vector2& center) const {
  Velocities way(windows_, Vector2::Zero());
  Vector2 correlation = Vector2::Zero();
  for (const SolePath& sole : soles_) correlation += add_circled(sole.ankle, turn, center, way);
  const auto feet = static_cast<double>(soles_.size());
  if (is_stiff() && mean_velocity(way).norm() < feet * kTreads * slowest()) return strides(turn, center);
  if (correlation.norm() < feet / std::sqrt(windows_)) {  // the standard error of that of numbers that have none
    if (swings(turn, center)) return strides(turn, center);
    for (int f = 0; f < windows_; ++f) way[f] = facing(f);
  }
  for (std::size_t round = 1; round < std::size(kSmooth); ++round) {
    const Told told = this->told(way, turn, center);
    if (told.windows.empty()) return {};
    way = smoothed(joined(told), kSmooth[round] * rate_);
  }
  return way;
}

double Treading::slowest() const {
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

Vector3 Treading::over_feet(std::vector<Vector3> path) const {
  bring_to(path, clip_rate_ / rate_, windows_ + span_);
  std::vector<Vector3> over(soles_.size(), Vector3::Zero());
  std::vector<double> weights(soles_.size(), 0);
  for (const Tread& tread : treads_) {
    const std::vector<Vector3>& foot = tread.point->path;
    for (int f = 0; f < windows_; ++f) {
      Vector3 apart = 0.5 * (path[f] + path[f + span_] - foot[f] - foot[f + span_]);
      apart.head<2>() = Eigen::Rotation2Dd(-headings_[f]) * apart.head<2>();
      over[tread.sole] += tread.stands[f] * apart;
      weights[tread.sole] += tread.stands[f];
    }
  }
  Vector3 mean = Vector3::Zero();
  for (std::size_t side = 0; side < over.size(); ++side) {
    if (weights[side] <= 0) return Vector3::Zero();
    mean += over[side] / (weights[side] * static_cast<double>(over.size()));
  }
  return mean;
}

Velocities Treading::steps(const Velocities& windows) const {
  Velocities steps;
  for (int f = 0; f + 1 < clip_frames_; ++f) steps.push_back(at(windows, (f + 0.5) * rate_ / clip_rate_ - 0.5 * span_));
  return steps;
}

Vector2 Treading::facing(int f) const { return Eigen::Rotation2Dd(headings_[f]) * Vector2::UnitY(); }

bool Treading::is_stiff() const {
  return std::all_of(soles_.begin(), soles_.end(), [](const SolePath& sole) { return sole.points.size() == 1; });
}

Velocities Treading::striding(double turn, const Vector2& center) const {
  return swings(turn, center) ? strides(turn, center) : Velocities{};
}

bool Treading::swings(double turn, const Vector2& center) const {
  double with = 0, against = 0, behind = 0, before = 0;
  for (int f = 0; f < windows_; ++f) {
    const double left = ahead(0, f, turn, center), right = ahead(1, f, turn, center);
    with += std::abs(left + right), against += std::abs(left - right);
    const Vector2 apart = (soles_[1].heel().path[f] - soles_[0].heel().path[f]).head<2>();
    const double place = apart.dot(facing(f));
    behind = std::max(behind, -place), before = std::max(before, place);
  }
  const bool pass = 2 * std::min(behind, before) > std::max(behind, before);
  return pass && against > 2 * with;
}

// The body goes where it faces, in each step as far as its legs open.
Velocities Treading::strides(double turn, const Vector2& center) const {
  Velocities ways;
  double gone = 0;
  for (int f = 0; f < windows_; ++f) {
    ways.push_back(facing(f));
    gone += std::max({0.0, ahead(0, f, turn, center), ahead(1, f, turn, center)});
  }
  for (Vector2& velocity : ways) velocity *= gone / windows_;
  return ways;
}

// How fast a foot goes back under a body that faces ahead, m/s.
double Treading::ahead(std::size_t side, int f, double turn, const Vector2& center) const {
  return velocity(soles_[side].heel().path, f, turn, center).dot(facing(f));
}

double Treading::height(const SolePoint& point, int f) const {
  return (std::max(point.path[f].z(), point.path[f + span_].z()) - point.lowest) * scale_;
}

// How far it rises or falls, of how far it goes over the ground, or would if it just went.
double Treading::steepness(const SolePoint& point, int f) const {
  const Vector3 way = point.path[f + span_] - point.path[f];
  return std::abs(way.z()) / std::max(way.head<2>().norm(), kMoving / scale_ * span_ / rate_);
}

// The lower and the more level, the more surely it stands; low and level are no bounds but what they are told by.
double Treading::stands(const SolePoint& point, int f) const {
  const double over = std::max(0.0, height(point, f)) / kFlatSole, steep = steepness(point, f) / kLevel;
  return std::exp(-0.5 * (over * over + steep * steep));
}

// m/s, of a foot's points that are low; -1 where none is.
double Treading::fastest_low(std::size_t side, int f) const {
  double fastest = -1;
  for (const SolePoint& point : soles_[side].points) {
    if (height(point, f) > low_[side]) continue;
    fastest = std::max(fastest, velocity(point.path, f, 0, Vector2::Zero()).norm());
  }
  return fastest;
}

Vector2 Treading::velocity(const std::vector<Vector3>& path, int f, double turn, const Vector2& center) const {
  const Vector2 back = (path[f] - path[f + span_]).head<2>() * rate_ / span_;
  const Vector2 arm = 0.5 * (path[f] + path[f + span_]).head<2>() - center;
  return back - turn * Vector2(-arm.y(), arm.x());
}

// What an ankle does over the ground while it is higher than about then, it does to where the body goes; while it is
// lower, to where that comes from. So the area that its path circles, seen from the side, tells forth from back,
// however long and high a foot is thought to be; by the spread of its heights that is a speed, m/s. Returns how heights
// and velocities correlate: by no more than by chance where it goes forth and back on one path.
Vector2 Treading::add_circled(const std::vector<Vector3>& path, double turn, const Vector2& center,
                              Velocities& sum) const {
  const auto about = [&](const Velocities& values) { return smoothed(values, kSmooth[0] * rate_); };
  Velocities forth, over, spread;  // what is one number is an x
  for (int f = 0; f < windows_; ++f) {
    forth.emplace_back(-velocity(path, f, turn, center));
    over.emplace_back((path[f].z() + path[f + span_].z()) / 2, 0);
  }
  const Velocities usual = about(over), drift = about(forth);
  for (int f = 0; f < windows_; ++f) {
    const double height = over[f].x() - usual[f].x();
    const Vector2 faster = forth[f] - drift[f];
    spread.emplace_back(height * height, faster.squaredNorm()), forth[f] = height * faster;
  }
  const Velocities circled = about(forth), square = about(spread);
  for (int f = 0; f < windows_; ++f) {
    if (square[f].x() > 0) sum[f] += circled[f] / std::sqrt(square[f].x());
  }
  const Vector2 spreads = mean_velocity(spread);
  return mean_velocity(forth) / std::max(std::sqrt(spreads.x() * spreads.y()), kRounding);
}

// What most of what stands agrees with, along the way, is how fast the body goes: a drawn foot may slap the ground, or
// drag over it, at another speed. Of what goes about so what is fastest tells: what is slower is about to leave. What
// goes forth does not stand, as low as it may be.
Treading::Told Treading::told(const Velocities& way, double turn, const Vector2& center) const {
  std::vector<ToldSpeeds> along;
  for (const Tread& tread : treads_) {
    along.push_back({{}, tread.stands});
    for (int f = 0; f < windows_; ++f)
      along.back().speeds.push_back(velocity(tread.point->path, f, turn, center).dot(way[f].normalized()));
  }
  const std::vector<double> usual = steadiest_speed(along, kMoving / gait_scale(scale_), grip());
  Told told;
  if (usual.empty()) return told;
  const std::vector<int> which = standing(along, usual);
  for (int f = 0; f < windows_; ++f) {
    if (which[f] < 0 || along[which[f]].speeds[f] < kSameSpeed * usual[f]) continue;
    told.windows.push_back(f);
    told.velocities.push_back(velocity(treads_[which[f]].point->path, f, turn, center));
  }
  return told;
}

// In each window the number of the fastest of those points that stand, at least half as surely as their foot ever does,
// and go no faster than about as usual; -1 of none.
std::vector<int> Treading::standing(const std::vector<ToldSpeeds>& along, const std::vector<double>& usual) const {
  const auto may = [&](std::size_t i, int f) {
    return along[i].speeds[f] > 0 && along[i].speeds[f] * kSameSpeed * kSameSpeed <= usual[f];
  };
  std::vector<double> surest(soles_.size(), 0);
  for (std::size_t i = 0; i < treads_.size(); ++i) {
    double& sure = surest[treads_[i].sole];
    for (int f = 0; f < windows_; ++f) {
      if (may(i, f)) sure = std::max(sure, treads_[i].stands[f]);
    }
  }
  std::vector<int> which(windows_, -1);
  for (std::size_t i = 0; i < treads_.size(); ++i) {
    for (int f = 0; f < windows_; ++f) {
      if (!may(i, f) || 2 * treads_[i].stands[f] < surest[treads_[i].sole]) continue;
      if (which[f] < 0 || along[i].speeds[f] > along[which[f]].speeds[f]) which[f] = static_cast<int>(i);
    }
  }
  return which;
}

// By how much the speed may change from a window to the next, m/s: friction seldom gives more than the weight.
double Treading::grip() const { return kGravity / scale_ / rate_; }

// What is told, and between that on the way from the one to the other.
Velocities Treading::joined(const Told& told) const {
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

}  // namespace fragmotion
