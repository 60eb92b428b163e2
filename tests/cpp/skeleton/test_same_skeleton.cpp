// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <utility>

#include "skeleton/same_skeleton.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

struct Change {
  const char* what;
  void (*change)(Skeleton&);
};

Skeleton changed(const Change& change) {
  Skeleton skeleton = small_skeleton();
  change.change(skeleton);
  return skeleton;
}

/// small_skeleton() is 0.95 m tall at its hips, and its bones are: 0 root, 1 prop, 2 hips, 3 thigh.L, 4 foot.L ...
const Change kLikeChanges[] = {
    {"nothing", [](Skeleton&) {}},
    {"hips elsewhere at rest",
     [](Skeleton& s) {
       s.offsets[2] = {3, -5, 0.2};
     }},
    {"a prop beside the hips", [](Skeleton& s) { s.offsets[1].x() += 1; }},
    {"rounding of a length", [](Skeleton& s) { s.offsets[4].z() += 1e-4; }},
    {"rounding of a rest", [](Skeleton& s) { s.rest_rotations[4] = Eigen::AngleAxisd(1e-7, Vector3::UnitX()); }},
    {"a turned root under hips that turn it back",
     [](Skeleton& s) {
       s.rest_rotations[0] = Eigen::AngleAxisd(1, Vector3::UnitZ());
       s.rest_rotations[2] = s.rest_rotations[0].conjugate();
     }},
};

const Change kUnlikeChanges[] = {
    {"a name", [](Skeleton& s) { s.names[4] = "left foot"; }},
    {"a parent", [](Skeleton& s) { s.parents[7] = 0; }},
    {"fewer bones", [](Skeleton& s) { s.names.pop_back(), s.parents.pop_back(), s.offsets.pop_back(); }},
    {"the hips", [](Skeleton& s) { s.roles.hips = 0; }},
    {"a length", [](Skeleton& s) { s.offsets[4].z() -= 0.01; }},
    {"all lengths",
     [](Skeleton& s) {
       for (Vector3& offset : s.offsets) offset *= 1.01;
     }},
    {"a rest", [](Skeleton& s) { s.rest_rotations[3] = Eigen::AngleAxisd(1e-3, Vector3::UnitX()); }},
    {"the rest of all", [](Skeleton& s) { s.rest_rotations[0] = Eigen::AngleAxisd(1e-3, Vector3::UnitZ()); }},
};

TEST(SameSkeleton, DoesNotMindWhereTheHipsStandNorRounding) {
  for (const Change& change : kLikeChanges) {
    EXPECT_TRUE(same_skeleton(small_skeleton(), changed(change))) << change.what;
    EXPECT_TRUE(same_skeleton(changed(change), small_skeleton())) << change.what;
  }
}

TEST(SameSkeleton, MindsBonesLengthsAndRests) {
  for (const Change& change : kUnlikeChanges) {
    EXPECT_FALSE(same_skeleton(small_skeleton(), changed(change))) << change.what;
    EXPECT_FALSE(same_skeleton(changed(change), small_skeleton())) << change.what;
  }
}

TEST(SameSkeleton, IsToldWhateverTheUnit) {
  for (const double scale : {1e-2, 1.0, 1e2}) {
    for (const auto& [changes, same] : {std::pair{&kLikeChanges[3], true}, std::pair{&kUnlikeChanges[4], false}}) {
      Skeleton a = small_skeleton(), b = changed(*changes);
      for (Skeleton* skeleton : {&a, &b}) {
        for (Vector3& offset : skeleton->offsets) offset *= scale;
        for (Vector3& tip : skeleton->tips) tip *= scale;
      }
      EXPECT_EQ(same_skeleton(a, b), same) << scale;
    }
  }
}

TEST(SameSkeleton, TakesOfTheSameGoOntoEachOther) {
  for (const Change& change : kLikeChanges) {
    const Take take = random_take(changed(change), 3, 7);
    EXPECT_NO_THROW(clip_from_take(small_skeleton(), take)) << change.what;
  }
}

TEST(SameSkeleton, GroupsKeepTheOrder) {
  const Skeleton a = small_skeleton(), b = changed(kUnlikeChanges[4]), c = changed(kLikeChanges[1]);
  EXPECT_EQ(group_skeletons({a, b, c, b, a}), (std::vector<std::vector<int>>{{0, 2, 4}, {1, 3}}));
  EXPECT_TRUE(group_skeletons({}).empty());
}

}  // namespace
}  // namespace fragmotion
