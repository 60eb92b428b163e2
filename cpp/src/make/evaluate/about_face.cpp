// SPDX-License-Identifier: MIT
#include "evaluate/about_face.hpp"

#include <cmath>

#include "base/rates.hpp"
#include "evaluate/response.hpp"
#include "evaluate/runner.hpp"

namespace fragmotion {
namespace {

constexpr int kTrials = 16;
constexpr double kFaces = 15 * kPi / 180;  // rad off where it shall face, from which on it faces there

double about_face(Runner& runner, const ControlSpace& space, double side) {
  const double begun = runner.heading(), walk = space.walk();
  const Vector2 back{std::sin(begun), -std::cos(begun)};
  for (int f = 1; f <= kNoAboutFace * kGameRate; ++f) {
    const double off = kPi - side * (runner.heading() - begun);
    runner.frame({0, off < kTurnsBack ? walk : 0, side * space.turn_towards(off), 0});
    if (std::abs(off) < kFaces && runner.world_velocity().dot(back) >= kAnswered * walk) return f / kGameRate;
  }
  return kNoAboutFace;
}

}  // namespace

std::vector<double> about_face_times(const std::shared_ptr<const Character>& character, const PlayerOptions& options) {
  Player player(character, options);
  Runner runner(player);
  Random random(options.seed);
  std::vector<double> times;
  for (int trial = 0; trial < kTrials; ++trial) {
    runner.hold({0, character->space.walk(), 0, 0}, random);
    times.push_back(about_face(runner, character->space, trial % 2 == 0 ? 1 : -1));
  }
  return times;
}

}  // namespace fragmotion
