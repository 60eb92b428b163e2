// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "character/policy_file.hpp"
#include "made_moves.hpp"
#include "mocap_files.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

std::string refusal(const std::vector<MoveClip>& moves) {
  return error_of([&] { with_moves(*gait_character(), moves); });
}

Clip of_frames(const Clip& clip, int frames, double rate) {
  Clip cut = part(clip, 0, frames - 1);
  cut.rate = rate;
  return cut;
}

TEST(Moves, LeaveAllElseAsItWas) {
  const Character& before = *gait_character();
  EXPECT_TRUE(to_bytes(with_moves(*moving_character(), {})) == to_bytes(before));
  EXPECT_EQ(moving_character()->takes(), before.takes());
  EXPECT_EQ(moving_character()->entry_poses, before.entry_poses);
}

TEST(Moves, ComeBackAsTheyWereGiven) {
  const std::vector<MoveClip> moves = moves_of(*moving_character());
  ASSERT_EQ(moves.size(), 4U);
  EXPECT_EQ(moves[1].name, "long lunge");
  EXPECT_FALSE(moves[1].upper_body);
  EXPECT_TRUE(moves[2].upper_body);
  EXPECT_NEAR(moves[1].loop[0], 0.5, 1e-9);
  EXPECT_NEAR(moves[1].loop[1], 1, 1e-9);
  const Clip lunge = lunge_clip();
  ASSERT_EQ(moves[0].clip.rotations.size(), lunge.rotations.size());
  for (std::size_t i = 0; i < lunge.rotations.size(); i += 4) {
    const Quaternion kept = load_quaternion(&moves[0].clip.rotations[i]), given = load_quaternion(&lunge.rotations[i]);
    EXPECT_LT(kept.angularDistance(given), 0.01) << i;
  }
  EXPECT_TRUE(to_bytes(with_moves(*gait_character(), moves)) == to_bytes(*moving_character()));
}

TEST(Moves, AreInThePolicyFile) {
  const std::string bytes = to_bytes(*moving_character());
  const Character back = from_bytes(bytes);
  EXPECT_TRUE(to_bytes(back) == bytes);
  ASSERT_EQ(back.moves.size(), 4U);
  EXPECT_EQ(back.moves[3].name, "long wave");
  EXPECT_EQ(back.move_parts.size(), moving_character()->move_parts.size());
}

TEST(Moves, OfAFileThatIsCutShortAreRefused) {
  const std::string bytes = to_bytes(*moving_character());
  for (std::size_t size = bytes.size() - 1; size > bytes.size() - 300; --size) {
    EXPECT_NE(error_of([&] { from_bytes(bytes.substr(0, size)); }), "no error") << size;
  }
}

TEST(Moves, AreRefusedWithTheirNameAndTheCause) {
  const Clip wave = wave_clip();
  EXPECT_EQ(refusal({{"one", of_frames(wave, 1, 30), false, 0.5, {}}}),
            "the move \"one\" is of one frame: choose a range of frames");
  EXPECT_EQ(refusal({{"short", of_frames(wave, 2, 30), false, 0.5, {}}}),
            "the move \"short\" lasts 0.0333333 s: a move lasts 0.1 s to 60 s");
  EXPECT_EQ(refusal({{"long", of_frames(wave, 61, 0.99), false, 0.5, {}}}),
            "the move \"long\" lasts 60.6061 s: a move lasts 0.1 s to 60 s");
  EXPECT_EQ(refusal({{"other", tiny_clip(1), false, 0.5, {}}}),
            "the move \"other\" is of another rig, of 4 bones; the character's has 15");
  EXPECT_EQ(refusal({{"late", wave, false, 2.5, {}}}),
            "the move \"late\" is to wait 2.5 s for its moment, which is 0 s to 2 s");
  EXPECT_EQ(refusal({{"loop", wave, false, 0.5, {1, 2.5}}}),
            "the move \"loop\" is to loop from 1 s to 2.5 s: a loop lasts 0.1 s at least and is within the move, which "
            "lasts 2 s");
  EXPECT_EQ(refusal({{"a", wave, false, 0, {}}, {"a", wave, false, 0, {}}}),
            "the move \"a\" is there twice: give one of them another name");
  EXPECT_EQ(refusal({{"", wave, false, 0, {}}}), "a move has no name");
  EXPECT_EQ(refusal(std::vector<MoveClip>(257)), "257 moves are too many: a character has at most 256");
}

TEST(Moves, OfAnUpperBodyNeedOne) {
  const Character tiny = tiny_character();
  const auto add = [&](bool upper_body) { with_moves(tiny, {{"wave", tiny_clip(0), upper_body, 0.5, {}}}); };
  EXPECT_EQ(error_of([&] { add(false); }), "no error");
  EXPECT_EQ(error_of([&] { add(true); }),
            "the move \"wave\" is of the upper body, and this skeleton has no spine that carries two hands");
}

TEST(Moves, ThatAFileForgesAreRefused) {
  const auto forged = [](auto change) {
    Character character = *moving_character();
    change(character);
    return error_of([&] { to_bytes(character); });
  };
  EXPECT_EQ(forged([](Character&) {}), "no error");
  EXPECT_NE(forged([](Character& c) { c.moves[0].clip = 0; }), "no error");
  EXPECT_NE(forged([](Character& c) { c.moves[1].loop_end = 1000; }), "no error");
  EXPECT_NE(forged([](Character& c) { c.moves[0].wait = std::nan(""); }), "no error");
  EXPECT_NE(forged([](Character& c) { c.pool.fragments[0].clip = c.moves[0].clip; }), "no error");
  EXPECT_NE(forged([](Character& c) { c.moves.resize(300); }), "no error");
}

}  // namespace
}  // namespace fragmotion
