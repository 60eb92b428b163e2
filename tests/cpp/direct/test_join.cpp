// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "direct/join.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

Motion shown(const Clip& clip) {
  Motion motion{clip.rate, clip.root_positions, clip.rotations, {}};
  for (int f = 0; f < clip.frames; ++f) {
    motion.path.insert(motion.path.end(),
                       {clip.root_positions[3 * f], clip.root_positions[3 * f + 1], clip.headings[f]});
  }
  return motion;
}

Motion walk(double heading) {
  Gait gait;
  gait.turn = 0.5;
  gait.heading = heading;
  return shown(gait_clip(gait));
}

TEST(Join, IsTheSameMotionWhereItWasCutApartAndMoved) {
  const Motion whole = walk(0), turned = walk(1);
  const Motion joined = join(humanoid(), whole, 40, turned, 40);
  ASSERT_EQ(joined.frames(), whole.frames());
  for (std::size_t i = 0; i < whole.root_positions.size(); ++i) {
    EXPECT_NEAR(joined.root_positions[i], whole.root_positions[i], 1e-6);
  }
  for (int f = 0; f < whole.frames(); ++f) EXPECT_NEAR(joined.path[3 * f + 2], whole.path[3 * f + 2], 1e-6);
}

TEST(Join, FindsTheSamePhaseOfAGait) {
  const Motion motion = walk(0);  // a cycle lasts 30 frames
  const Seam seam = find_seam(humanoid(), motion, {35}, motion, {48, 58, 65, 72, 80});
  EXPECT_EQ(seam.beginning, 65);
  EXPECT_LT(seam.distance, 0.02);
}

TEST(Spread, MovesTheEndAsAWholeAndTheBeginningNotAtAll) {
  const Motion motion = walk(0);
  const CharacterFrame target{motion.frame(60).position + Vector2{0.02, 0}, motion.frame(60).heading - 0.02};
  const Motion moved = spread(humanoid(), motion, 20, 60, target);
  for (int i = 0; i <= 3 * 20 + 2; ++i) EXPECT_EQ(moved.root_positions[i], motion.root_positions[i]);
  EXPECT_LT((moved.frame(60).position - target.position).norm(), 1e-12);
  EXPECT_NEAR(moved.frame(60).heading, target.heading, 1e-12);
  const auto way = [](const Motion& m) { return (m.frame(80).position - m.frame(60).position).norm(); };
  EXPECT_NEAR(way(moved), way(motion), 1e-12);
}

}  // namespace
}  // namespace fragmotion
