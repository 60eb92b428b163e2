// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "random_armature.hpp"

namespace fragmotion {
namespace {

TEST(Rig, MakesTheSkeletonOfTheTreeWithTheHips) {
  const Rig rig(random_armature(1));
  EXPECT_EQ(rig.bones(), 12);
  EXPECT_EQ(rig.skeleton().names, (std::vector<std::string>{"root", "prop", "body", "hips", "thigh.L", "thigh.R",
                                                            "foot.L", "foot.R", "spine", "head"}));
  EXPECT_EQ(rig.skeleton().parents, (std::vector<int>{-1, 0, 0, 2, 3, 3, 4, 5, 3, 8}));
  EXPECT_EQ(rig.skeleton_bones(), (std::vector<int>{1, 2, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(rig.skeleton().roles.hips, 3);
  EXPECT_EQ(rig.skeleton().roles.left_foot, 6);
}

// As a figure of blocks, each on a bone without a parent; names tell thighs.
TEST(Rig, MakesTheSkeletonOfNoLimbThatHasATwinBesideTheBody) {
  Armature armature;
  armature.names = {"Body", "Arm.L", "Arm.R", "Leg.L", "Leg.R"};
  armature.parents.assign(5, -1);
  for (const Vector3& head :
       {Vector3{0, 0, 1}, Vector3{0.4, 0, 1.5}, Vector3{-0.4, 0, 1.5}, Vector3{0.2, 0, 0.9}, Vector3{-0.2, 0, 0.9}})
    append(compose(head, Quaternion::Identity()), armature.rest);
  armature.lengths.assign(5, 0.4);
  append(compose({0, 0, 0}, Quaternion::Identity()), armature.world);
  EXPECT_EQ(Rig(armature).skeleton().names[0], "Body");
  armature.roles = {{"hips", "Leg.L"}};
  EXPECT_EQ(Rig(armature).skeleton().names[0], "Leg.L") << "as it is told";
}

TEST(Rig, RestsWhereTheArmatureDoesInMetres) {
  const Armature armature = random_armature(2);
  const Rig rig(armature);
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(rig.skeleton(), heads, rotations);
  for (int b = 0; b < rig.skeleton().size(); ++b) {
    const int bone = rig.skeleton_bones()[b];
    const Matrix4 world = matrix_at(armature.world, 0) * matrix_at(armature.rest, bone);
    EXPECT_LT((heads[b] - world.topRightCorner<3, 1>()).norm(), 1e-12);
    EXPECT_LT(rotations[b].angularDistance(rotation_of(world)), 1e-12);
    const Eigen::Vector4d tail = world * Eigen::Vector4d(0, armature.lengths[bone], 0, 1);
    EXPECT_LT((heads[b] + rotations[b] * rig.skeleton().tips[b] - tail.head<3>()).norm(), 1e-12);
  }
}

TEST(Rig, ShortensBonesThatAnImporterMadeFarTooLong) {
  Armature armature = random_armature(2);
  const Rig rig(armature);
  for (double& length : armature.lengths) length *= 1000;
  const Rig overlong(armature);
  for (int b = 0; b < rig.skeleton().size(); ++b) {
    EXPECT_LT(overlong.skeleton().tips[b].norm(), 30 * rig.skeleton().tips[b].norm());
    EXPECT_EQ(overlong.skeleton().offsets[b], rig.skeleton().offsets[b]);
  }
}

// Importers of glTF have them point anywhere, as long as another bone.
TEST(Rig, LegsOfASingleBoneReachTheGround) {
  Armature armature;
  armature.names = {"root", "leg-left", "leg-right", "torso", "head"};
  armature.parents = {-1, 0, 0, 0, 3};
  const Quaternion up(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()));  // y along the bone
  for (const Vector3& head :
       {Vector3{0, 0, 0.1}, Vector3{0.1, 0, 0.3}, Vector3{-0.1, 0, 0.3}, Vector3{0, 0, 0.3}, Vector3{0, 0, 0.6}})
    append(compose(head, up), armature.rest);
  armature.lengths.assign(5, 0.2);
  append(compose({1, 2, 5}, Quaternion(Eigen::AngleAxisd(1, Vector3::UnitZ())), 2), armature.world);
  const Skeleton skeleton = Rig(armature).skeleton();
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  for (const int foot : {skeleton.roles.left_foot, skeleton.roles.right_foot}) {
    const Vector3 tip = heads[foot] + rotations[foot] * skeleton.tips[foot];
    EXPECT_LT((tip - Vector3(heads[foot].x(), heads[foot].y(), 5)).norm(), 1e-9);
  }
  EXPECT_EQ(skeleton.tips[4], Vector3(0, 0.4, 0)) << "the head is no leg";
}

// Likewise they have feet without toes point back up the leg.
TEST(Rig, FeetThatPointUpTheLegPointAhead) {
  Armature armature;
  armature.names = {"hips", "thigh.L", "shin.L", "foot.L", "thigh.R", "shin.R", "foot.R"};
  armature.parents = {-1, 0, 1, 2, 0, 4, 5};
  const Quaternion up(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()));  // y along the bone
  append(compose({0, 0, 1}, up), armature.rest);
  for (const double x : {0.1, -0.1}) {
    for (const double z : {0.9, 0.5, 0.1}) append(compose({x, 0, z}, up), armature.rest);
  }
  armature.lengths.assign(7, 0.4);
  append(compose({0, 0, 0}, Quaternion::Identity()), armature.world);
  const Skeleton skeleton = Rig(armature).skeleton();
  ASSERT_GE(skeleton.roles.left_foot, 0);
  for (const int foot : {skeleton.roles.left_foot, skeleton.roles.right_foot}) {
    const Vector3 tip = up * skeleton.tips[foot];
    EXPECT_LT((tip - Vector3(0, -0.132, 0)).norm(), 1e-9) << "a third of a shin to Blender's front";
  }
}

TEST(Rig, TakesGivenRolesBeforeNames) {
  Armature armature = random_armature(3);
  armature.roles = {{"hips", "body"}, {"head", "spine"}};
  const Rig rig(armature);
  EXPECT_EQ(rig.skeleton().names[rig.skeleton().roles.hips], "body");
  EXPECT_EQ(rig.skeleton().names[rig.skeleton().roles.head], "spine");
  EXPECT_EQ(rig.skeleton().names[rig.skeleton().roles.left_foot], "foot.L");
  armature.roles = {{"hips", "shade"}};
  EXPECT_EQ(Rig(armature).skeleton().names, (std::vector<std::string>{"lamp", "shade"}));
}

TEST(Rig, RefusesBadArmaturesNamingTheCause) {
  const struct {
    const char* label;
    std::function<void(Armature&)> spoil;
    std::vector<std::string> named;
  } cases[] = {
      {"no bones", [](Armature& a) { a = {}; }, {"no bones"}},
      {"too few parents", [](Armature& a) { a.parents.pop_back(); }, {"11 parents", "expected 12"}},
      {"too few rest values", [](Armature& a) { a.rest.pop_back(); }, {"191 values in rest matrices"}},
      {"too few lengths", [](Armature& a) { a.lengths.pop_back(); }, {"11 lengths"}},
      {"no world", [](Armature& a) { a.world.clear(); }, {"0 values in the world matrix"}},
      {"flags", [](Armature& a) { a.inherit_rotation.pop_back(); }, {"11 inherit_rotation"}},
      {"flags", [](Armature& a) { a.local_location.pop_back(); }, {"11 local_location"}},
      {"child first", [](Armature& a) { a.parents[2] = 4; }, {"'prop'", "parents must come before"}},
      {"parent below -1", [](Armature& a) { a.parents[2] = -2; }, {"'prop'", "-2"}},
      {"name twice", [](Armature& a) { a.names[0] = "head"; }, {"'head'", "twice"}},
      {"length", [](Armature& a) { a.lengths[0] = kNan; }, {"'lamp'", "length"}},
      {"rest not finite", [](Armature& a) { a.rest[16] = kNan; }, {"'root'", "finite"}},
      {"rest scales",
       [](Armature& a) {
         for (int i = 0; i < 11; ++i) a.rest[16 + i] *= 2;
       },
       {"'root'", "(2, 2, 2)"}},
      {"rest mirrors",
       [](Armature& a) {
         for (int i = 0; i < 3; ++i) a.rest[16 + 4 * i] *= -1;
       },
       {"'root'", "mirrored"}},
      {"unknown role",
       [](Armature& a) {
         a.roles = {{"tail", "spine"}};
       },
       {"'tail'", "hips, head"}},
      {"unknown bone",
       [](Armature& a) {
         a.roles = {{"head", "Skull"}};
       },
       {"'head'", "'Skull'"}},
      {"two trees",
       [](Armature& a) {
         a.roles = {{"head", "lamp"}, {"hips", "hips"}, {"left_foot", "foot.L"}};
       },
       {"'head'", "'lamp'", "'root'"}},
      {"holds no bone", [](Armature& a) { a.held["tail"] = {}; }, {"'tail'", "no such bone"}},
      {"no bone is large", [](Armature& a) { a.sizes["tail"] = 2; }, {"'tail'", "no such bone"}},
      {"as large as nothing", [](Armature& a) { a.sizes["head"] = 0; }, {"'head'", "0.000000 times as large"}},
      {"holds no rotation", [](Armature& a) { a.held["head"] = {}; }, {"'head'", "zero quaternion"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Armature armature = random_armature(4);
    c.spoil(armature);
    expect_parts(error_of([&] { Rig rig(armature); }), c.named);
  }
}

TEST(Rig, RefusesObjectsItCannotScaleUniformly) {
  const struct {
    const char* label;
    std::vector<double> world;
    std::vector<std::string> named;
  } cases[] = {
      {"non-uniform", {1, 0, 0, 5, 0, 2, 0, 5, 0, 0, 1, 5, 0, 0, 0, 1}, {"(1, 2, 1): apply the scale (Ctrl+A)"}},
      {"tilted", {1, 0, 0, 0, 0, 0.8, -1.2, 0, 0, 0.6, 1.6, 0, 0, 0, 0, 1}, {"(1, 1, 2): apply the scale (Ctrl+A)"}},
      {"negative", {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}, {"mirrored, by a negative scale"}},
      {"mirrored", {-3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1}, {"mirrored, by a negative scale"}},
      {"sheared", {1, 0.6, 0, 0, 0, 0.8, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {"sheared", "(1, 1, 1)"}},
      {"nothing", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {"(0, 0, 0): apply the scale"}},
      {"flat", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {"(1, 1, 0): apply the scale"}},
      {"not finite", {1, 0, 0, kNan, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {"world matrix is not finite"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Armature armature = random_armature(5);
    armature.world = c.world;
    expect_parts(error_of([&] { Rig rig(armature); }), c.named);
  }
}

}  // namespace
}  // namespace fragmotion
