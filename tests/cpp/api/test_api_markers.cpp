// SPDX-License-Identifier: MIT
#include <map>

#include "api_players.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;

/// gait_character() whose takes each have a marker "step" at frame 10, and with two moves that have some.
const Character& marked_character() {
  static const Character character = [] {
    Clip lunge = lunge_clip(), wave = wave_clip();
    lunge.markers = {{"whoosh", 0}, {"hit", 12.5}, {"done", lunge.frames - 1.0}};
    wave.markers = {{"hit", 20}};
    Character made = with_moves(*gait_character(), {{"lunge", lunge, false, 0.5, {}}, {"wave", wave, true, 0.5, {}}});
    for (PackedClip& clip : made.pool.clips) {
      if (clip.markers.empty()) clip.markers = {{"step", 10}};
    }
    return made;
  }();
  return character;
}

struct Heard {
  std::string name;
  int frame;  // of the game
};

// What a player tells by its markers for so long, with a move that is begun at frame 30.
std::vector<Heard> heard(const FragmotionCharacter& hero, FragmotionPlayer* player, int move, int frames,
                         double seconds = kFrameSeconds) {
  std::vector<Heard> all;
  for (int frame = 0; frame < frames; ++frame) {
    if (frame == 30) expect_ok(fragmotion_player_start_move(player, move));
    FragmotionInput input = fragmotion_input();
    input.move[1] = 1.2F;
    expect_ok(fragmotion_player_step(player, &input, seconds));
    for (const FragmotionEvent& event : events_of(player)) {
      if (event.type != FRAGMOTION_EVENT_MARKER) continue;
      all.push_back({fragmotion_character_marker_name(&hero, event.index), frame});
    }
  }
  return all;
}

std::vector<std::string> names_without_steps(const std::vector<Heard>& all) {
  std::vector<std::string> names;
  for (const Heard& one : all) {
    if (one.name != "step") names.push_back(one.name);
  }
  return names;
}

TEST(ApiMarkers, AreDescribedByNamesOnceEach) {
  const auto hero = loaded(marked_character());
  FragmotionCharacterInfo info = fragmotion_info();
  expect_ok(fragmotion_character_info(hero.get(), &info));
  ASSERT_EQ(info.markers, 4);
  for (int i = 0; i < info.markers; ++i) {
    EXPECT_EQ(fragmotion_character_find_marker(hero.get(), fragmotion_character_marker_name(hero.get(), i)), i);
  }
  EXPECT_EQ(fragmotion_character_find_marker(hero.get(), "fly"), -1);
  EXPECT_EQ(fragmotion_character_marker_name(hero.get(), 4), nullptr);
  EXPECT_NE(std::string(fragmotion_last_error()).find("marker 4 does not exist; there are 4"), std::string::npos);
}

TEST(ApiMarkers, OfAMoveAreToldOnceEachInTheirOrderFromItsFirstPoseToItsLast) {
  const auto hero = loaded(marked_character());
  for (const int step : {1, 7}) {
    const auto player = playing(*hero);
    const auto all = heard(*hero, player.get(), 0, 240 / step + 30, step * kFrameSeconds);
    EXPECT_EQ(names_without_steps(all), (std::vector<std::string>{"whoosh", "hit", "done"})) << step;
  }
}

TEST(ApiMarkers, AreToldWhenTheyArePassed) {
  const auto hero = loaded(marked_character());
  const auto player = playing(*hero);
  const auto all = heard(*hero, player.get(), 0, 270);
  std::map<std::string, int> at;
  for (const Heard& one : all) at[one.name] = one.frame;
  const double rate = marked_character().pool.clips[marked_character().moves[0].clip].rate;
  EXPECT_NEAR(at["hit"] - at["whoosh"], 12.5 / rate / kFrameSeconds, 1.5);
}

TEST(ApiMarkers, OfAMoveOfTheUpperBodyAreTold) {
  const auto hero = loaded(marked_character());
  const auto player = playing(*hero);
  const auto all = heard(*hero, player.get(), 1, 300);
  EXPECT_EQ(names_without_steps(all), std::vector<std::string>{"hit"});
}

// As seen by brute force from outside: the fragment that plays, and when its take shows the marker's frame.
TEST(ApiMarkers, OfTakesAreThoseOfTheFramesThatAreShown) {
  Player player(std::make_shared<const Character>(marked_character()));
  int told = 0, expected = 0;
  double before = player.playback().at();
  const auto* clip = &player.character().pool.clips[player.playback().fragment().clip];
  for (int frame = 0; frame < 4800; ++frame) {
    player.step({frame / 90 % 3 - 1.0, frame / 60 % 4 * 1.0, 0, 0}, kFrameSeconds);
    told += player.passed_markers()[0].count;
    const double now = player.playback().at();
    const auto* shown = &player.character().pool.clips[player.playback().fragment().clip];
    const double marked = shown->markers[0].frame, frames_a_step = shown->rate * kFrameSeconds * 2;
    const bool goes_on = shown == clip && now >= before && now - before < frames_a_step;
    expected += goes_on ? before < marked && marked <= now : marked <= now && now - marked < frames_a_step;
    clip = shown, before = now;
  }
  EXPECT_GT(told, 10);
  EXPECT_NEAR(told, expected, 0.25 * told) << "apart from what begins within a step";
}

TEST(ApiMarkers, AreToldAgainAfterARollback) {
  const auto hero = loaded(marked_character());
  const auto player = playing(*hero);
  heard(*hero, player.get(), 0, 36);
  const std::vector<unsigned char> state = saved(player.get());
  const auto first = heard(*hero, player.get(), 0, 29);
  expect_ok(fragmotion_player_restore(player.get(), state.data(), state.size()));
  const auto again = heard(*hero, player.get(), 0, 29);
  ASSERT_FALSE(first.empty());
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].frame, again[i].frame);
}

}  // namespace
}  // namespace fragmotion
