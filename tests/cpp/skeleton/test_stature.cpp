// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "add_bone.hpp"
#include "humanoids.hpp"
#include "io/asf_amc.hpp"
#include "io/bvh.hpp"
#include "mocap_files.hpp"
#include "skeleton/roles.hpp"
#include "skeleton/skeleton.hpp"
#include "stilts.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

Skeleton rig(const std::string& what) {
  for (const Family& family : families()) {
    if (family.what == what) return make_skeleton(Humanoid(family).skeleton);
  }
  throw std::invalid_argument(what);
}

/// The skeleton with the tip of the head, of the toes and of whatever else ends drawn out.
Skeleton with_ends(Skeleton skeleton, double times) {
  std::vector<bool> leaf(skeleton.names.size(), true);
  for (int bone = 1; bone < skeleton.size(); ++bone) leaf[skeleton.parents[bone]] = false;
  for (int bone = 0; bone < skeleton.size(); ++bone) {
    if (leaf[bone]) skeleton.tips[bone] *= times;
  }
  return skeleton;
}

/// Each bone but the first in two halves, as a rig with twist bones has them.
Skeleton in_halves(const Skeleton& whole) {
  Skeleton halves;
  std::vector<int> places(whole.names.size());
  for (int bone = 0; bone < whole.size(); ++bone) {
    const int parent = whole.parents[bone];
    int above = parent < 0 ? -1 : places[parent];
    if (parent >= 0) {
      add_bone(halves, whole.names[bone] + "_helper", above, whole.offsets[bone] / 2, whole.offsets[bone] / 2);
      above = halves.size() - 1;
    }
    places[bone] = halves.size();
    add_bone(halves, whole.names[bone], above, parent < 0 ? whole.offsets[bone] : Vector3(whole.offsets[bone] / 2),
             whole.tips[bone], whole.rest_rotations[bone]);
  }
  for (int Roles::*role :
       {&Roles::hips, &Roles::head, &Roles::left_thigh, &Roles::right_thigh, &Roles::left_foot, &Roles::right_foot}) {
    halves.roles.*role = places[whole.roles.*role];
  }
  return halves;
}

Skeleton times(Skeleton skeleton, double size) {
  for (auto* part : {&skeleton.offsets, &skeleton.tips}) {
    for (Vector3& place : *part) place *= size;
  }
  return skeleton;
}

Skeleton mirrored(Skeleton skeleton) {
  for (auto* part : {&skeleton.offsets, &skeleton.tips}) {
    for (Vector3& place : *part) place.x() *= -1;
  }
  for (Quaternion& turn : skeleton.rest_rotations) turn = Quaternion(turn.w(), turn.x(), -turn.y(), -turn.z());
  std::swap(skeleton.roles.left_thigh, skeleton.roles.right_thigh);
  std::swap(skeleton.roles.left_foot, skeleton.roles.right_foot);
  return skeleton;
}

struct Measured {
  std::string what;
  Skeleton skeleton;
  double tall;    ///< m, as the body stands.
  double before;  ///< m, as it was measured along the bones, from the head's tip to a foot's.
};

std::vector<Measured> bodies_of_known_height() {
  std::vector<Measured> rows = {
      {"walker of the tests", humanoid(), 1.76, 1.96},
      {"the same, 0.3 as large", humanoid(0.3), 0.3 * 1.76, 0.3 * 1.96},
      {"the same, bones in halves", in_halves(humanoid()), 1.76, 1.96},
  };
  const std::vector<std::pair<std::string, double>> before = {
      {"CMU's BVH", 1.88}, {"CMU's ASF", 1.88},         {"Mixamo", 1.88}, {"Rigify's meta-rig", 1.88},
      {"Biped", 1.85},     {"Perception Neuron", 1.88}, {"MMD", 1.88},    {"Character Creator", 1.88}};
  for (const auto& [what, metres] : before) rows.push_back({what, rig(what), 1.75, metres});
  const auto takes = shared_mocap() / "bandai-namco" / "dataset-1_walk_normal_001.bvh";
  if (std::filesystem::exists(takes)) rows.push_back({"Bandai Namco's takes", read_bvh(takes).skeleton, 1.68, 1.48});
  return rows;
}

