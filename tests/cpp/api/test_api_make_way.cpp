// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "allocations.hpp"
#include "api_players.hpp"

namespace fragmotion {
namespace {

constexpr double kFrameOfCrowd = 1.0 / 30;
constexpr float kRoom = 0.4F;  // m around each

Held<FragmotionCrowd> crowd_of(const FragmotionCharacter& hero, int count) {
  FragmotionCrowd* made = nullptr;
  expect_ok(fragmotion_crowd_create(&hero, nullptr, count, 2, &made));
  return Held<FragmotionCrowd>(made);
}

struct Nearest {
  double nearest = 1e9;
  int frames = 0, close = 0;

  void look(const std::vector<std::array<double, 2>>& places) {
    double now = 1e9;
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k)
        now = std::min(now, std::hypot(places[i][0] - places[k][0], places[i][1] - places[k][1]));
    }
    nearest = std::min(nearest, now);
    close += now < 0.4 ? 1 : 0;
    ++frames;
  }
};

// On a square of 20 m, each from its place towards the one across the middle; half walk, half stand.
Nearest cross_a_square(int count, bool makes_way) {
  const auto hero = loaded(*gait_character());
  const auto crowd = crowd_of(*hero, count);
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<FragmotionInput> inputs(static_cast<std::size_t>(count), fragmotion_input());
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int k) { return 20 * (k / (side - 1.0F) - 0.5F); };
    const FragmotionPlace place{{at(i % side), at(i / side), 0}, static_cast<float>(i)};
    expect_ok(fragmotion_player_reset(fragmotion_crowd_player(crowd.get(), i), &place, 0));
  }
  Nearest found;
  std::vector<std::array<double, 2>> places(static_cast<std::size_t>(count));
  for (int frame = 0; frame < 600; ++frame) {
    for (int i = 0; i < count; ++i) {
      const FragmotionState state = state_of(fragmotion_crowd_player(crowd.get(), i));
      places[i] = {state.place.position[0], state.place.position[1]};
      FragmotionInput& input = inputs[i];
      input.steer = FRAGMOTION_STEER_WORLD;
      const float length = std::hypot(state.place.position[0], state.place.position[1]) + 0.01F;
      const float way = i % 2 == 0 || length < 1 ? 0.0F : 1.3F / length;
      input.move[0] = -way * state.place.position[0];
      input.move[1] = -way * state.place.position[1];
    }
    found.look(places);
    if (makes_way) expect_ok(fragmotion_crowd_make_way(crowd.get(), kRoom, kFrameOfCrowd, nullptr, 0));
    expect_ok(fragmotion_crowd_step(crowd.get(), inputs.data(), kFrameOfCrowd));
  }
  return found;
}

TEST(ApiMakeWay, KeepsTwoHundredOnASquareApart) {
  const Nearest heedless = cross_a_square(200, false), heeding = cross_a_square(200, true);
  std::printf("nearest %.2f m in %d frames, %d of them nearer than 0.4 m; heedless %.2f m, %d\n", heeding.nearest,
              heeding.frames, heeding.close, heedless.nearest, heedless.close);
  EXPECT_LT(heedless.nearest, 0.1);
  EXPECT_GT(heeding.nearest, 0.4);
}

// A hundred on a circle, each to the other side; or sixty, all to its middle.
Nearest cross_a_circle(int count, double radius, double beyond, int frames, int& arrived) {
  const auto hero = loaded(*gait_character());
  const auto crowd = crowd_of(*hero, count);
  std::vector<FragmotionInput> inputs(static_cast<std::size_t>(count), fragmotion_input());
  std::vector<std::array<double, 2>> places(inputs.size()), goals(inputs.size());
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count, x = radius * std::cos(angle), y = radius * std::sin(angle);
    const FragmotionPlace place{{static_cast<float>(x), static_cast<float>(y), 0}, static_cast<float>(angle + kPi / 2)};
    expect_ok(fragmotion_player_reset(fragmotion_crowd_player(crowd.get(), i), &place, 0));
    goals[i] = {-beyond * x, -beyond * y};
  }
  Nearest found;
  for (int frame = 0; frame < frames; ++frame) {
    arrived = 0;
    for (int i = 0; i < count; ++i) {
      const FragmotionState state = state_of(fragmotion_crowd_player(crowd.get(), i));
      places[i] = {state.place.position[0], state.place.position[1]};
      const double x = goals[i][0] - places[i][0], y = goals[i][1] - places[i][1], left = std::hypot(x, y);
      arrived += left < 1.5 ? 1 : 0;
      inputs[i].steer = FRAGMOTION_STEER_WORLD;
      inputs[i].move[0] = left < 1 ? 0 : static_cast<float>(1.3 * x / left);
      inputs[i].move[1] = left < 1 ? 0 : static_cast<float>(1.3 * y / left);
    }
    found.look(places);
    expect_ok(fragmotion_crowd_make_way(crowd.get(), kRoom, kFrameOfCrowd, nullptr, 0));
    expect_ok(fragmotion_crowd_step(crowd.get(), inputs.data(), kFrameOfCrowd));
  }
  std::printf("nearest %.2f m, %d arrived\n", found.nearest, arrived);
  return found;
}

