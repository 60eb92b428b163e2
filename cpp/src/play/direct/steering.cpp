// SPDX-License-Identifier: MIT
#include "direct/steering.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "base/rates.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

constexpr double kTurnsWell = 0.75;  // of the turn rate that is asked for
constexpr double kTrial = 2;         // s of going straight, and of turning then

void go(Player& player, const Control& control, double seconds) {
  for (long step = std::lround(seconds / kGameStep); step > 0; --step) player.step(control, kGameStep);
}

// How far a player turns to the asked side in a trial, rad.
double turned(Player& player, double pace, double turn) {
  go(player, {0, pace, 0, 0}, kTrial);
  const double before = player.frame().heading;
  go(player, {0, pace, turn, 0}, kTrial);
  return turn * (player.frame().heading - before);
}

}  // namespace

double stick_speed(const ControlSpace& space, double push) {
  require_range("how far the stick is pushed", push, 0, 1);
  if (push <= kHalfPush) return space.walk() * push / kHalfPush;
  return space.walk() + (space.run() - space.walk()) * (push - kHalfPush) / (1 - kHalfPush);
}

TurnsWell turns_well(const std::shared_ptr<const Character>& character, const std::string& policy, int style) {
  PlayerOptions options;
  options.policy = policy;
  check_style(*character, style);
  Player player(character, options);
  return turns_well(player, style);
}

TurnsWell turns_well(Player& player, int style) {
  player.reset({}, style);
  const ControlSpace& space = player.styled_character().space;
  const auto turns = [&](double pace) {
    double sum = 0;
    for (const double turn : {1.0, -1.0}) {
      player.reset({}, style);
      sum += turned(player, pace, turn);
    }
    return sum / 2 > kTurnsWell * space.turn_rate() * kTrial;
  };
  return {turns(space.walk()), turns(space.run())};
}

Control Steering::control(const StickIntent& intent, double heading, std::optional<double> view) {
  for (const double value : {intent.right, intent.ahead, intent.turn})
    require_range("what the stick says", value, -kMostControl, kMostControl);
  for (const double value : {heading, view.value_or(0)})
    require_range("a heading", value, -kFarthestPlace, kFarthestPlace);
  const double length = std::hypot(intent.right, intent.ahead), push = std::min(length, 1.0),
               jump = intent.jump ? 1 : 0;
  if (push == 0) return {0, 0, intent.turn, jump};
  const Vector2 stick{intent.right / push, intent.ahead / push};
  Vector2 way = view ? Vector2{Eigen::Rotation2Dd(*view - heading) * stick} : stick;
  double turn = intent.turn;
  if (turn == 0 && view) {
    const double off = std::atan2(-way.x(), way.y());
    turn = turn_to(off);
    if (2 * push > kHalfPush + 1 ? turns_well_.running : turns_well_.walking)
      way = {0, std::abs(off) < kPi / 2 ? 1 : 0};
  }
  way *= stick_speed(*space_, push);
  return {way.x(), way.y(), turn, jump};
}

// The turn that brings round what is off by an angle, positive to the left. Straight behind, it goes on to the side on
// which it began.
double Steering::turn_to(double off) {
  if (std::abs(off) < kPi - kPi / space_->layout().directions) side_ = std::copysign(1.0, off);
  return side_ * space_->turn_towards(std::abs(off));
}

}  // namespace fragmotion
