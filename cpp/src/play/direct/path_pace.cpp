// SPDX-License-Identifier: MIT
#include "direct/path_pace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fragmotion {
namespace {

// Of a body of 1.8 m.
constexpr double kStep = 0.1;         // m between places that are looked at,
constexpr double kMostSteps = 20000;  // which are so many at most
constexpr double kBend = 1;           // m before and behind a place in which the path's radius is seen
constexpr double kSideways = 4;       // m/s^2 in a bend,
constexpr double kBraking = 2;        // before it,
constexpr double kSpeedingUp = 2.5;   // after it,
constexpr double kStopping = 5;       // and once it is told to stand,
constexpr double kReaction = 0.09;    // s after which a command is followed
constexpr double kSettingOff = 0.15;  // s longer from standing
constexpr double kTurningOff = 0.2;   // s longer out of a bend
constexpr double kSharp = 0.6;        // that is taken slower than by this of the speed
constexpr double kSlowest = 0.5;      // of a walk: in the sharpest bend
constexpr double kLeastSpeed = 0.05;  // m/s
constexpr int kHalvings = 24;         // of the span in which a speed is sought

// The radius of the arc that touches the path before and behind a place.
double radius(const Path& path, double way, double reach) {
  const Vector2 here = path.place(way), before = here - path.place(way - reach),
                behind = path.place(way + reach) - here;
  const double leg = std::min(before.norm(), behind.norm());
  const double cross = before.x() * behind.y() - before.y() * behind.x();
  const double turned = std::abs(std::atan2(cross, dot(before, behind)));
  const double tangent = std::tan(turned / 2);
  return tangent > 0 ? leg / 2 / tangent : std::numeric_limits<double>::infinity();
}

}  // namespace

PathPace::PathPace(const ControlSpace& space, const Path& path, bool stands_at_end, bool by_speeds)
    : length_(path.length()),
      scale_(space.scale()),
      walk_(space.walk()),
      closed_(path.is_closed()),
      stands_(stands_at_end) {
  const double steps = std::clamp(std::ceil(length_ * scale_ / kStep), 2.0, kMostSteps);
  step_ = length_ / steps;
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    const double way = i * step_, limit = corner(path, way, space.run());
    limits_.push_back(by_speeds && path.has_speeds() ? std::min({limit, path.speed(way), space.run()}) : limit);
  }
  brake();
}

double PathPace::corner(const Path& path, double way, double run) const {
  const double bend = std::sqrt(kSideways / scale_ * radius(path, way, kBend / scale_));
  return std::clamp(bend, kSlowest * walk_, kMostPace * run);
}

void PathPace::brake() {
  const double stop = length_ - stopping_distance(walk_), slower = 2 * kBraking / scale_ * step_;
  for (std::size_t i = 0; stands_ && i < limits_.size(); ++i) {
    if (static_cast<double>(i) * step_ >= stop) limits_[i] = std::min(limits_[i], walk_);
  }
  const bool loops = closed_ && !stands_;
  for (int lap = 0; lap < (loops ? 2 : 1); ++lap) {
    if (loops) limits_.back() = std::min(limits_.back(), limits_.front());
    for (std::size_t i = limits_.size() - 1; i-- > 0;)
      limits_[i] = std::min(limits_[i], std::sqrt(limits_[i + 1] * limits_[i + 1] + slower));
  }
}

double PathPace::stopping_distance(double speed) const {
  return speed * speed * scale_ / (2 * kStopping) + kReaction * speed;
}

double PathPace::limit(double way) const {
  const double at = closed_ && !stands_ ? way - length_ * std::floor(way / length_) : std::clamp(way, 0.0, length_);
  const auto i = std::min(static_cast<std::size_t>(at / step_), limits_.size() - 2);
  const double share = std::min(at / step_ - static_cast<double>(i), 1.0);
  return limits_[i] + share * (limits_[i + 1] - limits_[i]);
}

bool PathPace::leaves_bend(std::size_t i) const {
  return i + 1 < limits_.size() && limits_[i - 1] >= limits_[i] && limits_[i] < limits_[i + 1];
}

double PathPace::seconds_left(double way, double going, double speed) const {
  const double last = std::min(speed, limits_.back());
  const double stop = stands_ ? length_ - stopping_distance(last) : length_, faster = 2 * kSpeedingUp / scale_;
  double seconds = going * scale_ < kMoving ? kSettingOff : 0, now = going, at = std::max(way, 0.0);
  for (auto i = static_cast<std::size_t>(at / step_) + 1; i < limits_.size() && at < stop; ++i) {
    const double next = std::min(static_cast<double>(i) * step_, stop), limit = std::min(speed, limits_[i]);
    const double then = std::min(limit, std::sqrt(now * now + faster * (next - at)));
    seconds += (next - at) / std::max((std::min(now, limit) + then) / 2, std::min(kLeastSpeed / scale_, limit));
    if (limits_[i] < kSharp * speed && leaves_bend(i)) seconds += kTurningOff;
    now = then;
    at = next;
  }
  return stands_ ? seconds + kReaction + std::max(last - kMoving / scale_, 0.0) / kStopping * scale_ : seconds;
}

double PathPace::speed_to_arrive(double way, double going, double seconds, double least, double most) const {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (least + most) / 2;
    (seconds_left(way, going, middle) > seconds ? least : most) = middle;
  }
  return most;
}

}  // namespace fragmotion
