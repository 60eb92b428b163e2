// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "runtime/player.hpp"

namespace fragmotion {

/// The most players of a crowd: each keeps some kilobytes, and none of a million would be seen.
constexpr int kMostPlayers = 100000;

/// Many players of one character that step together. Player i shows, to the bit, what a Player of the same options with
/// the seed `options.seed` + i shows that is stepped alone. The players stand in parts, which share nothing that
/// changes: those who have threads step parts at the same time, in any order.
class Crowd {
 public:
  /// `parts`: from 1 to as many as there are players; other numbers become the nearest of these. Throws
  /// std::invalid_argument on an option that is out of its range and on a count that is not 0 to kMostPlayers.
  Crowd(std::shared_ptr<const Character> character, int count, const PlayerOptions& options = {}, int parts = 1);

  int size() const { return static_cast<int>(players_.size()); }
  int bones() const { return bones_; }
  int parts() const { return parts_; }
  /// Where a player is and what it plays; throws std::invalid_argument on one that does not exist. How it is posed,
  /// step() tells alone.
  const Player& operator[](int player) const { return players_[existing(player)]; }

  /// Player::reset and change_style of one; they throw likewise, and on a player that does not exist.
  void reset(int player, const CharacterFrame& frame = {}, int style = 0);
  void change_style(int player, int style);

  /// Player::force of one; throws std::invalid_argument on a player or a class that does not exist.
  void force(int player, int next_class);

  /// Player::start_move and release_move of one; they throw likewise.
  void start_move(int player, int move);
  void release_move(int player, int move);

  /// Steps each player under its control, [size()], as Player::step; throws before any has moved. What is shown then is
  /// written to `roots` [size(), 3], m, and `rotations` [size(), bones(), 4] as in Clip, unless they are null.
  /// Allocates nothing.
  void step(const Control* controls, double seconds, double* roots = nullptr, double* rotations = nullptr);

  /// The same of one part's players; the arrays are the whole crowd's. Once check_step() has let the controls pass, it
  /// does not throw but std::invalid_argument on a part that does not exist.
  void step_part(int part, const Control* controls, double seconds, double* roots = nullptr,
                 double* rotations = nullptr);

  /// Throws as step(), and moves nobody.
  void check_step(const Control* controls, double seconds) const;

 private:
  int existing(int player) const;
  void step_player(int player, const Control& control, double seconds, double* roots, double* rotations);

  int bones_, parts_;
  std::vector<Player> players_;  // those of a part share a workspace
};

}  // namespace fragmotion
