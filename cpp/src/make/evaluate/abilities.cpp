// SPDX-License-Identifier: MIT
#include "evaluate/abilities.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/rates.hpp"
#include "character/naming.hpp"
#include "evaluate/performance.hpp"
#include "fragments/coverage.hpp"

namespace fragmotion {
namespace {

constexpr double kAsked = 6, kJudged = 4;                     // s: drawn limps take as long for two steps
constexpr double kOfSpeed = 0.2, kOfTurn = 0.3, kSlow = 0.1;  // m/s of a 1.8 m character

bool is_done(const Player& player, const ControlSpace& space, const Control& control) {
  Trace trace(static_cast<std::size_t>(kAsked * kTraceRate), control);
  const Performance shown = perform(player.another({}), trace, kPoseRate);
  const int begin = static_cast<int>((kAsked - kJudged) * kPoseRate);
  const auto at = [&](int f) { return &shown.path[std::size_t{3} * f]; };
  Vector2 velocity = Vector2::Zero();
  for (int f = begin; f + 1 < shown.frames; ++f) {
    const Vector2 step(at(f + 1)[0] - at(f)[0], at(f + 1)[1] - at(f)[1]);
    velocity += Eigen::Rotation2Dd(-at(f)[2]) * step;
  }
  const double seconds = (shown.frames - 1 - begin) / kPoseRate;
  velocity /= seconds;
  const double turn = (at(shown.frames - 1)[2] - at(begin)[2]) / seconds / space.turn_rate();
  const double least = kSlow / space.scale();
  return (velocity - Vector2(control.x, control.y)).norm() <= std::max(kOfSpeed * control.speed(), least) &&
         std::abs(turn - control.turn) <= kOfTurn;
}

}  // namespace

std::vector<char> abilities(const std::shared_ptr<const Character>& character, int threads) {
  const ControlSpace& space = character->space;
  const std::vector<double> distances = coverage(character->pool.fragments, space).distances;
  std::vector<char> done(space.size());
  const Player player(character);  // what the others share takes longer to be found than to play one
  parallel_for(space.size(), thread_count(threads), [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      const Control control = space.point(c);
      done[c] = control.jumps() ? distances[c] <= kPerformed : is_done(player, space, control);
    }
  });
  return done;
}

std::vector<std::string> undone_controls(const ControlSpace& space, const std::vector<char>& done) {
  std::vector<std::string> names;
  for (int c = 0; c < space.size(); ++c) {
    const Control& control = space.point(c);
    if (control.turn == 0 && !control.jumps() && !done[c]) names.push_back(control_name(space, control));
  }
  return names;
}

}  // namespace fragmotion
