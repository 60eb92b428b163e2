// SPDX-License-Identifier: MIT
#include "direct/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/ranges.hpp"
#include "base/take_limits.hpp"

namespace fragmotion {
namespace {

double heading_of(const Vector2& direction) { return std::atan2(-direction.x(), direction.y()); }

Path followed(const Path& path, PathEnd end) { return end == PathEnd::loop ? path.closed() : path; }

bool stops(const FollowOptions& options) { return options.end == PathEnd::stand; }

void check(const FollowOptions& options) {
  require_range("the speed along the path, in m/s,", options.speed, 0, kFastestBody);
  require_range("the time of arrival, in s,", options.arrive, 0, kDay);
  require_range("how much sooner to stop, in m,", options.stop_early, -kFarthestPlace, kFarthestPlace);
  require_range("the heading to face", options.heading, -kFarthestPlace, kFarthestPlace);
  for (const double value : {options.place.x(), options.place.y()})
    require_range("the place to face", value, -kFarthestPlace, kFarthestPlace);
}

}  // namespace

CharacterFrame start_of(const Path& path) {
  const double view = std::min(kArrived, path.length());
  return {path.place(0), heading_of(path.direction(view / 2, view))};
}

PathFollower::PathFollower(const ControlSpace& space, const Path& path, const FollowOptions& options)
    : space_(space),
      options_((check(options), options)),
      path_(followed(path, options.end)),
      pace_(space, path_, stops(options), options.arrive == 0) {
  if (options_.speed == 0) options_.speed = space.walk();
  reset();
}

void PathFollower::reset() {
  way_ = seconds_ = 0;
  velocity_ = Vector2::Zero();
  observed_ = set_off_ = stands_ = false;
  approaches_ = true;
  set_speed();
}

double PathFollower::asked_speed() const {
  if (options_.arrive > 0) return path_.length() / options_.arrive;
  return path_.has_speeds() ? path_.fastest() : options_.speed;
}

double PathFollower::seconds_left() const { return pace_.seconds_left(way_, velocity_.norm(), speed_); }

Control PathFollower::steer(const CharacterFrame& frame, double seconds) {
  for (const double value : {frame.position.x(), frame.position.y(), frame.heading})
    require_range("where the character is", value, -kFarthestPlace, kFarthestPlace);
  require_range("the seconds since the last call", seconds, 0, kLongestCall);
  observe(frame, seconds);
  follow_way(frame, seconds);
  if (!stands_) set_speed();
  const Aim aim = this->aim(frame, seconds);
  const double off = angle_to_face(frame, aim);
  const bool on_the_spot = options_.facing == PathFacing::along && std::abs(off) > space_.behind();
  const Vector2 wanted = on_the_spot || waits() ? Vector2::Zero() : velocity(aim);
  const Vector2 going = stops(options_) ? stopped(wanted, aim, seconds) : wanted;
  const double turn = space_.turn_towards(off);
  const double heading = frame.heading + turn * space_.turn_rate() * seconds / 2;
  const Vector2 local = Eigen::Rotation2Dd(-heading) * going;
  return {local.x(), local.y(), turn, 0};
}

void PathFollower::moved(const CharacterFrame& to) {
  velocity_ = Eigen::Rotation2Dd(to.heading - before_.heading) * velocity_;
  before_ = to;
}

void PathFollower::observe(const CharacterFrame& frame, double seconds) {
  if (observed_ && seconds > 0) {
    const Vector2 now = (frame.position - before_.position) / seconds;
    velocity_ += std::min(1.0, seconds / kFacing) * (now - velocity_);
    seconds_ += seconds;
  }
  before_ = frame;
  observed_ = true;
}

void PathFollower::follow_way(const CharacterFrame& frame, double seconds) {
  approaches_ = approaches_ && (path_.place(0) - frame.position).norm() > scaled(kReach);
  if (approaches_) return;
  const double ahead = way_ + std::min(1.5 * velocity_.norm() * seconds + scaled(kArrived), path_.length());
  way_ = path_.nearest(frame.position, way_, stops(options_) ? std::min(ahead, path_.length()) : ahead);
}

// To arrive in time, round after round; after an end it goes on as it was going.
void PathFollower::set_speed() {
  const double rounds = options_.end == PathEnd::loop ? std::floor(way_ / path_.length()) : 0,
               way = way_ - rounds * path_.length();
  if (options_.arrive == 0) {
    speed_ = std::min(asked_speed(), space_.run());
  } else if (way < path_.length()) {
    speed_ = pace_.speed_to_arrive(way, velocity_.norm(), (rounds + 1) * options_.arrive - seconds_,
                                   kSlowest * space_.walk(), space_.run());
  }
  set_off_ = set_off_ || (!approaches_ && !waits());
}

// It sets off later where it would be there too soon.
bool PathFollower::waits() const {
  return options_.arrive > 0 && !set_off_ && !approaches_ &&
         seconds_ + pace_.seconds_left(way_, 0, kSlowest * space_.walk()) < options_.arrive;
}

PathFollower::Aim PathFollower::aim(const CharacterFrame& frame, double seconds) const {
  Aim aim;
  aim.soon = seconds / 2;
  aim.off = path_.place(way_) - frame.position;
  aim.speed = std::min(speed_, pace_.limit(way_ + aim.soon * velocity_.norm()));
  aim.left = stops(options_) ? path_.length() - way_ : std::numeric_limits<double>::infinity();
  return aim;
}

// Along the path where it will be when the control shows, and back to it.
Vector2 PathFollower::velocity(const Aim& aim) const {
  const Vector2 back = aim.off / kFacing;
  if (approaches_) return clamp_length(back, aim.speed);
  const double seen = way_ + aim.soon * std::max(aim.speed, velocity_.norm());
  const double most = std::max(aim.speed, std::min(space_.walk(), back.norm()));
  return clamp_length(aim.speed * direction(seen, scaled(kArrived)) + back, most);
}

// Stands where it will come to the end by itself: a body that gets slower over part of a control goes as much less far.
Vector2 PathFollower::stopped(const Vector2& velocity, const Aim& aim, double seconds) {
  if (stands_) return Vector2::Zero();
  const double speed = std::min(velocity.norm(), velocity_.norm()), goes = speed * seconds,
               rest = aim.left - pace_.stopping_distance(speed) - options_.stop_early;
  stands_ = !approaches_ && aim.left < scaled(kReach) && rest < goes;
  if (!stands_ || goes == 0) return velocity;
  const double slower = (1 - std::clamp(rest / goes, 0.0, 1.0)) * pace_.acceleration() * seconds;
  return velocity * std::max(1 - slower / speed, 0.0);
}

Vector2 PathFollower::direction(double way, double span) const {
  return path_.direction(stops(options_) ? std::min(way, path_.length() - span / 2) : way, span);
}

double PathFollower::angle_to_face(const CharacterFrame& frame, const Aim& aim) const {
  double heading = options_.heading;
  if (options_.facing == PathFacing::place) {
    const Vector2 towards = options_.place - frame.position;
    heading = towards.norm() > scaled(kArrived) ? heading_of(towards) : frame.heading;
  } else if (options_.facing == PathFacing::along) {
    const bool away = !stands_ && aim.off.norm() > scaled(kReach);
    heading = heading_of(away ? aim.off : direction(way_ + (aim.soon + kFacing) * velocity_.norm(), scaled(kArrived)));
  }
  return wrapped(heading - frame.heading);
}

}  // namespace fragmotion
