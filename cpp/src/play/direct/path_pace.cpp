// SPDX-License-Identifier: MIT
#include "direct/path_pace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/contacts.hpp"
#include "runtime/player_constants.hpp"

namespace fragmotion {
namespace {

constexpr double kMostSteps = 20000;  // places that are looked at
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
      acceleration_(RootLimits{}.acceleration / scale_),
      closed_(path.is_closed()),
      stands_(stands_at_end) {
  const double steps = std::clamp(std::ceil(2 * length_ * scale_ / kArrived), 2.0, kMostSteps);
  step_ = length_ / steps;
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    const double way = i * step_, limit = corner(path, way, space.run());
    limits_.push_back(by_speeds && path.has_speeds() ? std::min({limit, path.speed(way), space.run()}) : limit);
  }
  brake();
}

double PathPace::corner(const Path& path, double way, double run) const {
  const double bend = std::sqrt(acceleration_ / std::sqrt(2.0) * radius(path, way, kReach / scale_));
  return std::clamp(bend, kSlowest * walk_, run);
}

void PathPace::brake() {
  const double stop = length_ - stopping_distance(walk_), slower = acceleration_ * step_;
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

double PathPace::limit(double way) const {
  const double at = closed_ && !stands_ ? way - length_ * std::floor(way / length_) : std::clamp(way, 0.0, length_);
  const auto i = std::min(static_cast<std::size_t>(at / step_), limits_.size() - 2);
  const double share = std::min(at / step_ - static_cast<double>(i), 1.0);
  return limits_[i] + share * (limits_[i + 1] - limits_[i]);
}

double PathPace::seconds_left(double way, double going, double speed) const {
  const double last = std::min(speed, limits_.back());
  const double stop = stands_ ? length_ - stopping_distance(last) : length_, stood = kMoving / scale_;
  double seconds = 0, now = going, at = std::max(way, 0.0);
  for (auto i = static_cast<std::size_t>(at / step_) + 1; i < limits_.size() && at < stop; ++i) {
    const double next = std::min(static_cast<double>(i) * step_, stop), limit = std::min(speed, limits_[i]);
    const double then = std::min(limit, std::sqrt(now * now + 2 * acceleration_ * (next - at)));
    seconds += (next - at) / std::max((std::min(now, limit) + then) / 2, std::min(stood, limit));
    now = then;
    at = next;
  }
  return stands_ ? seconds + std::max(last - stood, 0.0) / acceleration_ : seconds;
}

double PathPace::speed_to_arrive(double way, double going, double seconds, double least, double most) const {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (least + most) / 2;
    (seconds_left(way, going, middle) > seconds ? least : most) = middle;
  }
  return most;
}

}  // namespace fragmotion
