// SPDX-License-Identifier: MIT
#include <limits>
#include <set>

#include "api_players.hpp"
#include "character/naming.hpp"

namespace fragmotion {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kEndless = std::numeric_limits<float>::infinity();

void expect_fails(FragmotionResult result, FragmotionResult expected, const std::string& why) {
  EXPECT_EQ(result, expected) << fragmotion_last_error();
  EXPECT_NE(std::string(fragmotion_last_error()).find(why), std::string::npos) << fragmotion_last_error();
}

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

TEST(ApiErrors, SayWhyAPolicyIsNotLoaded) {
  std::string bytes = to_bytes(tiny_character());
  FragmotionCharacter* made = reinterpret_cast<FragmotionCharacter*>(1);
  const auto load = [&](const std::string& from) {
    return fragmotion_character_load(from.data(), from.size(), nullptr, &made);
  };
  expect_fails(fragmotion_character_load(nullptr, 9, nullptr, &made), FRAGMOTION_ERROR_ARGUMENT, "bytes is null");
  EXPECT_EQ(made, nullptr);
  expect_fails(fragmotion_character_load(bytes.data(), bytes.size(), nullptr, nullptr), FRAGMOTION_ERROR_ARGUMENT,
               "null");
  expect_fails(load("no policy at all"), FRAGMOTION_ERROR_REFUSED, "no Fragmotion policy");
  expect_fails(load(""), FRAGMOTION_ERROR_REFUSED, "no Fragmotion policy");
  expect_fails(load(bytes.substr(0, 500)), FRAGMOTION_ERROR_REFUSED, "cut short");
  std::string newer = bytes, older = bytes, damaged = bytes;
  newer[8] = 9;
  older[8] = 1;
  damaged[900] = static_cast<char>(damaged[900] ^ 4);
  expect_fails(load(newer), FRAGMOTION_ERROR_NEWER_VERSION, "get a newer Fragmotion");
  expect_fails(load(older), FRAGMOTION_ERROR_OLDER_VERSION, "build it again");
  expect_fails(load(damaged), FRAGMOTION_ERROR_REFUSED, "damaged");
  FragmotionLoadOptions options = fragmotion_load_options();
  const auto load_with = [&] { return fragmotion_character_load(bytes.data(), bytes.size(), &options, &made); };
  for (const float unit : {0.0F, -1.0F, kNan, kEndless}) {
    options.units_per_metre = unit;
    expect_fails(load_with(), FRAGMOTION_ERROR_ARGUMENT, "units_per_metre");
  }
  options = fragmotion_load_options();
  options.axes = static_cast<FragmotionAxes>(77);
  expect_fails(load_with(), FRAGMOTION_ERROR_ARGUMENT, "no axes 77");
  options = fragmotion_load_options();
  options.size = 3;
  expect_fails(load_with(), FRAGMOTION_ERROR_SIZE, "size of the options is 3");
}

// Every function with each of its arguments wrong.
TEST(ApiErrors, SayWhichArgumentIsWrong) {
  const FragmotionCharacter* hero = &styled_api_character();
  const auto held = playing(*hero);
  FragmotionPlayer* player = held.get();
  const int bones = bones_of(*hero);
  FragmotionInput input = fragmotion_input();
  FragmotionState state = fragmotion_state();
  std::vector<FragmotionTransform> pose(static_cast<std::size_t>(bones));
  const std::uint64_t before = checksum_of(player);
  const FragmotionResult wrong = FRAGMOTION_ERROR_ARGUMENT, size = FRAGMOTION_ERROR_SIZE;

  FragmotionCharacterInfo info = fragmotion_info();
  FragmotionBone bone = fragmotion_bone();
  FragmotionMove move = fragmotion_move();
  FragmotionStyle style = fragmotion_style();
  expect_fails(fragmotion_character_info(nullptr, &info), wrong, "fragmotion_character_info: the character is null");
  expect_fails(fragmotion_character_info(hero, nullptr), wrong, "info is null");
  info.size = 0;
  expect_fails(fragmotion_character_info(hero, &info), size, "is 0");
  for (const int index : {-1, bones, 1 << 30})
    expect_fails(fragmotion_character_bone(hero, index, &bone), wrong, "bone");
  expect_fails(fragmotion_character_bone(hero, 0, nullptr), wrong, "null");
  expect_fails(fragmotion_character_bone(nullptr, 0, &bone), wrong, "null");
  expect_fails(fragmotion_character_move(hero, 4, &move), wrong, "move 4 does not exist; there are 4");
  expect_fails(fragmotion_character_move(nullptr, 0, &move), wrong, "null");
  expect_fails(fragmotion_character_move(hero, 0, nullptr), wrong, "null");
  expect_fails(fragmotion_character_style(hero, 2, &style), wrong, "style 2");
  expect_fails(fragmotion_character_style(nullptr, 0, &style), wrong, "null");
  expect_fails(fragmotion_character_style(hero, 0, nullptr), wrong, "null");
  EXPECT_EQ(fragmotion_character_class_name(nullptr, 0, 0), nullptr);
  EXPECT_EQ(fragmotion_character_class_name(hero, -1, 0), nullptr);
  for (const auto find :
       {&fragmotion_character_find_bone, &fragmotion_character_find_move, &fragmotion_character_find_style}) {
    EXPECT_EQ(find(nullptr, "x"), -1);
    EXPECT_EQ(find(hero, nullptr), -1);
  }

  FragmotionRig* rig = nullptr;
  FragmotionRigOptions rigs = fragmotion_rig_options();
  const char* names[] = {"hips", nullptr};
  const std::int32_t parents[] = {0, 5};
  const float binds[32] = {kNan};
  const FragmotionTransform rest[2] = {{{kEndless, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
  expect_fails(fragmotion_rig_create(hero, &rigs, &rig), wrong, "number of the rig's bones");
  rigs.bones = 2;
  expect_fails(fragmotion_rig_create(hero, &rigs, &rig), wrong, "names");
  rigs.names = names;
  expect_fails(fragmotion_rig_create(hero, &rigs, &rig), wrong, "bone 1 is null");
  names[1] = "spine";
  rigs.parents = parents;
  expect_fails(fragmotion_rig_create(hero, &rigs, &rig), wrong, "parents come before");
  rigs.parents = nullptr;
  rigs.rest = rest;
  expect_fails(fragmotion_rig_create(hero, &rigs, &rig), wrong, "rest");
  rigs.rest = nullptr;
  rigs.inverse_binds = binds;
  expect_fails(fragmotion_rig_create(hero, &rigs, &rig), wrong, "inverse binds");
  rigs.inverse_binds = nullptr;
  expect_fails(fragmotion_rig_create(nullptr, &rigs, &rig), wrong, "null");
  expect_fails(fragmotion_rig_create(hero, nullptr, &rig), wrong, "null");
  expect_fails(fragmotion_rig_create(hero, &rigs, nullptr), wrong, "null");
  EXPECT_EQ(rig, nullptr);
  EXPECT_EQ(fragmotion_rig_bone(nullptr, 0), -1);
  const auto other = loaded(tiny_character());
  expect_ok(fragmotion_rig_create(other.get(), &rigs, &rig));
  const Held<FragmotionRig> strange(rig);
  EXPECT_EQ(fragmotion_rig_bone(rig, 7), -1);

  FragmotionPlayer* made = nullptr;
  FragmotionPlayerOptions options = fragmotion_player_options();
  expect_fails(fragmotion_player_create(nullptr, nullptr, &made), wrong, "null");
  expect_fails(fragmotion_player_create(hero, nullptr, nullptr), wrong, "null");
  const auto refuse_options = [&](const char* why) {
    expect_fails(fragmotion_player_create(hero, &options, &made), wrong, why);
    expect_fails(fragmotion_player_set_options(player, &options), wrong, why);
    options = fragmotion_player_options();
  };
  for (double FragmotionPlayerOptions::*part :
       {&FragmotionPlayerOptions::responsiveness, &FragmotionPlayerOptions::root_adjustment,
        &FragmotionPlayerOptions::stitch, &FragmotionPlayerOptions::time_scale, &FragmotionPlayerOptions::fixed_step}) {
    for (const double value : {-1.0, 1000.0, std::nan("")}) {
      options.*part = value;
      refuse_options(" must be 0");
    }
  }
  options.step_interval = 0;
  refuse_options("step_interval");
  options.hold_feet = 2;
  refuse_options("hold_feet");
  options.cross_fades = 2;
  refuse_options("cross_fades");
  options.cross_fades = 1;
  expect_fails(fragmotion_player_set_options(player, &options), wrong, "chosen as a player is made");
  options = fragmotion_player_options();
  options.size = 12;
  expect_fails(fragmotion_player_create(hero, &options, &made), size, "is 12");
  options = fragmotion_player_options();
  expect_fails(fragmotion_player_set_options(nullptr, &options), wrong, "null");
  expect_fails(fragmotion_player_set_options(player, nullptr), wrong, "null");
  expect_fails(fragmotion_player_options_of(nullptr, &options), wrong, "null");
  expect_fails(fragmotion_player_options_of(player, nullptr), wrong, "null");

  expect_fails(fragmotion_player_step(nullptr, &input, 0), wrong, "the player is null");
  expect_fails(fragmotion_player_step(player, nullptr, 0), wrong, "the input is null");
  for (const double seconds : {-1.0, 3601.0, std::nan(""), HUGE_VAL})
    expect_fails(fragmotion_player_step(player, &input, seconds), wrong, "the seconds of a step");
  for (int i = 0; i < 3; ++i) {
    for (const float value : {kNan, kEndless, 2e6F}) {
      input.move[i] = value;
      expect_fails(fragmotion_player_step(player, &input, 0), wrong, "move or facing");
      input = fragmotion_input();
      input.facing[i] = value;
      expect_fails(fragmotion_player_step(player, &input, 0), wrong, "move or facing");
      input = fragmotion_input();
    }
  }
  input.turn = kNan;
  expect_fails(fragmotion_player_step(player, &input, 0), wrong, "turn");
  input = fragmotion_input();
  input.steer = static_cast<FragmotionSteer>(-3);
  expect_fails(fragmotion_player_step(player, &input, 0), wrong, "no way -3 to steer");
  input = fragmotion_input();
  input.size = 1;
  expect_fails(fragmotion_player_step(player, &input, 0), size, "is 1");
  input = fragmotion_input();

  const FragmotionPlace nowhere{{kNan, 0, 0}, 0}, far{{0, 2e9F, 0}, 0}, dizzy{{0, 0, 0}, kEndless}, here{{0, 0, 0}, 0};
  for (const FragmotionPlace& place : {nowhere, far, dizzy}) {
    expect_fails(fragmotion_player_reset(player, &place, 0), wrong, "place");
    expect_fails(fragmotion_player_move_to(player, &place), wrong, "place");
  }
  expect_fails(fragmotion_player_reset(player, nullptr, 2), wrong, "style 2");
  expect_fails(fragmotion_player_reset(nullptr, nullptr, 0), wrong, "null");
  expect_fails(fragmotion_player_move_to(player, nullptr), wrong, "null");
  expect_fails(fragmotion_player_move_to(nullptr, &here), wrong, "null");
  expect_fails(fragmotion_player_set_ground(nullptr, nullptr, nullptr), wrong, "null");
  for (const auto press : {&fragmotion_player_start_move, &fragmotion_player_release_move,
                           &fragmotion_player_change_style, &fragmotion_player_force_class}) {
    expect_fails(press(nullptr, 0), wrong, "null");
    for (const int index : {-1, 4000}) expect_fails(press(player, index), wrong, "does not exist");
  }
  expect_fails(fragmotion_player_state(nullptr, &state), wrong, "null");
  expect_fails(fragmotion_player_state(player, nullptr), wrong, "null");
  std::int32_t count = 0;
  expect_fails(fragmotion_player_events(nullptr, nullptr, 0, &count), wrong, "null");
  expect_fails(fragmotion_player_events(player, nullptr, 0, nullptr), wrong, "null");
  expect_fails(fragmotion_player_events(player, nullptr, 3, &count), wrong, "null");
  expect_fails(fragmotion_player_events(player, nullptr, -3, &count), wrong, "capacity");
  expect_fails(fragmotion_player_pose(nullptr, nullptr, FRAGMOTION_SPACE_LOCAL, pose.data(), bones), wrong, "null");
  expect_fails(fragmotion_player_pose(player, nullptr, FRAGMOTION_SPACE_LOCAL, nullptr, bones), wrong, "null");
  expect_fails(fragmotion_player_pose(player, nullptr, FRAGMOTION_SPACE_LOCAL, pose.data(), bones - 1),
               FRAGMOTION_ERROR_CAPACITY, "room");
  expect_fails(fragmotion_player_pose(player, nullptr, static_cast<FragmotionSpace>(9), pose.data(), bones), wrong,
               "space 9");
  expect_fails(fragmotion_player_pose(player, rig, FRAGMOTION_SPACE_LOCAL, pose.data(), 2), wrong, "another character");
  float matrix[16];
  expect_fails(fragmotion_player_skinning(player, nullptr, FRAGMOTION_SPACE_MODEL, matrix, 1), wrong, "rig is null");
  expect_fails(fragmotion_player_skinning(player, rig, FRAGMOTION_SPACE_LOCAL, matrix, 1), wrong, "space 0");
  expect_fails(fragmotion_player_skinning(nullptr, rig, FRAGMOTION_SPACE_MODEL, matrix, 1), wrong, "null");
  FragmotionPlace places[2];
  expect_fails(fragmotion_player_foresee(nullptr, &input, 1, 2, places), wrong, "null");
  expect_fails(fragmotion_player_foresee(player, nullptr, 1, 2, places), wrong, "null");
  expect_fails(fragmotion_player_foresee(player, &input, kNan, 2, places), wrong, "seconds");
  expect_fails(fragmotion_player_foresee(player, &input, 1, 0, places), wrong, "number of places");
  expect_fails(fragmotion_player_foresee(player, &input, 1, 2, nullptr), wrong, "null");

  const float points[] = {0, 0, 0, 0, 5, 0}, strange_points[] = {0, kNan, 0, 0, 5, 0}, one_point[] = {0, 0, 1, 0, 0, 9},
              speeds[] = {1, -1};
  FragmotionPath path = fragmotion_path();
  const auto refuse_path = [&](const char* why) {
    expect_fails(fragmotion_player_set_path(player, &path), wrong, why);
    path = fragmotion_path();
    path.points = 2;
    path.positions = points;
  };
  refuse_path("number of the path's points");
  path.positions = nullptr;
  refuse_path("positions");
  path.positions = strange_points;
  refuse_path("path");
  path.positions = one_point;
  refuse_path("no length");
  path.speeds = speeds;
  refuse_path("speed at point 1");
  path.end = static_cast<FragmotionPathEnd>(5);
  refuse_path("end 5");
  path.speed = kNan;
  refuse_path("speed along the path");
  path.arrive = -1;
  refuse_path("arrival");
  path.facing[1] = kEndless;
  refuse_path("facing");
  path.size = 2;
  expect_fails(fragmotion_player_set_path(player, &path), size, "is 2");
  expect_fails(fragmotion_player_set_path(nullptr, nullptr), wrong, "null");

  unsigned char bytes[16] = {};
  std::size_t written = 0;
  std::uint64_t checksum = 0;
  EXPECT_EQ(fragmotion_player_save_size(nullptr), 0U);
  expect_fails(fragmotion_player_save(nullptr, bytes, 16, &written), wrong, "null");
  expect_fails(fragmotion_player_save(player, nullptr, 16, &written), wrong, "null");
  expect_fails(fragmotion_player_save(player, bytes, 16, nullptr), wrong, "null");
  expect_fails(fragmotion_player_save(player, bytes, 16, &written), FRAGMOTION_ERROR_CAPACITY, "room for 16 bytes");
  expect_fails(fragmotion_player_restore(nullptr, bytes, 16), wrong, "null");
  expect_fails(fragmotion_player_restore(player, nullptr, 16), wrong, "null");
  expect_fails(fragmotion_player_restore(player, bytes, 16), FRAGMOTION_ERROR_REFUSED, "no state");
  expect_fails(fragmotion_player_checksum(nullptr, &checksum), wrong, "null");
  expect_fails(fragmotion_player_checksum(player, nullptr), wrong, "null");

  FragmotionCrowd* crowd = nullptr;
  expect_fails(fragmotion_crowd_create(nullptr, nullptr, 2, 1, &crowd), wrong, "null");
  expect_fails(fragmotion_crowd_create(hero, nullptr, 2, 1, nullptr), wrong, "null");
  for (const int many : {-1, 100001})
    expect_fails(fragmotion_crowd_create(hero, nullptr, many, 1, &crowd), wrong, "number");
  expect_fails(fragmotion_crowd_create(hero, nullptr, 2, 0, &crowd), wrong, "part");
  expect_ok(fragmotion_crowd_create(hero, nullptr, 2, 9, &crowd));
  const Held<FragmotionCrowd> two(crowd);
  EXPECT_EQ(fragmotion_crowd_parts(crowd), 2);
  EXPECT_EQ(fragmotion_crowd_count(nullptr) + fragmotion_crowd_parts(nullptr), 0);
  EXPECT_EQ(fragmotion_crowd_player(crowd, 2), nullptr);
  EXPECT_EQ(fragmotion_crowd_player(nullptr, 0), nullptr);
  FragmotionInput inputs[2] = {fragmotion_input(), fragmotion_input()};
  inputs[1].turn = kNan;
  const std::uint64_t first = checksum_of(fragmotion_crowd_player(crowd, 0));
  expect_fails(fragmotion_crowd_step(crowd, inputs, 0.1F), wrong, "turn");
  expect_fails(fragmotion_crowd_step(crowd, nullptr, 0.1F), wrong, "null");
  expect_fails(fragmotion_crowd_step(nullptr, inputs, 0.1F), wrong, "null");
  expect_fails(fragmotion_crowd_step_part(crowd, 2, inputs, 0.1F), wrong, "part 2");
  expect_fails(fragmotion_crowd_step_part(nullptr, 0, inputs, 0.1F), wrong, "null");
  EXPECT_EQ(checksum_of(fragmotion_crowd_player(crowd, 0)), first) << "nobody is stepped";
  EXPECT_EQ(checksum_of(player), before) << "a call that fails changes nothing";
}

TEST(ApiErrors, SayThatAHandleWasReleased) {
  fragmotion_check_handles(1);
  auto hero = loaded(tiny_character());
  FragmotionPlayer* player = playing(*hero).release();
  const FragmotionInput input = fragmotion_input();
  FragmotionCrowd* crowd = nullptr;
  expect_ok(fragmotion_crowd_create(hero.get(), nullptr, 3, 1, &crowd));
  FragmotionPlayer* member = fragmotion_crowd_player(crowd, 1);
  fragmotion_player_release(member);  // a crowd's: refused
  EXPECT_NE(std::string(fragmotion_last_error()).find("goes with it"), std::string::npos);
  expect_ok(fragmotion_player_step(member, &input, 0.1F));
  const FragmotionCharacter* released = hero.get();
  hero.reset();
  expect_ok(fragmotion_player_step(player, &input, 0.1F));
  FragmotionPlayer* made = nullptr;
  expect_fails(fragmotion_player_create(released, nullptr, &made), FRAGMOTION_ERROR_HANDLE,
               "the character was released");
  fragmotion_player_release(player);
  fragmotion_crowd_release(crowd);
  expect_fails(fragmotion_player_step(player, &input, 0.1F), FRAGMOTION_ERROR_HANDLE, "the player was released");
  expect_fails(fragmotion_player_step(member, &input, 0.1F), FRAGMOTION_ERROR_HANDLE, "the player was released");
  expect_fails(fragmotion_crowd_step(crowd, &input, 0.1F), FRAGMOTION_ERROR_HANDLE, "the crowd was released");
  fragmotion_player_release(player);
  fragmotion_crowd_release(crowd);
  fragmotion_character_release(nullptr);
  fragmotion_rig_release(nullptr);
  fragmotion_check_handles(0);
  EXPECT_STREQ(fragmotion_result_text(FRAGMOTION_ERROR_HANDLE), "released handle");
  for (int result = 0; result < 12; ++result)
    EXPECT_NE(fragmotion_result_text(static_cast<FragmotionResult>(result)), nullptr);
  EXPECT_STREQ(fragmotion_version(), FRAGMOTION_VERSION_STRING);
}

}  // namespace
}  // namespace fragmotion
