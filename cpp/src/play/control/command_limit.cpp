// SPDX-License-Identifier: MIT
#include "control/command_limit.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {

void CommandLimit::reset(double heading, const Vector2& velocity) {
  velocity_ = before_ = velocity;
  heading_ = heading;
}

void CommandLimit::face(double heading) {
  before_ = velocity_;
  velocity_ = velocity(heading);
  heading_ = heading;
}

Vector2 CommandLimit::velocity(double heading) const {
  return heading_ == heading ? velocity_ : PlaneTurn(heading_ - heading) * velocity_;
}

Control CommandLimit::round_turn(const Control& control) const {
  const double push = control.speed() * std::min(std::abs(control.turn), 1.0) * turn_rate_;
  if (!(push > acceleration_)) return control;
  const double share = acceleration_ / push;
  return {share * control.x, share * control.y, control.turn, control.jump};
}

Control CommandLimit::after(const Control& control, double heading, double seconds) const {
  return limited(control, velocity(heading), seconds);
}

Control CommandLimit::limited(const Control& given, const Vector2& going, double seconds) const {
  const Control control = round_turn(given);
  const Vector2 asked{control.x, control.y};
  const double most = acceleration_ * seconds;
  if (!((asked - going).norm() > most)) return control;
  const Vector2 able = going + clamp_length(asked - going, most);
  return {able.x(), able.y(), control.turn, control.jump};
}

Vector2 CommandLimit::advance(const Control& control, double heading, double seconds) {
  const Control now = limited(control, velocity(heading), seconds);
  const Vector2 faster = Vector2{now.x, now.y} - before_, aside{-before_.y(), before_.x()};
  velocity_ = before_ = {now.x, now.y};
  heading_ = heading;
  return faster / seconds + turn_rate_ * control.turn * aside;
}

}  // namespace fragmotion
