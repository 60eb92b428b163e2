// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/crowd.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fragmotion/base/parallel.hpp"

namespace fragmotion {
namespace {

// The first player of a part.
int first_of(int part, int parts, int players) {
  return static_cast<int>(static_cast<long long>(players) * part / parts);
}

}  // namespace

Crowd::Crowd(std::shared_ptr<const Character> character, int count, const PlayerOptions& options, int threads)
    : bones_(character->pool.skeleton.size()), parts_(std::clamp(thread_count(threads), 1, std::max(1, count))) {
  if (count < 0 || count > kMostPlayers) {
    throw std::invalid_argument("a crowd has 0 to " + std::to_string(kMostPlayers) + " players, not " +
                                std::to_string(count));
  }
  players_.reserve(count);
  for (int part = 0; part < parts_; ++part) {
    const auto workspace = std::make_shared<Workspace>(*character);
    while (size() < first_of(part + 1, parts_, count)) {
      PlayerOptions own = options;
      own.seed += players_.size();
      players_.push_back(Player(character, own, workspace));
    }
  }
}

Player& Crowd::existing(int player) {
  if (player >= 0 && player < size()) return players_[player];
  throw std::invalid_argument("player " + std::to_string(player) + " does not exist");
}

void Crowd::reset(int player, const CharacterFrame& frame) { existing(player).reset(frame); }

void Crowd::force(int player, int next_class) { existing(player).force(next_class); }

void Crowd::step(const Control* controls, double seconds, double* roots, double* rotations) {
  for (int i = 0; i < size(); ++i) Player::check_step(controls[i], seconds);
  const auto step_parts = [&](int begin, int end) {
    const int last = first_of(end, parts_, size()) - 1;
    for (int i = first_of(begin, parts_, size()); i <= last; ++i) {
      players_[std::min(i + 1, last)].prefetch();
      step(i, controls[i], seconds, roots, rotations);
    }
  };
  if (parts_ == 1) return step_parts(0, 1);
  parallel_for(parts_, parts_, step_parts);
}

void Crowd::step(int player, const Control& control, double seconds, double* roots, double* rotations) {
  Player& p = players_[player];
  p.step(control, seconds);
  if (roots != nullptr) store_vector(p.root_position(), roots + std::ptrdiff_t{3} * player);
  if (rotations != nullptr) {
    std::copy(p.rotations().begin(), p.rotations().end(), rotations + std::ptrdiff_t{4} * bones_ * player);
  }
}

}  // namespace fragmotion
