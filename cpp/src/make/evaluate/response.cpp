// SPDX-License-Identifier: MIT
#include "evaluate/response.hpp"

#include "base/rates.hpp"
#include "evaluate/runner.hpp"

namespace fragmotion {
namespace {

double response(Runner& runner, const Character& character, const Control& from, const Control& to) {
  const Control before = character.admitted(from), after = character.admitted(to);
  const Vector2 begin{before.x, before.y}, step = Vector2{after.x, after.y} - begin;
  if (step.isZero()) return 0;
  for (int f = 1; f <= kNoResponse * kGameRate; ++f) {
    runner.frame(to);
    if ((runner.velocity() - begin).dot(step) >= kAnswered * step.squaredNorm()) return f / kGameRate;
  }
  return kNoResponse;
}

}  // namespace

std::vector<double> response_times(const std::shared_ptr<const Character>& character, const PlayerOptions& options) {
  Player player(character, options);
  Runner runner(player);
  Random random(options.seed);
  const ControlSpace& space = character->space;
  const auto point = [&](int velocity) { return space.point(space.layout().index(velocity, 0, false)); };
  std::vector<double> times;
  for (int from = 0; from < space.layout().velocities(); ++from) {
    for (int to = 0; to < space.layout().velocities(); ++to) {
      if (to == from) continue;
      runner.hold(point(from), random);
      times.push_back(response(runner, *character, point(from), point(to)));
    }
  }
  return times;
}

}  // namespace fragmotion
