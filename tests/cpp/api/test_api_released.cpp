// SPDX-License-Identifier: MIT
#include <functional>

#include "api_players.hpp"

namespace fragmotion {
namespace {

struct Call {
  const char* name;
  std::function<FragmotionResult()> call;
};

// Those that tell no result fail by what they return, and the error is the last one.
FragmotionResult failed_with(bool failed) {
  return failed && std::string(fragmotion_last_error()).find("released") != std::string::npos ? FRAGMOTION_ERROR_HANDLE
                                                                                              : FRAGMOTION_OK;
}

// Each function that takes a handle, with one that was released, and all else right.
TEST(ApiErrors, SayOfEachFunctionThatItsHandleWasReleased) {
  const auto hero = loaded(*gait_character());
  FragmotionRigOptions options = fragmotion_rig_options();
  const char* names[] = {"hips"};
  options.bones = 1;
  options.names = names;
  FragmotionRig* rig = nullptr;
  expect_ok(fragmotion_rig_create(hero.get(), &options, &rig));
  FragmotionCharacter* gone = loaded(*gait_character()).release();
  FragmotionPlayer* player = playing(*hero).release();
  FragmotionCrowd* crowd = nullptr;
  expect_ok(fragmotion_crowd_create(hero.get(), nullptr, 2, 1, &crowd));
  const auto alive = playing(*hero);
  fragmotion_check_handles(1);
  fragmotion_character_release(gone);
  fragmotion_player_release(player);
  fragmotion_crowd_release(crowd);
  fragmotion_rig_release(rig);

  FragmotionCharacterInfo info = fragmotion_info();
  FragmotionBone bone = fragmotion_bone();
  FragmotionMove move = fragmotion_move();
  FragmotionStyle style = fragmotion_style();
  FragmotionState state = fragmotion_state();
  FragmotionPlayerOptions told = fragmotion_player_options();
  const FragmotionInput inputs[2] = {fragmotion_input(), fragmotion_input()};
  FragmotionPlace place{{0, 0, 0}, 0};
  FragmotionTransform pose[64];
  FragmotionEvent event;
  float matrices[64 * 16];
  unsigned char bytes[65536];
  std::size_t written = 0;
  std::uint64_t sum = 0;
  std::int32_t count = 0;
  FragmotionPlayer* made = nullptr;
  FragmotionCrowd* many = nullptr;
  FragmotionRig* bound = nullptr;
  const Call calls[] = {
      {"character_info", [&] { return fragmotion_character_info(gone, &info); }},
      {"character_bone", [&] { return fragmotion_character_bone(gone, 0, &bone); }},
      {"character_move", [&] { return fragmotion_character_move(gone, 0, &move); }},
      {"character_style", [&] { return fragmotion_character_style(gone, 0, &style); }},
      {"character_class_name", [&] { return failed_with(!fragmotion_character_class_name(gone, 0, 0)); }},
      {"character_marker_name", [&] { return failed_with(!fragmotion_character_marker_name(gone, 0)); }},
      {"character_find_bone", [&] { return failed_with(fragmotion_character_find_bone(gone, "hips") < 0); }},
      {"character_find_move", [&] { return failed_with(fragmotion_character_find_move(gone, "x") < 0); }},
      {"character_find_style", [&] { return failed_with(fragmotion_character_find_style(gone, "x") < 0); }},
      {"character_find_marker", [&] { return failed_with(fragmotion_character_find_marker(gone, "x") < 0); }},
      {"rig_create", [&] { return fragmotion_rig_create(gone, &options, &bound); }},
      {"rig_bone", [&] { return failed_with(fragmotion_rig_bone(rig, 0) < 0); }},
      {"player_create", [&] { return fragmotion_player_create(gone, nullptr, &made); }},
      {"player_set_options", [&] { return fragmotion_player_set_options(player, &told); }},
      {"player_options_of", [&] { return fragmotion_player_options_of(player, &told); }},
      {"player_reset", [&] { return fragmotion_player_reset(player, &place, 0); }},
      {"player_move_to", [&] { return fragmotion_player_move_to(player, &place); }},
      {"player_set_ground", [&] { return fragmotion_player_set_ground(player, &hills, nullptr); }},
      {"player_step", [&] { return fragmotion_player_step(player, inputs, 0.1); }},
      {"player_start_move", [&] { return fragmotion_player_start_move(player, 0); }},
      {"player_release_move", [&] { return fragmotion_player_release_move(player, 0); }},
      {"player_change_style", [&] { return fragmotion_player_change_style(player, 0); }},
      {"player_reach", [&] { return fragmotion_player_reach(player, FRAGMOTION_LEFT_HAND, nullptr); }},
      {"player_look", [&] { return fragmotion_player_look(player, FRAGMOTION_LOOK_AHEAD, nullptr); }},
      {"player_force_class", [&] { return fragmotion_player_force_class(player, 0); }},
      {"player_state", [&] { return fragmotion_player_state(player, &state); }},
      {"player_events", [&] { return fragmotion_player_events(player, &event, 1, &count); }},
      {"player_pose", [&] { return fragmotion_player_pose(player, nullptr, FRAGMOTION_SPACE_LOCAL, pose, 15); }},
      {"player_pose", [&] { return fragmotion_player_pose(alive.get(), rig, FRAGMOTION_SPACE_LOCAL, pose, 1); }},
      {"player_skinning",
       [&] { return fragmotion_player_skinning(alive.get(), rig, FRAGMOTION_SPACE_MODEL, matrices, 1); }},
      {"player_foresee", [&] { return fragmotion_player_foresee(player, inputs, 0.1, 1, &place); }},
      {"player_set_path", [&] { return fragmotion_player_set_path(player, nullptr); }},
      {"player_save_size", [&] { return failed_with(fragmotion_player_save_size(player) == 0); }},
      {"player_save", [&] { return fragmotion_player_save(player, bytes, sizeof bytes, &written); }},
      {"player_restore", [&] { return fragmotion_player_restore(player, bytes, 100); }},
      {"player_checksum", [&] { return fragmotion_player_checksum(player, &sum); }},
      {"crowd_create", [&] { return fragmotion_crowd_create(gone, nullptr, 1, 1, &many); }},
      {"crowd_count", [&] { return failed_with(fragmotion_crowd_count(crowd) == 0); }},
      {"crowd_parts", [&] { return failed_with(fragmotion_crowd_parts(crowd) == 0); }},
      {"crowd_player", [&] { return failed_with(!fragmotion_crowd_player(crowd, 0)); }},
      {"crowd_make_way", [&] { return fragmotion_crowd_make_way(crowd, 0.3F, 0.1, nullptr, 0); }},
      {"crowd_step", [&] { return fragmotion_crowd_step(crowd, inputs, 0.1); }},
      {"crowd_step_part", [&] { return fragmotion_crowd_step_part(crowd, 0, inputs, 0.1); }},
  };
  for (const Call& each : calls) {
    EXPECT_EQ(each.call(), FRAGMOTION_ERROR_HANDLE) << each.name << ": " << fragmotion_last_error();
    EXPECT_NE(std::string(fragmotion_last_error()).find(each.name), std::string::npos) << fragmotion_last_error();
  }
  fragmotion_character_release(gone);  // again: is found, and harms nothing
  fragmotion_player_release(player);
  fragmotion_crowd_release(crowd);
  fragmotion_rig_release(rig);
  fragmotion_check_handles(0);
}

}  // namespace
}  // namespace fragmotion
