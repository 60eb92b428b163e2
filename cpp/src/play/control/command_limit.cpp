// SPDX-License-Identifier: MIT
#include "control/command_limit.hpp"

namespace fragmotion {

void CommandLimit::reset(double heading, const Vector2& velocity) {
  velocity_ = velocity;
  heading_ = heading;
}

Vector2 CommandLimit::velocity(double heading) const { return Eigen::Rotation2Dd(heading_ - heading) * velocity_; }

Control CommandLimit::after(const Control& control, double heading, double seconds) const {
  const Vector2 going = velocity(heading), asked{control.x, control.y};
  const double most = acceleration_ * seconds;
  if (!((asked - going).norm() > most)) return control;
  const Vector2 able = going + clamp_length(asked - going, most);
  return {able.x(), able.y(), control.turn, control.jump};
}

Vector2 CommandLimit::advance(const Control& control, double heading, double seconds) {
  const Control now = after(control, heading, seconds);
  const Vector2 going = velocity(heading);
  velocity_ = {now.x, now.y};
  heading_ = heading;
  return (velocity_ - going) / seconds;
}

}  // namespace fragmotion
