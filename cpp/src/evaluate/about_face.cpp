// SPDX-License-Identifier: MIT
#include "fragmotion/evaluate/about_face.hpp"

#include <cmath>

#include "evaluate/runner.hpp"

namespace fragmotion {
namespace {

constexpr int kTrials = 16;
constexpr double kShare = 0.9;  // of the walk

double about_face(Runner& runner, double walk, double side) {
  const double begun = runner.heading();
  const Vector2 back{std::sin(begun), -std::cos(begun)};
  bool turned = false;
  for (int f = 1; f <= kNoAboutFace * Runner::kRate; ++f) {
    runner.frame({0, walk, turned ? 0 : side, 0});
    turned = turned || side * (runner.heading() - begun) >= kPi;
    if (turned && runner.world_velocity().dot(back) >= kShare * walk) return f / Runner::kRate;
  }
  return kNoAboutFace;
}

}  // namespace

std::vector<double> about_face_times(const std::shared_ptr<const Character>& character, const PlayerOptions& options) {
  Player player(character, options);
  Runner runner(player);
  Random random(options.seed);
  const double walk = character->space.walk();
  std::vector<double> times;
  for (int trial = 0; trial < kTrials; ++trial) {
    runner.hold({0, walk, 0, 0}, random);
    times.push_back(about_face(runner, walk, trial % 2 == 0 ? 1 : -1));
  }
  return times;
}

}  // namespace fragmotion
