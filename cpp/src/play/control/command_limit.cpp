// SPDX-License-Identifier: MIT
#include "control/command_limit.hpp"

namespace fragmotion {

void CommandLimit::reset(double heading, const Vector2& velocity) {
  velocity_ = velocity;
  heading_ = heading;
}

Control CommandLimit::after(const Control& control, double heading, double seconds) const {
  const Vector2 going = Eigen::Rotation2Dd(heading_ - heading) * velocity_, asked{control.x, control.y};
  const double most = acceleration_ * seconds;
  if (!((asked - going).norm() > most)) return control;
  const Vector2 velocity = going + clamp_length(asked - going, most);
  return {velocity.x(), velocity.y(), control.turn, control.jump};
}

Vector2 CommandLimit::advance(const Control& control, double heading, double seconds) {
  const Control now = after(control, heading, seconds);
  const Vector2 going = Eigen::Rotation2Dd(heading_ - heading) * velocity_;
  velocity_ = {now.x, now.y};
  heading_ = heading;
  return (velocity_ - going) / seconds;
}

}  // namespace fragmotion
