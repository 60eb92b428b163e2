// SPDX-License-Identifier: MIT
#include "api_players.hpp"

namespace fragmotion {
namespace {

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
  EXPECT_EQ(fragmotion_character_marker_name(nullptr, 0), nullptr);
  EXPECT_EQ(fragmotion_character_marker_name(hero, 0), nullptr);
  for (const auto find : {&fragmotion_character_find_bone, &fragmotion_character_find_move,
                          &fragmotion_character_find_style, &fragmotion_character_find_marker}) {
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

  const FragmotionPlace nowhere{{kNan, 0, 0}, 0}, high{{0, kNan, 0}, 0}, beside{{5, 0, kNan}, 0};
  const FragmotionPlace far{{0, 2e9F, 0}, 0}, dizzy{{0, 0, 0}, kEndless}, here{{0, 0, 0}, 0};
  for (const FragmotionPlace& place : {nowhere, high, beside, far, dizzy}) {
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
  expect_fails(fragmotion_player_look(nullptr, FRAGMOTION_LOOK_AHEAD, nullptr), wrong, "null");
  expect_fails(fragmotion_player_look(player, FRAGMOTION_LOOK_AT, nullptr), wrong, "null");
  for (const FragmotionPlace& place : {nowhere, high, beside})
    expect_fails(fragmotion_player_look(player, FRAGMOTION_LOOK_AT, place.position), wrong, "not a number");
  expect_fails(fragmotion_player_look(player, FRAGMOTION_LOOK_AT, far.position), wrong, "farther");
  expect_fails(fragmotion_player_reach(nullptr, FRAGMOTION_LEFT_HAND, nullptr), wrong, "null");
  const FragmotionReach none{{0, 0, std::nanf("")}, 0, 1}, heavy{{0, 0, 0}, 0, 1.5F}, odd{{0, 0, 0}, 2, 1};
  expect_fails(fragmotion_player_reach(player, FRAGMOTION_LEFT_HAND, &none), wrong, "not a number");
  expect_fails(fragmotion_player_reach(player, FRAGMOTION_LEFT_HAND, &heavy), wrong, "weight");
  expect_fails(fragmotion_player_reach(player, FRAGMOTION_LEFT_HAND, &odd), wrong, "carried");
  for (const int look : {-1, 3}) expect_fails(fragmotion_player_look(player, look, far.position), wrong, "no look");
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
