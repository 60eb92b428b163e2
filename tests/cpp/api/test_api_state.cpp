// SPDX-License-Identifier: MIT
#include <random>

#include "api_players.hpp"

namespace fragmotion {
namespace {

constexpr double kStateFrame = 1.0 / 60;
constexpr std::size_t kStateHead = 16, kStateTail = 8;

void go_wildly(FragmotionPlayer* player, int begin, int end) {
  for (int frame = begin; frame < end; ++frame) {
    press_wildly(player, frame);
    if (frame % 61 == 0) {
      const float place[] = {static_cast<float>(frame % 7), 2, 1};
      expect_ok(fragmotion_player_look(player, frame / 61 % 3, place));
      const FragmotionReach held{
          {place[0], place[1], place[2]}, frame / 61 % 2, 0.5F * static_cast<float>(frame / 61 % 3)};
      expect_ok(fragmotion_player_reach(player, frame / 61 % 2, &held));
    }
    FragmotionInput input = wild_input(frame);
    if (frame / 50 % 4 == 3) {
      input.steer = FRAGMOTION_STEER_CAMERA;
      input.facing[0] = 1;
      input.move[0] = 0.3F;
      input.move[1] = -0.9F;
    }
    if (frame / 50 % 4 == 1) input.steer = FRAGMOTION_STEER_PATH;
    expect_ok(fragmotion_player_step(player, &input, kStateFrame));
  }
}

void set_square(FragmotionPlayer* player) {
  const float points[] = {0, 0, 0, 0, 6, 0, 6, 6, 0};
  FragmotionPath path = fragmotion_path();
  path.points = 3;
  path.positions = points;
  path.closed = 1;
  path.end = FRAGMOTION_PATH_LOOP;
  expect_ok(fragmotion_player_set_path(player, &path));
}

// Save at any moment, play on, go back: the same again, in this player and in another.
void expect_rollback(const FragmotionPlayerOptions& options, bool with_ground, bool moved) {
  const auto one = playing(styled_api_character(), options), other = playing(styled_api_character(), options);
  const int bones = bones_of(styled_api_character());
  for (FragmotionPlayer* player : {one.get(), other.get()}) {
    set_square(player);
    if (with_ground) expect_ok(fragmotion_player_set_ground(player, &hills, nullptr));
  }
  go_wildly(other.get(), 77, 300);
  for (int frame = 0; frame < 900; frame += 53) {
    go_wildly(one.get(), frame, frame + 53);
    if (moved) {
      const FragmotionPlace place{{3, static_cast<float>(frame), 1}, 1};
      expect_ok(fragmotion_player_move_to(one.get(), &place));
    }
    const std::vector<unsigned char> bytes = saved(one.get());
    const std::uint64_t then = checksum_of(one.get());
    const auto shown = pose_of(one.get(), FRAGMOTION_SPACE_WORLD, bones);
    go_wildly(one.get(), frame + 53, frame + 93);
    const std::uint64_t later = checksum_of(one.get());
    const auto shown_later = pose_of(one.get(), FRAGMOTION_SPACE_WORLD, bones);
    ASSERT_NE(then, later);
    for (FragmotionPlayer* player : {one.get(), other.get()}) {
      expect_ok(fragmotion_player_restore(player, bytes.data(), bytes.size()));
      ASSERT_EQ(checksum_of(player), then) << frame;
      ASSERT_EQ(saved(player), bytes);
      ASSERT_TRUE(same(pose_of(player, FRAGMOTION_SPACE_WORLD, bones), shown));
      go_wildly(player, frame + 53, frame + 93);
      ASSERT_EQ(checksum_of(player), later) << frame;
      ASSERT_TRUE(same(pose_of(player, FRAGMOTION_SPACE_WORLD, bones), shown_later));
    }
    expect_ok(fragmotion_player_restore(one.get(), bytes.data(), bytes.size()));
  }
}

TEST(ApiState, GoesBackToTheBit) { expect_rollback(fragmotion_player_options(), false, false); }

TEST(ApiState, GoesBackToTheBitOnHillsWhereItWasMoved) { expect_rollback(fragmotion_player_options(), true, true); }

TEST(ApiState, GoesBackToAWalkMuchSlowerThanTheTakes) {
  const auto character = loaded(tiny_character({tiny_clip(0), tiny_clip(2.5)}));
  const auto player = playing(*character);
  FragmotionInput input = fragmotion_input();
  input.move[1] = 0.35F;
  for (int frame = 0; frame < 240; ++frame) expect_ok(fragmotion_player_step(player.get(), &input, kStateFrame));
  const std::vector<unsigned char> bytes = saved(player.get());
  expect_ok(fragmotion_player_restore(player.get(), bytes.data(), bytes.size()));
}

TEST(ApiState, GoesBackToTheBitBetweenFixedSteps) {
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.fixed_step = 1.0 / 45;
  options.responsiveness = 0.8;
  expect_rollback(options, false, false);
}

TEST(ApiState, GoesBackToTheBitWithinCrossFades) {
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.cross_fades = 1;
  expect_rollback(options, false, false);
}

TEST(ApiState, GoesBackToTheBitFarAway) {
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.step_interval = 2;
  options.hold_feet = 0;
  expect_rollback(options, false, false);
}

TEST(ApiState, IsRefusedWhereItIsNoneOfThisPlayer) {
  const auto player = playing(styled_api_character());
  go_wildly(player.get(), 0, 200);
  const std::vector<unsigned char> bytes = saved(player.get());
  const std::uint64_t before = checksum_of(player.get());
  const auto refused = [&](std::vector<unsigned char> other, std::size_t size, const char* why) {
    EXPECT_EQ(fragmotion_player_restore(player.get(), other.data(), size), FRAGMOTION_ERROR_REFUSED) << why;
    EXPECT_NE(std::string(fragmotion_last_error()).find(why), std::string::npos) << fragmotion_last_error();
    EXPECT_EQ(checksum_of(player.get()), before);
  };
  refused(bytes, bytes.size() - 8, "cut short");
  refused(bytes, 3, "no state");
  std::vector<unsigned char> changed = bytes;
  changed[100] ^= 1;
  refused(changed, changed.size(), "damaged");
  const auto gait = loaded(*gait_character());
  const auto other = playing(*gait);
  refused(saved(other.get()), saved(other.get()).size(), "of another character");
  set_square(player.get());
  EXPECT_EQ(fragmotion_player_restore(player.get(), bytes.data(), bytes.size()), FRAGMOTION_ERROR_REFUSED);
  expect_ok(fragmotion_player_set_path(player.get(), nullptr));
  changed = bytes;
  ++changed[8];
  EXPECT_EQ(fragmotion_player_restore(player.get(), changed.data(), changed.size()), FRAGMOTION_ERROR_NEWER_VERSION);
  expect_ok(fragmotion_player_restore(player.get(), bytes.data(), bytes.size()));
}

std::int32_t counted_stairs(void* asked, const float from[3], FragmotionGroundHit* hit) {
  ++*static_cast<int*>(asked);
  *hit = {0.17F * std::floor(from[1] / 0.3F), {0, 0, 1}};
  return 1;
}

TEST(ApiState, AsksForTheGroundAtMostEightTimesAStepRolledBackAndMovedToo) {
  const auto player = playing(styled_api_character());
  int asked = 0;
  expect_ok(fragmotion_player_set_ground(player.get(), &counted_stairs, &asked));
  const auto go = [&](int begin, int end) {
    for (int frame = begin; frame < end; ++frame) {
      asked = 0;
      go_wildly(player.get(), frame, frame + 1);
      EXPECT_LE(asked, 8) << frame;
    }
  };
  for (int frame = 0; frame < 1800; frame += 8) {
    const std::vector<unsigned char> bytes = saved(player.get());
    go(frame, frame + 8);
    const std::uint64_t there = checksum_of(player.get());
    expect_ok(fragmotion_player_restore(player.get(), bytes.data(), bytes.size()));
    go(frame, frame + 8);
    EXPECT_EQ(checksum_of(player.get()), there) << frame;
    const FragmotionPlace place{{1, static_cast<float>(frame), 2}, 0.5F};
    if (frame % 400 == 0) expect_ok(fragmotion_player_move_to(player.get(), &place));
  }
}

// Any word of a state changed, and the checksum put right: it is refused, or plays numbers.
TEST(ApiState, PlaysNumbersWhateverAStrangersBytesSay) {
  const auto player = playing(styled_api_character());
  const int bones = bones_of(styled_api_character());
  set_square(player.get());
  expect_ok(fragmotion_player_set_ground(player.get(), &hills, nullptr));
  go_wildly(player.get(), 0, 100);
  std::mt19937 random(3);
  int restored = 0;
  for (int round = 0; round < 3000; ++round) {
    if (round % 300 == 0) go_wildly(player.get(), round, round + 40);
    std::vector<unsigned char> bytes = saved(player.get());
    const std::size_t words = (bytes.size() - kStateHead - kStateTail) / 8;
    std::string what;
    for (int change = 0; change < 3; ++change) {
      const std::size_t number = random() % words;
      unsigned char* word = &bytes[kStateHead + 8 * number];
      const double strange[] = {0, -1, 1e9, -1e13, std::nan(""), 1e308, 1e-300, 3, 0.5};
      const std::int64_t numbers[] = {0, 1, -1, 2, 5, 40, 100, 1000, 1LL << 40};
      if (random() % 2 == 0)
        std::memcpy(word, &strange[random() % 9], 8);
      else
        std::memcpy(word, &numbers[random() % 9], 8);
      double value = 0;
      std::memcpy(&value, word, 8);
      what += " word " + std::to_string(number) + " is " + std::to_string(value);
    }
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (std::size_t at = kStateHead; at + kStateTail < bytes.size(); at += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, &bytes[at], 8);
      hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 32;
    }
    std::memcpy(&bytes[bytes.size() - kStateTail], &hash, 8);
    const std::vector<unsigned char> good = saved(player.get());
    if (fragmotion_player_restore(player.get(), bytes.data(), bytes.size()) != FRAGMOTION_OK) {
      ASSERT_EQ(saved(player.get()), good);
      continue;
    }
    ++restored;
    for (int frame = 0; frame < 3; ++frame) {
      const FragmotionInput input = wild_input(17 * round + frame);
      expect_ok(fragmotion_player_step(player.get(), &input, 0.1F));
      for (const FragmotionTransform& bone : pose_of(player.get(), FRAGMOTION_SPACE_MODEL, bones)) {
        for (const float value : bone.rotation) ASSERT_TRUE(std::isfinite(value)) << round << what;
      }
    }
    expect_ok(fragmotion_player_restore(player.get(), good.data(), good.size()));
  }
  EXPECT_GT(restored, 300);
}

}  // namespace
}  // namespace fragmotion
