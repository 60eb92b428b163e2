// SPDX-License-Identifier: MIT
// On what a body stands beside its feet.
#include <gtest/gtest.h>

#include <algorithm>

#include "add_bone.hpp"
#include "dog.hpp"
#include "skeleton/other_feet.hpp"

namespace fragmotion {
namespace {

// A dog with six more legs, shorter ones, of which the last two do not reach the ground.
TEST(OtherFeet, AreWhatElseABodyStandsOn) {
  Skeleton skeleton = dog();
  std::vector<std::string> expected;
  for (int pair = 0; pair < 3; ++pair) {
    for (const double side : {1.0, -1.0}) {
      const double length = pair == 2 ? 0.2 : 0.4 - 0.1 * pair;
      const std::string name = "m" + std::to_string(pair), end = side > 0 ? ".L" : ".R";
      const int leg = skeleton.size();
      for (int part = 0; part < 3; ++part) {
        const Vector3 hip{0.2 * side, -0.2 - 0.1 * pair, pair == 2 ? -0.1 : 2 * length - 0.9};
        add_bone(skeleton, name + std::to_string(part) + end, part == 0 ? 0 : leg + part - 1,
                 part == 0 ? hip : Vector3{0, 0, -length}, {0, 0, -length});
      }
      if (pair < 2) expected.push_back(skeleton.names.back());
    }
  }
  std::vector<std::string> told;
  for (const int bone : other_feet(checked_skeleton(skeleton))) told.push_back(skeleton.names[bone]);
  std::sort(told.begin(), told.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(told, expected);
}

TEST(OtherFeet, AreNoneOfADogAndOfAMan) {
  EXPECT_TRUE(other_feet(dog()).empty());
  EXPECT_TRUE(other_feet(humanoid()).empty());
}

TEST(OtherFeet, AreNoHandsThatARestPosePutsOnTheGround) {
  Skeleton skeleton = humanoid();
  for (const char* arm : {"upper_arm.L", "upper_arm.R"}) skeleton.offsets[skeleton.find(arm)].z() -= 0.81;
  EXPECT_TRUE(other_feet(checked_skeleton(skeleton)).empty());
}

}  // namespace
}  // namespace fragmotion
