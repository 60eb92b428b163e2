// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "character/character.hpp"
#include "control/control.hpp"

namespace fragmotion {

class Player;

/// How far a stick is pushed for a walk; fully pushed it is a run.
constexpr double kHalfPush = 0.5;

/// m/s of a stick pushed 0 .. 1: a walk half way, a run at the end, straight lines between. Throws
/// std::invalid_argument on other pushes.
double stick_speed(const ControlSpace& space, double push);

/// What hands say: a stick within the unit circle, a turn from -1 to 1 (left), a jump button.
struct StickIntent {
  double right = 0, ahead = 0, turn = 0;
  bool jump = false;
};

/// How well a character turns as it goes.
struct TurnsWell {
  bool walking = true, running = true;
};

/// Whether a character in a style turns about as fast as it is told while it walks, and while it runs: a player is let
/// try. `policy`: as PlayerOptions::policy. Throws std::invalid_argument on a policy or a style that there is
/// not.
TurnsWell turns_well(const std::shared_ptr<const Character>& character, const std::string& policy = {}, int style = 0);
/// The same of a player, which is let try itself.
TurnsWell turns_well(Player& player, int style);

/// Steers by the view or by the character.
///
/// By the view, the stick says where on the screen to go. A character that turns well as it goes turns there and goes
/// ahead, on the spot first where that is behind it. One that does not goes there at once, sidewards or backwards if
/// need be, and so does any while the user turns it. By the character, the stick says where to go as the character sees
/// it, and it turns only as the user turns it.
class Steering {
 public:
  Steering(const ControlSpace& space, const TurnsWell& turns_well) : space_(&space), turns_well_(turns_well) {}

  /// The control for a character that faces `heading`; `view` is where the screen's up points on the ground, rad as
  /// headings are; none: by the character. The space must outlive it.
  /// Throws std::invalid_argument on what is not a number, or beyond a million on the stick and 1e9 rad.
  Control control(const StickIntent& intent, double heading, std::optional<double> view);

 private:
  friend struct PlayerState;

  double turn_to(double off);

  const ControlSpace* space_;
  TurnsWell turns_well_;
  double side_ = 1;  // of the turn under way: 1 is left
};

}  // namespace fragmotion
