// SPDX-License-Identifier: MIT
#include "fragments/speed_range.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

constexpr double kBeyond = 1.3;  // of the takes' speed: a body goes so fast that never was seen to
constexpr int kDirections = 72;
constexpr double kTurn = 2 * kPi / kDirections;
constexpr double kTurning = kPi / 6;  // rad/s

double direction(const Control& control) { return std::atan2(control.x, control.y); }

bool goes_ahead(const Control& evident) { return std::abs(direction(evident)) <= kSameDirection; }

}  // namespace

bool is_turning(const Control& evident, double turn_rate) { return std::abs(evident.turn) * turn_rate > kTurning; }

bool goes_straight_ahead(const Control& evident, double turn_rate) {
  return goes_ahead(evident) && !is_turning(evident, turn_rate);
}

SpeedRange::SpeedRange(const std::vector<Fragment>& fragments, const ControlSpace& space)
    : walk_(space.walk()), most_(kDirections, walk_) {
  for (const Fragment& fragment : fragments) {
    const Control& ev = fragment.evident;
    const double speed = kBeyond * ev.speed();
    if (is_made(fragment.origin) || speed <= walk_) continue;
    if (is_turning(ev, space.turn_rate()) && !goes_ahead(ev)) continue;
    const double at = direction(ev);
    const int last = static_cast<int>(std::ceil((at + kSameDirection) / kTurn));
    for (int near = static_cast<int>(std::floor((at - kSameDirection) / kTurn)); near <= last; ++near) {
      const int i = (near + kDirections) % kDirections;
      if (speed <= most_[i]) continue;
      const double off = std::abs(i * kTurn - at);  // up to one and a half turns
      if (std::min(off, std::abs(off - 2 * kPi)) <= kSameDirection) most_[i] = speed;
    }
  }
}

double SpeedRange::most(const Control& control) const {
  if (most_.empty()) return walk_;
  const double at = direction(control) / kTurn, below = std::floor(at);
  const auto of = [&](double i) { return most_[(static_cast<int>(i) + kDirections) % kDirections]; };
  return of(below) + (at - below) * (of(below + 1) - of(below));
}

Control SpeedRange::within(const Control& control) const {
  const double speed = control.speed();
  if (speed <= walk_) return control;
  const double able = most(control);
  if (speed <= able * (1 + kRounding)) return control;
  return {able / speed * control.x, able / speed * control.y, control.turn, control.jump};
}

}  // namespace fragmotion
