// SPDX-License-Identifier: MIT
#include <set>

#include "api_players.hpp"
#include "character/naming.hpp"

namespace fragmotion {
namespace {

TEST(ApiCharacter, IsDescribed) {
  const FragmotionCharacter& hero = styled_api_character();
  const Character& inside = *styled_character();
  FragmotionCharacterInfo info = fragmotion_info();
  expect_ok(fragmotion_character_info(&hero, &info));
  EXPECT_EQ(info.bones, inside.pool.skeleton.size());
  EXPECT_EQ(info.moves, 4);
  EXPECT_EQ(info.styles, 2);
  EXPECT_NEAR(info.height, 1.8, 0.3);
  EXPECT_GT(info.hips_height, 0.7);
  std::set<int> roles;
  for (int b = 0; b < info.bones; ++b) {
    FragmotionBone bone = fragmotion_bone();
    expect_ok(fragmotion_character_bone(&hero, b, &bone));
    EXPECT_EQ(bone.name, inside.pool.skeleton.names[b]);
    EXPECT_EQ(bone.parent, inside.pool.skeleton.parents[b]);
    EXPECT_EQ(fragmotion_character_find_bone(&hero, bone.name), b);
    roles.insert(bone.role);
    if (b == info.hips) {
      EXPECT_EQ(bone.role, FRAGMOTION_ROLE_HIPS);
    }
  }
  EXPECT_GE(roles.size(), 8U);
  FragmotionMove move = fragmotion_move();
  expect_ok(fragmotion_character_move(&hero, 3, &move));
  EXPECT_STREQ(move.name, "long wave");
  EXPECT_EQ(move.upper_body + 2 * move.loops, 3);
  EXPECT_NEAR(move.seconds, 2, 0.1);
  EXPECT_EQ(fragmotion_character_find_move(&hero, "wave"), 2);
  EXPECT_EQ(fragmotion_character_find_move(&hero, "dance"), -1);
  FragmotionStyle style = fragmotion_style();
  expect_ok(fragmotion_character_style(&hero, 1, &style));
  EXPECT_STREQ(style.name, "tired");
  EXPECT_EQ(style.run, static_cast<float>(inside.in_style(1).space.run()));
  EXPECT_EQ(fragmotion_character_find_style(&hero, "tired"), 1);
  EXPECT_EQ(fragmotion_character_class_name(&hero, 1, 3), class_names(inside.in_style(1))[3]);
  EXPECT_EQ(fragmotion_character_class_name(&hero, 1, 4000), nullptr);
}

TEST(ApiCharacter, BonesAreFoundWhateverTheImporterCallsThem) {
  const FragmotionCharacter& hero = styled_api_character();
  const int arm = fragmotion_character_find_bone(&hero, "upper_arm.R");
  ASSERT_GE(arm, 0);
  for (const char* name : {"upper_armR", "Armature|upper_arm.R", "mixamorig:Upper_Arm.R", "mixamorig9UpperArmR"}) {
    EXPECT_EQ(fragmotion_character_find_bone(&hero, name), arm) << name;
  }
  for (const char* name : {"", "upper_arm", "mixamorig", ":"})
    EXPECT_EQ(fragmotion_character_find_bone(&hero, name), -1);
}

// x, y, z in Blender, as each engine has them; forward and up.
struct Engine {
  FragmotionAxes axes;
  float unit;
  int right, forward, up;  // axes of the engine, from 1; less than 0: against it
  int mirrored;            // axis of bones' frames that is turned about, from 1
};

double along(const float* place, int axis) { return (axis < 0 ? -1.0 : 1.0) * place[std::abs(axis) - 1]; }

Eigen::Matrix3d matrix_of_rotation(const float* q) {
  return Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
}

TEST(ApiCharacter, PlaysInAnyEnginesAxes) {
  const auto blender = playing(styled_api_character());
  const int bones = bones_of(styled_api_character());
  for (const Engine& engine :
       {Engine{FRAGMOTION_AXES_GLTF, 1, 1, -3, 2, 0}, Engine{FRAGMOTION_AXES_UNITY, 1, 1, 3, 2, 1},
        Engine{FRAGMOTION_AXES_UNREAL, 100, 2, 1, 3, 2}}) {
    Eigen::Matrix3d world = Eigen::Matrix3d::Zero(), bone = Eigen::Matrix3d::Identity();
    const int rows[] = {engine.right, engine.forward, engine.up};
    for (int i = 0; i < 3; ++i) world(std::abs(rows[i]) - 1, i) = rows[i] < 0 ? -1 : 1;
    if (engine.mirrored > 0) bone(engine.mirrored - 1, engine.mirrored - 1) = -1;
    ASSERT_EQ(std::round(world.determinant()), std::round(bone.determinant())) << "what is left is a rotation";
    const auto hero = loaded(*styled_character(), engine.axes, engine.unit);
    const auto player = playing(*hero);
    expect_ok(fragmotion_player_reset(blender.get(), nullptr, 0));
    for (int frame = 0; frame < 240; ++frame) {
      FragmotionInput input = wild_input(frame);
      expect_ok(fragmotion_player_step(blender.get(), &input, 1.0F / 60));
      for (float& value : input.move) value *= engine.unit;
      expect_ok(fragmotion_player_step(player.get(), &input, 1.0F / 60));
    }
    const FragmotionState a = state_of(blender.get()), b = state_of(player.get());
    EXPECT_NEAR(along(b.place.position, engine.right), engine.unit * a.place.position[0], 1e-4 * engine.unit);
    EXPECT_NEAR(along(b.place.position, engine.forward), engine.unit * a.place.position[1], 1e-4 * engine.unit);
    EXPECT_NEAR(b.place.heading, (engine.mirrored > 0 ? -1 : 1) * a.place.heading, 1e-5);
    const Eigen::Matrix3d turned = world * matrix_of_rotation(a.rotation) * world.transpose();
    EXPECT_LT((turned - matrix_of_rotation(b.rotation)).norm(), 1e-5) << "an entity's rotation";
    for (const FragmotionSpace space : {FRAGMOTION_SPACE_WORLD, FRAGMOTION_SPACE_MODEL}) {
      const auto ours = pose_of(blender.get(), space, bones), theirs = pose_of(player.get(), space, bones);
      for (int i = 0; i < bones; ++i) {
        const Eigen::Matrix3d expected = world * matrix_of_rotation(ours[i].rotation) * bone;
        EXPECT_LT((expected - matrix_of_rotation(theirs[i].rotation)).norm(), 1e-5) << i;
        const Eigen::Vector3d place = engine.unit * (world * Eigen::Vector3f(ours[i].position).cast<double>());
        EXPECT_LT((place - Eigen::Vector3f(theirs[i].position).cast<double>()).norm(), 1e-4 * engine.unit);
      }
    }
    // Places that go in come out again, and local transforms make up those in model space.
    const FragmotionPlace there{{3 * engine.unit, 2 * engine.unit, -engine.unit}, 1};
    expect_ok(fragmotion_player_move_to(player.get(), &there));
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(state_of(player.get()).place.position[i], there.position[i], 1e-4 * engine.unit);
    EXPECT_NEAR(state_of(player.get()).place.heading, 1, 1e-5);
    const auto local = pose_of(player.get(), FRAGMOTION_SPACE_LOCAL, bones),
               model = pose_of(player.get(), FRAGMOTION_SPACE_MODEL, bones);
    for (int i = 0; i < bones; ++i) {
      FragmotionBone told = fragmotion_bone();
      expect_ok(fragmotion_character_bone(hero.get(), i, &told));
      if (told.parent < 0) continue;
      const Eigen::Matrix3d above = matrix_of_rotation(model[told.parent].rotation);
      EXPECT_LT((above * matrix_of_rotation(local[i].rotation) - matrix_of_rotation(model[i].rotation)).norm(), 1e-5);
      const Eigen::Vector3f place =
          above.cast<float>() * Eigen::Vector3f(local[i].position) + Eigen::Vector3f(model[told.parent].position);
      EXPECT_LT((place - Eigen::Vector3f(model[i].position)).norm(), 1e-4 * engine.unit);
    }
  }
}

TEST(ApiRig, WritesTheGamesBonesInTheGamesOrder) {
  const FragmotionCharacter& hero = styled_api_character();
  const auto player = playing(hero);
  for (int frame = 0; frame < 100; ++frame) {
    const FragmotionInput input = wild_input(frame);
    expect_ok(fragmotion_player_step(player.get(), &input, 1.0F / 60));
  }
  const int bones = bones_of(hero);
  std::vector<const char*> names;
  std::vector<FragmotionBone> told(static_cast<std::size_t>(bones), fragmotion_bone());
  for (int i = 0; i < bones; ++i) expect_ok(fragmotion_character_bone(&hero, i, &told[i]));
  // In their order, with one that the character lacks above the second, and one below the last.
  std::vector<std::int32_t> parents;
  std::vector<FragmotionTransform> rest;
  const FragmotionTransform none{{0, 0, 0}, {0, 0, 0, 1}}, up{{0, 0, 0.5F}, {0, 0, 0, 1}};
  for (int i = 0; i < bones; ++i) {
    if (i == 1) names.push_back("between"), parents.push_back(0), rest.push_back(none);
    names.push_back(told[i].name);
    parents.push_back(i == 1 ? 1 : told[i].parent < 1 ? told[i].parent : told[i].parent + 1);
    rest.push_back(told[i].rest);
  }
  names.push_back("hat");
  parents.push_back(bones);
  rest.push_back(up);
  FragmotionRigOptions options = fragmotion_rig_options();
  options.bones = bones + 2;
  options.names = names.data();
  FragmotionRig* made = nullptr;
  expect_ok(fragmotion_rig_create(&hero, &options, &made));
  const Held<FragmotionRig> plain(made);
  options.parents = parents.data();
  options.rest = rest.data();
  expect_ok(fragmotion_rig_create(&hero, &options, &made));
  const Held<FragmotionRig> full(made);
  EXPECT_EQ(fragmotion_rig_bone(full.get(), 1), -1);
  EXPECT_EQ(fragmotion_rig_bone(full.get(), 2), 1);
  const auto model = pose_of(player.get(), FRAGMOTION_SPACE_MODEL, bones);
  const auto seen = pose_of(player.get(), FRAGMOTION_SPACE_MODEL, bones + 2, full.get()),
             left = pose_of(player.get(), FRAGMOTION_SPACE_MODEL, bones + 2, plain.get()),
             local = pose_of(player.get(), FRAGMOTION_SPACE_LOCAL, bones + 2, full.get());
  for (int i = 0; i < bones; ++i) EXPECT_TRUE(same(seen[i < 1 ? i : i + 1], model[i]));
  EXPECT_EQ(left[1].position[0], 9) << "stays as it was";
  EXPECT_TRUE(same(seen[1], seen[0])) << "rests on its parent";
  EXPECT_NEAR((Eigen::Vector3f(seen[bones + 1].position) - Eigen::Vector3f(seen[bones].position)).norm(), 0.5, 1e-5);
  for (int i = 0; i < bones + 2; ++i) {  // local ones make up the others
    if (parents[i] < 0) continue;
    const Eigen::Matrix3d above = matrix_of_rotation(seen[parents[i]].rotation);
    EXPECT_LT((above * matrix_of_rotation(local[i].rotation) - matrix_of_rotation(seen[i].rotation)).norm(), 1e-5) << i;
  }
  std::vector<float> matrices(16 * names.size());
  expect_ok(fragmotion_player_skinning(player.get(), full.get(), FRAGMOTION_SPACE_MODEL, matrices.data(), bones + 2));
  for (int i = 0; i < bones; ++i) {  // a bone's head at rest comes to where the bone is
    const float* m = &matrices[16 * static_cast<std::size_t>(i < 1 ? i : i + 1)];
    for (int row = 0; row < 3; ++row) {
      const float* head = told[i].model.position;
      EXPECT_NEAR(m[row] * head[0] + m[4 + row] * head[1] + m[8 + row] * head[2] + m[12 + row], model[i].position[row],
                  1e-5);
    }
  }
}

TEST(ApiBlend, GoesFromOnePoseToTheOtherWhereTheMaskLetsIt) {
  const FragmotionTransform a[] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}},
                            b[] = {{{2, 0, 0}, {0, 0, -1, 0}}, {{2, 0, 0}, {0, 0, 0, -1}}, {{2, 0, 0}, {1, 0, 0, 0}}};
  const float mask[] = {1, 0.5F, 0};
  FragmotionTransform out[3];
  expect_ok(fragmotion_blend(a, b, 0.5F, mask, 3, out));
  EXPECT_EQ(out[0].position[0], 1);
  EXPECT_NEAR(std::abs(out[0].rotation[2]), std::sqrt(0.5), 1e-6);
  EXPECT_EQ(out[1].position[0], 0.5F);
  EXPECT_EQ(out[1].rotation[3], 1) << "the other sign is the same rotation";
  EXPECT_TRUE(same(out[2], a[2]));
  expect_ok(fragmotion_blend(a, b, 1, nullptr, 3, out));
  EXPECT_TRUE(same(out[2], b[2]));
  expect_fails(fragmotion_blend(a, b, kNan, nullptr, 3, out), FRAGMOTION_ERROR_ARGUMENT, "the weight");
  expect_fails(fragmotion_blend(a, b, 1, nullptr, -1, out), FRAGMOTION_ERROR_ARGUMENT, "number of bones");
  expect_fails(fragmotion_blend(nullptr, b, 1, nullptr, 3, out), FRAGMOTION_ERROR_ARGUMENT, "first pose is null");
  const float wrong[] = {1, 2, kNan};
  expect_fails(fragmotion_blend(a, b, 1, wrong, 3, out), FRAGMOTION_ERROR_ARGUMENT, "mask");
}

}  // namespace
}  // namespace fragmotion
