// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "character/policy_file.hpp"
#include "fragmotion/fragmotion.h"
#include "made_styles.hpp"

namespace fragmotion {

struct Released {
  void operator()(FragmotionCharacter* handle) const { fragmotion_character_release(handle); }
  void operator()(FragmotionPlayer* handle) const { fragmotion_player_release(handle); }
  void operator()(FragmotionRig* handle) const { fragmotion_rig_release(handle); }
  void operator()(FragmotionCrowd* handle) const { fragmotion_crowd_release(handle); }
};
template <typename Handle>
using Held = std::unique_ptr<Handle, Released>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kEndless = std::numeric_limits<float>::infinity();

inline void expect_ok(FragmotionResult result) { ASSERT_EQ(result, FRAGMOTION_OK) << fragmotion_last_error(); }

inline void expect_fails(FragmotionResult result, FragmotionResult expected, const std::string& why) {
  EXPECT_EQ(result, expected) << fragmotion_last_error();
  EXPECT_NE(std::string(fragmotion_last_error()).find(why), std::string::npos) << fragmotion_last_error();
}

inline Held<FragmotionCharacter> loaded(const Character& character, FragmotionAxes axes = FRAGMOTION_AXES_BLENDER,
                                        float unit = 1) {
  const std::string bytes = to_bytes(character);
  FragmotionLoadOptions options = fragmotion_load_options();
  options.axes = axes;
  options.units_per_metre = unit;
  FragmotionCharacter* made = nullptr;
  expect_ok(fragmotion_character_load(bytes.data(), bytes.size(), &options, &made));
  return Held<FragmotionCharacter>(made);
}

inline Held<FragmotionPlayer> playing(const FragmotionCharacter& character,
                                      const FragmotionPlayerOptions& options = fragmotion_player_options()) {
  FragmotionPlayer* made = nullptr;
  expect_ok(fragmotion_player_create(&character, &options, &made));
  return Held<FragmotionPlayer>(made);
}

/// With moves and styles, in Blender's axes; loaded once.
inline const FragmotionCharacter& styled_api_character() {
  static const Held<FragmotionCharacter> character = loaded(*styled_character());
  return *character;
}

/// What a restless user asks for.
inline FragmotionInput wild_input(int frame) {
  FragmotionInput input = fragmotion_input();
  const int part = frame / 23;
  input.move[0] = static_cast<float>(part * 7 % 5 - 2);
  input.move[1] = static_cast<float>(part * 11 % 7 - 2);
  input.turn = static_cast<float>(part * 5 % 3 - 1);
  input.jump = part % 6 == 5 ? 1 : 0;
  return input;
}

/// And presses beside it.
template <typename Start, typename Release, typename Change>
void press_wildly(int frame, const Start& start, const Release& release, const Change& change) {
  if (frame % 140 == 20) start(frame / 140 % 4);
  if (frame % 140 == 90) release(frame / 140 % 4);
  if (frame % 170 == 60) change(frame / 170 % 2 == 0 ? 1 : 0);
}

inline void press_wildly(FragmotionPlayer* player, int frame) {
  press_wildly(
      frame, [&](int move) { expect_ok(fragmotion_player_start_move(player, move)); },
      [&](int move) { expect_ok(fragmotion_player_release_move(player, move)); },
      [&](int style) { expect_ok(fragmotion_player_change_style(player, style)); });
}

inline double hilly(double x, double y) { return 0.15 * std::sin(1.3 * x) + 0.1 * y; }

/// Hills, as a game in Blender's axes tells them.
inline std::int32_t hills(void* /*user*/, const float from[3], FragmotionGroundHit* hit) {
  hit->height = static_cast<float>(hilly(static_cast<double>(from[0]), static_cast<double>(from[1])));
  hit->normal[0] = static_cast<float>(-0.15 * 1.3 * std::cos(1.3 * static_cast<double>(from[0])));
  hit->normal[1] = -0.1F;
  hit->normal[2] = 1;
  return 1;
}

inline int bones_of(const FragmotionCharacter& character) {
  FragmotionCharacterInfo info = fragmotion_info();
  expect_ok(fragmotion_character_info(&character, &info));
  return info.bones;
}

inline std::vector<FragmotionTransform> pose_of(const FragmotionPlayer* player, FragmotionSpace space, int bones,
                                                const FragmotionRig* rig = nullptr) {
  std::vector<FragmotionTransform> pose(static_cast<std::size_t>(bones), {{9, 9, 9}, {9, 9, 9, 9}});
  expect_ok(fragmotion_player_pose(player, rig, space, pose.data(), bones));
  return pose;
}

inline FragmotionState state_of(const FragmotionPlayer* player) {
  FragmotionState state = fragmotion_state();
  expect_ok(fragmotion_player_state(player, &state));
  return state;
}

inline std::vector<FragmotionEvent> events_of(const FragmotionPlayer* player) {
  std::vector<FragmotionEvent> events(FRAGMOTION_MOST_EVENTS);
  std::int32_t count = 0;
  expect_ok(fragmotion_player_events(player, events.data(), FRAGMOTION_MOST_EVENTS, &count));
  events.resize(static_cast<std::size_t>(count));
  return events;
}

inline std::vector<unsigned char> saved(const FragmotionPlayer* player) {
  std::vector<unsigned char> bytes(fragmotion_player_save_size(player));
  std::size_t written = 0;
  expect_ok(fragmotion_player_save(player, bytes.data(), bytes.size(), &written));
  EXPECT_EQ(written, bytes.size());
  return bytes;
}

inline std::uint64_t checksum_of(const FragmotionPlayer* player) {
  std::uint64_t checksum = 0;
  expect_ok(fragmotion_player_checksum(player, &checksum));
  return checksum;
}

inline bool same(const FragmotionTransform& a, const FragmotionTransform& b) {
  return std::equal(a.position, a.position + 3, b.position) && std::equal(a.rotation, a.rotation + 4, b.rotation);
}

inline bool same(const std::vector<FragmotionTransform>& a, const std::vector<FragmotionTransform>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const FragmotionTransform& x, const FragmotionTransform& y) { return same(x, y); });
}

}  // namespace fragmotion