TEST(ApiMakeWay, LetsNobodyTouchWhereAHundredGoThroughOnePlace) {
  int arrived = 0;
  EXPECT_GT(cross_a_circle(100, 20, 1, 3000, arrived).nearest, 0.4);
  EXPECT_EQ(arrived, 100);
}

TEST(ApiMakeWay, LetsNobodyTouchWhereSixtyWantToBe) {
  int arrived = 0;
  EXPECT_GT(cross_a_circle(60, 12, 0, 900, arrived).nearest, 0.4);
}

TEST(ApiMakeWay, GoesAroundWhoDoesNotYieldAndForgetsHim) {
  const auto hero = loaded(*gait_character());
  const auto crowd = crowd_of(*hero, 1);
  FragmotionPlayer* player = fragmotion_crowd_player(crowd.get(), 0);
  const FragmotionBody post{{0, 3, 0}, {0, 0, 0}, 0.3F};
  FragmotionInput input = fragmotion_input();
  input.steer = FRAGMOTION_STEER_WORLD;
  input.move[1] = input.facing[1] = 1.3F;
  double nearest = 1e9;
  const std::size_t before = allocations;
  for (int frame = 0; frame < 240; ++frame) {
    expect_ok(fragmotion_crowd_make_way(crowd.get(), kRoom, kFrameOfCrowd, &post, 1));
    expect_ok(fragmotion_crowd_step(crowd.get(), &input, kFrameOfCrowd));
    const FragmotionState state = state_of(player);
    nearest = std::min(nearest, std::hypot(state.place.position[0] - 0.0, state.place.position[1] - 3.0));
  }
  EXPECT_LE(allocations, before + 8) << "for one more, once";
  EXPECT_GT(nearest, 0.5);
  EXPECT_GT(state_of(player).place.position[1], 5);
}

TEST(ApiMakeWay, SaysWhatIsWrong) {
  const auto hero = loaded(*gait_character());
  const auto crowd = crowd_of(*hero, 2);
  const FragmotionResult wrong = FRAGMOTION_ERROR_ARGUMENT;
  FragmotionBody body{{0, 0, 0}, {0, 0, 0}, 0.3F};
  expect_fails(fragmotion_crowd_make_way(nullptr, 0.3F, 0.1, nullptr, 0), wrong, "null");
  for (const float radius : {0.0F, -1.0F, kNan, kEndless})
    expect_fails(fragmotion_crowd_make_way(crowd.get(), radius, 0.1, nullptr, 0), wrong, "radius");
  for (const double seconds : {-1.0, static_cast<double>(kNan), 1e9})
    expect_fails(fragmotion_crowd_make_way(crowd.get(), 0.3F, seconds, nullptr, 0), wrong, "seconds");
  for (const int count : {-1, 1 << 30})
    expect_fails(fragmotion_crowd_make_way(crowd.get(), 0.3F, 0.1, &body, count), wrong, "others");
  expect_fails(fragmotion_crowd_make_way(crowd.get(), 0.3F, 0.1, nullptr, 1), wrong, "others");
  for (float* number : {&body.position[1], &body.velocity[0], &body.radius}) {
    const float kept = *number;
    for (const float not_one : {kNan, kEndless}) {
      *number = not_one;
      EXPECT_EQ(fragmotion_crowd_make_way(crowd.get(), 0.3F, 0.1, &body, 1), wrong);
    }
    *number = kept;
  }
}

}  // namespace
}  // namespace fragmotion