TEST(Stature, IsThatOfThePersonWhateverTheRig) {
  for (const auto& [what, skeleton, tall, before] : bodies_of_known_height()) {
    const double measured = stature(skeleton);
    std::cout << what << ": " << tall << " m tall, measured " << before << " m before, " << measured << " m now\n";
    EXPECT_NEAR(measured, tall, 0.035 * tall) << what;
    EXPECT_LT(std::abs(measured - tall), std::abs(before - tall)) << what;
  }
}

TEST(Stature, OfLegsWithoutFeetIsToldByTheWayToTheGround) { EXPECT_NEAR(stature(stilts()), 0.9 / 0.53, 1e-9); }

TEST(Stature, OfOneActorIsTheSameInTwoFormats) {
  const auto cmu = shared_mocap() / "cmu";
  if (!std::filesystem::exists(cmu / "01.asf")) GTEST_SKIP() << "no motion capture beside the project";
  const double asf = stature(read_asf(cmu / "01.asf")),
               bvh = stature(read_bvh(cmu / "01_01.bvh", 0.0254 / 0.45).skeleton);
  std::cout << "CMU 01: " << asf << " m as ASF, before 1.74 m; " << bvh << " m as BVH, before 1.63 m\n";
  EXPECT_NEAR(asf, bvh, 1e-4);
}

TEST(Stature, DoesNotHangOnHowHeadAndToesEnd) {
  for (const Family& family : families()) {
    const Skeleton whole = make_skeleton(Humanoid(family).skeleton);
    for (const double longer : {0.0, 0.1, 3.0}) {
      EXPECT_EQ(stature(with_ends(whole, longer)), stature(whole)) << family.what << " " << longer;
    }
    Skeleton headless = whole;
    headless.roles.head = -1;
    headless.offsets[whole.roles.head].setZero();
    EXPECT_EQ(stature(headless), stature(whole)) << family.what;
  }
}

TEST(Stature, GrowsWithTheBodyAndIsItsMirrorImages) {
  for (const Family& family : families()) {
    const Skeleton whole = make_skeleton(Humanoid(family).skeleton);
    EXPECT_EQ(stature(times(whole, 1024)), 1024 * stature(whole)) << family.what;
    for (const double size : {1e-4, 10.0, 1e4}) {
      EXPECT_NEAR(stature(times(whole, size)) / (size * stature(whole)), 1, 1e-14) << family.what << " " << size;
    }
    Skeleton uneven = whole;
    uneven.offsets[whole.roles.left_foot] *= 0.9;
    EXPECT_LT(stature(uneven), stature(whole));
    EXPECT_EQ(stature(mirrored(uneven)), stature(uneven)) << family.what;
  }
}

TEST(Stature, IsToldByOneLegWhereThereIsOne) {
  const Skeleton whole = humanoid();
  Skeleton one = whole;
  one.roles.left_foot = one.roles.left_thigh = -1;
  EXPECT_EQ(stature(one), stature(whole));
  std::swap(one.roles.right_foot, one.roles.left_foot);
  std::swap(one.roles.right_thigh, one.roles.left_thigh);
  EXPECT_EQ(stature(one), stature(whole));
}

// No length and no way from foot to thigh: from a forged file, or from a caller who names other bones.
TEST(Stature, IsTheLongestChainWhereNoLegIsOne) {
  Skeleton none = humanoid();
  none.roles = {};
  none.roles.hips = 0;
  const double chain = stature(none);
  EXPECT_GT(chain, 1);
  for (const auto& [thigh, foot] : std::vector<std::array<int, 2>>{{-1, 8}, {8, -1}, {8, 8}, {8, 2}, {2, 8}, {8, 6}}) {
    Skeleton odd = none;
    odd.roles.left_thigh = odd.roles.right_thigh = thigh;
    odd.roles.left_foot = odd.roles.right_foot = foot;
    EXPECT_EQ(stature(odd), chain) << thigh << " " << foot;
  }
}

}  // namespace
}  // namespace fragmotion
