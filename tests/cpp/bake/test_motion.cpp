// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "bake/motion.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

// A body that stands for a frame.
Motion standing() {
  Motion motion{30, {0, 0, 1}, {}, {0, 0, 0}};
  for (int b = 0; b < humanoid().size(); ++b) motion.rotations.insert(motion.rotations.end(), {1, 0, 0, 0});
  return motion;
}

TEST(Motion, IsCarriedWithItsCharacterFrame) {
  const Motion there = carried(standing(), humanoid().roles.hips, {2, 3, kPi / 2});
  EXPECT_EQ(there.path, (std::vector<double>{2, 3, kPi / 2}));
  EXPECT_EQ(there.root_positions, (std::vector<double>{2, 3, 1}));
  const Quaternion hips = load_quaternion(&there.rotations[std::size_t{4} * humanoid().roles.hips]);
  EXPECT_LT(hips.angularDistance(Quaternion(Eigen::AngleAxisd(kPi / 2, Vector3::UnitZ()))), 1e-12);
}

TEST(Motion, IsChecked) {
  const Motion good = standing();
  EXPECT_NO_THROW(check_motion(humanoid(), good, "it"));
  const auto bad = [&](auto change) {
    Motion motion = good;
    change(motion);
    EXPECT_THROW(check_motion(humanoid(), motion, "it"), std::invalid_argument);
  };
  bad([](Motion& m) { m.path.clear(); });
  bad([](Motion& m) { m.rate = 0; });
  bad([](Motion& m) { m.path.pop_back(); });
  bad([](Motion& m) { m.rotations[5] = 2; });
  bad([](Motion& m) { m.root_positions[0] = 2e9; });
}

}  // namespace
}  // namespace fragmotion
