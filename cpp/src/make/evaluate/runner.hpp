// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/rates.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

/// A player, stepped kGameRate times a second, whose velocity over the last 0.1 s is known.
class Runner {
 public:
  explicit Runner(Player& player) : player_(player), track_(kWindow, player.frame()) {}

  void frame(const Control& control) {
    player_.step(control, 1 / kGameRate);
    for (int i = 1; i < kWindow; ++i) track_[i - 1] = track_[i];
    track_[kWindow - 1] = player_.frame();
  }

  /// Holds a control for 1.5 to 2 s, so that what follows meets every phase of a gait.
  void hold(const Control& control, Random& random) {
    const double seconds = kLeastHeld + (kMostHeld - kLeastHeld) * random.uniform();
    for (int f = 0; f < seconds * kGameRate; ++f) frame(control);
  }

  /// m/s, in the world.
  Vector2 world_velocity() const {
    return (track_[kWindow - 1].position - track_[0].position) * (kGameRate / (kWindow - 1));
  }
  /// m/s, seen from the character frame of the window's middle.
  Vector2 velocity() const { return Eigen::Rotation2Dd(-track_[kWindow / 2].heading) * world_velocity(); }
  double heading() const { return track_[kWindow - 1].heading; }
  const Player& player() const { return player_; }

 private:
  static constexpr int kWindow = 6;
  static constexpr double kLeastHeld = 1.5, kMostHeld = 2;  // s

  Player& player_;
  std::vector<CharacterFrame> track_;
};

}  // namespace fragmotion
