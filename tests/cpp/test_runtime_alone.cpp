// SPDX-License-Identifier: MIT
// What a game does: links fragmotion_runtime and nothing else of the project, loads a policy file and plays it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "character/naming.hpp"
#include "character/policy_file.hpp"
#include "runtime/crowd.hpp"

namespace fragmotion {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr int kFrames = 600, kHeld = 45;  // frames in all, and of each control

std::shared_ptr<const Character> loaded_character() {
  static const auto character = std::make_shared<const Character>(load_policy("tests/data/version-3.policy"));
  return character;
}

// Another control every kHeld frames, and for each player.
Control control_at(int frame, int player = 0) {
  return loaded_character()->space.point((7 * (frame / kHeld) + 13 * player) % kPaperPoints);
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

TEST(RuntimeAlone, LoadsAndPlaysAPolicyFile) {
  Player player(loaded_character());
  double way = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const Vector3 before = player.root_position();
    player.step(control_at(frame), kFrame);
    way += (player.root_position() - before).norm();
    ASSERT_TRUE(player.root_position().allFinite() && all_finite(player.rotations())) << frame;
  }
  EXPECT_GT(way, 1);
  EXPECT_GT(player.entered(), 20);
  EXPECT_EQ(class_names(*loaded_character()).size(), static_cast<std::size_t>(loaded_character()->classes.count));
}

// As a game's jobs would: any part at any time.
TEST(RuntimeAlone, StepsACrowdInPartsInAnyOrder) {
  constexpr int kPlayers = 23, kParts = 5;
  Crowd together(loaded_character(), kPlayers), apart(loaded_character(), kPlayers, {}, kParts);
  ASSERT_EQ(apart.parts(), kParts);
  std::vector<double> roots(3 * kPlayers), rotations(4 * kPlayers * std::size_t(together.bones())),
      part_roots = roots, part_rotations = rotations;
  std::vector<Control> controls(kPlayers);
  for (int frame = 0; frame < kFrames; ++frame) {
    for (int i = 0; i < kPlayers; ++i) controls[i] = control_at(frame, i);
    together.step(controls.data(), kFrame, roots.data(), rotations.data());
    apart.check_step(controls.data(), kFrame);
    for (int i = 0; i < kParts; ++i)
      apart.step_part((frame + 2 * i) % kParts, controls.data(), kFrame, part_roots.data(), part_rotations.data());
    ASSERT_EQ(part_roots, roots) << frame;
    ASSERT_EQ(part_rotations, rotations) << frame;
  }
  EXPECT_TRUE(all_finite(roots) && all_finite(rotations));
}

}  // namespace
}  // namespace fragmotion
