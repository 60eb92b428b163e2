// SPDX-License-Identifier: MIT
// What the bones of a body on four legs are.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "add_bone.hpp"
#include "dog.hpp"
#include "humanoids.hpp"
#include "skeleton/role_map.hpp"

namespace fragmotion {
namespace {

TEST(FourLeggedBody, IsToldByItsShape) {
  const Skeleton skeleton = dog();
  const Roles& roles = skeleton.roles;
  const auto name = [&](int bone) { return bone < 0 ? std::string() : skeleton.names[bone]; };
  EXPECT_EQ(name(roles.hips), "a");
  EXPECT_EQ(name(roles.left_thigh), "h1.L");
  EXPECT_EQ(name(roles.left_foot), "h3.L");
  EXPECT_EQ(name(roles.right_foot), "h3.R");
  EXPECT_EQ(name(roles.left_fore_leg), "f1.L");
  EXPECT_EQ(name(roles.left_fore_foot), "f3.L");
  EXPECT_EQ(name(roles.right_fore_foot), "f3.R");
  for (const int human : {roles.left_hand, roles.right_hand}) EXPECT_EQ(human, -1);
  EXPECT_EQ(resting_legs(skeleton).count(), 4);
}

// Hind legs are those that are farther from the head, wherever the root is.
TEST(FourLeggedBody, HasItsHeadAtItsForeLegs) {
  Skeleton skeleton = dog();
  skeleton.roles = {};
  skeleton.names[2] = "head";
  skeleton.parents[2] = 0;
  skeleton.offsets[2] = {0, 0.3, 0.2};
  const Skeleton turned = make_skeleton(skeleton);
  EXPECT_EQ(turned.names[turned.roles.head], "head");
  EXPECT_EQ(turned.names[turned.roles.left_thigh], "f1.R") << "which it has at its left as it faces the other way";
  EXPECT_EQ(turned.names[turned.roles.right_fore_foot], "h3.L");
}

// As Rigify has them: of a dog whose head is one more bone of its spine and whose root is at its hips.
TEST(FourLeggedBody, HasTheForeLegsThatAreNamedSo) {
  Skeleton skeleton = dog();
  skeleton.roles = {};
  for (std::string& name : skeleton.names) {
    if (name[0] == 'h') name = "front_" + name;
  }
  const Skeleton turned = make_skeleton(skeleton);
  EXPECT_EQ(turned.names[turned.roles.left_thigh], "f1.R");
  EXPECT_EQ(turned.names[turned.roles.right_fore_foot], "front_h3.L");
}

// As every avatar of Second Life has them, for whoever wants to be a centaur.
TEST(FourLeggedBody, IsNoManWithHindLegsToSpare) {
  const std::vector<Family> all = families();
  const auto family = std::find_if(all.begin(), all.end(), [](const Family& f) { return f.what == "Second Life"; });
  Humanoid man(*family);
  for (const auto& [side, sign] : {std::pair{"Left", 1.0}, {"Right", -1.0}}) {
    int on = man.skeleton.find("mPelvis");
    const Vector3 ways[] = {{0.13 * sign, 0.4, -0.1}, {0, -0.01, -0.4}, {0, 0.03, -0.4}, {0, -0.1, -0.05}};
    for (int i = 0; i < 4; ++i) {
      on = add_bone(man.skeleton, "mHindLimb" + std::to_string(i + 1) + side, on, ways[i], ways[std::min(i + 1, 3)]);
    }
  }
  EXPECT_EQ(named_bones(man.skeleton, find_role_map(make_skeleton(man.skeleton))), man.roles);
}

// As Quaternius' rat has them, whose body's bone is low between them.
TEST(FourLeggedBody, MayHaveAllItsLegsOnOneBone) {
  Skeleton skeleton = dog();
  skeleton.roles = {};
  skeleton.names[2] = "head";
  const Vector3 low{0, -0.4, -0.3};
  for (int b = 1; b < skeleton.size(); ++b) {
    if (skeleton.parents[b] == 0) skeleton.offsets[b] -= low;
    if (skeleton.parents[b] != 1 || b == 2) continue;
    skeleton.offsets[b] += Vector3{0, -kDogTrunk, 0} - low;
    skeleton.parents[b] = 0;
  }
  skeleton.offsets[0] += low;
  const Skeleton found = make_skeleton(skeleton);
  const Roles& roles = found.roles;
  EXPECT_EQ(roles.hips, 0);
  EXPECT_EQ(found.names[roles.left_foot], "h3.L");
  EXPECT_EQ(found.names[roles.right_foot], "h3.R");
  EXPECT_EQ(found.names[roles.left_fore_foot], "f3.L");
  EXPECT_EQ(found.names[roles.right_fore_leg], "f1.R");
  skeleton.names[2] = "c";
  EXPECT_EQ(find_role_map(skeleton).bone(Role::kForeFoot, Side::kLeft), -1) << "nothing tells which end is the head's";
}

// The bones of the legs may begin near each other in the middle of the trunk, as Mesh2Motion's fox has them.
TEST(FourLeggedBody, MayHaveHipBonesAndShoulderBladesThatMeet) {
  const Skeleton given = dog();
  Skeleton skeleton;
  std::vector<int> now;  // where its bones are
  const auto add = [&](const std::string& name, int parent, const Vector3& offset, int as) {
    add_bone(skeleton, name, parent, offset, given.tips[as]);
  };
  for (int b = 0; b < given.size(); ++b) {
    int parent = b == 0 ? -1 : now[given.parents[b]];
    Vector3 offset = given.offsets[b];
    if (given.names[b][1] == '1') {
      const Vector3 blade(0.5 * offset.x(), (given.names[b][0] == 'f' ? 0.4 : -0.4) * kDogTrunk, 0);
      add("p" + given.names[b], parent, blade, b);
      parent = skeleton.size() - 1, offset -= blade;
    }
    add(given.names[b], parent, offset, b);
    now.push_back(skeleton.size() - 1);
  }
  const Skeleton found = make_skeleton(std::move(skeleton));
  EXPECT_EQ(resting_legs(found).count(), 4);
  EXPECT_EQ(found.names[found.roles.left_foot], "h3.L");
  EXPECT_EQ(found.names[found.roles.right_fore_foot], "f3.R");
  EXPECT_EQ(found.names[found.roles.left_thigh], "h1.L") << "a hip bone is none of the leg";
  EXPECT_EQ(found.names[found.roles.right_fore_leg], "f1.R");
}

TEST(FourLeggedBody, IsNoManWhoseArmsHang) {
  const Skeleton skeleton = humanoid();
  EXPECT_EQ(skeleton.roles.left_fore_foot, -1);
  EXPECT_GE(skeleton.roles.left_hand, 0);
}

}  // namespace
}  // namespace fragmotion
