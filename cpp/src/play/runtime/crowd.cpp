// SPDX-License-Identifier: MIT
#include "runtime/crowd.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace fragmotion {
namespace {

int checked_count(int count) {
  if (count >= 0 && count <= kMostPlayers) return count;
  throw std::invalid_argument("a crowd has 0 to " + std::to_string(kMostPlayers) + " players, not " +
                              std::to_string(count));
}

// The first player of a part.
int first_player(int part, int parts, int players) {
  return static_cast<int>(static_cast<long long>(players) * part / parts);
}

}  // namespace

Crowd::Crowd(std::shared_ptr<const Character> character, int count, const PlayerOptions& options, int parts)
    : bones_(character->pool.skeleton.size()), parts_(std::clamp(parts, 1, std::max(1, checked_count(count)))) {
  players_.reserve(count);
  const auto first = std::make_shared<Workspace>(*character, options.constants);
  for (int part = 0; part < parts_; ++part) {
    const auto workspace = part == 0 ? first : std::make_shared<Workspace>(first->another());
    while (size() < first_player(part + 1, parts_, count)) {
      PlayerOptions own = options;
      own.seed += players_.size();
      players_.push_back(Player(character, own, workspace));
      players_.back().make_extras(own);
    }
  }
}

int Crowd::existing(int player) const {
  if (player >= 0 && player < size()) return player;
  throw std::invalid_argument("player " + std::to_string(player) + " does not exist");
}

void Crowd::reset(int player, const CharacterFrame& frame, int style) {
  players_[existing(player)].reset(frame, style);
}

void Crowd::change_style(int player, int style) { players_[existing(player)].change_style(style); }

void Crowd::force(int player, int next_class) { players_[existing(player)].force(next_class); }

void Crowd::start_move(int player, int move) { players_[existing(player)].start_move(move); }

void Crowd::release_move(int player, int move) { players_[existing(player)].release_move(move); }

void Crowd::check_step(const Control* controls, double seconds) const {
  for (int i = 0; i < size(); ++i) Player::check_step(controls[i], seconds);
}

void Crowd::step(const Control* controls, double seconds, double* roots, double* rotations) {
  check_step(controls, seconds);
  for (int part = 0; part < parts_; ++part) step_part(part, controls, seconds, roots, rotations);
}

void Crowd::step_part(int part, const Control* controls, double seconds, double* roots, double* rotations) {
  if (part < 0 || part >= parts_) throw std::invalid_argument("part " + std::to_string(part) + " does not exist");
  const int last = first_player(part + 1, parts_, size()) - 1;
  for (int i = first_player(part, parts_, size()); i <= last; ++i) {
    const int next = std::min(i + 1, last);
    players_[next].prefetch();
    if (rotations != nullptr) prefetch(rotations + std::ptrdiff_t{4} * bones_ * next, std::size_t{4} * bones_);
    step_player(i, controls[i], seconds, roots, rotations);
  }
}

void Crowd::step_player(int player, const Control& control, double seconds, double* roots, double* rotations) {
  Player& p = players_[player];
  p.step(control, seconds);
  if (roots != nullptr) store_vector(p.root_position(), roots + std::ptrdiff_t{3} * player);
  if (rotations != nullptr) {
    std::copy(p.rotations().begin(), p.rotations().end(), rotations + std::ptrdiff_t{4} * bones_ * player);
  }
}

}  // namespace fragmotion
