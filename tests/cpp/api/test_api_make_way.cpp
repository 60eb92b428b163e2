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

// So many on a circle, each towards its goal, which lies so many radii beyond the middle. Where it is uneven by so much
// of the radius they do not mirror each other.
class Circle {
 public:
  Circle(int count, double radius, double beyond, float room, double uneven = 0)
      : hero_(loaded(*gait_character())), crowd_(crowd_of(*hero_, count)), room_(room) {
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * kPi * i / count, from = radius * (1 + uneven * std::sin(7.0 * i)),
                   x = from * std::cos(angle), y = from * std::sin(angle);
      const FragmotionPlace place{{static_cast<float>(x), static_cast<float>(y), 0},
                                  static_cast<float>(angle + kPi / 2)};
      expect_ok(fragmotion_player_reset(player(i), &place, 0));
      goals_.push_back({-beyond * x, -beyond * y});
    }
    places_.resize(goals_.size());
    inputs_.assign(goals_.size(), fragmotion_input());
  }

  FragmotionPlayer* player(int i) const { return fragmotion_crowd_player(crowd_.get(), i); }
  const Nearest& nearest() const { return nearest_; }

  int arrived() const {
    int count = 0;
    for (std::size_t i = 0; i < goals_.size(); ++i) count += left(i) < 1.5 ? 1 : 0;
    return count;
  }

  double mean_speed() const {
    double speed = 0;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      const FragmotionState state = state_of(player(static_cast<int>(i)));
      speed += std::hypot(state.velocity[0], state.velocity[1]) / static_cast<double>(goals_.size());
    }
    return speed;
  }

  void play(int frames) {
    for (int frame = 0; frame < frames; ++frame) {
      for (std::size_t i = 0; i < goals_.size(); ++i) ask(i);
      nearest_.look(places_);
      expect_ok(fragmotion_crowd_make_way(crowd_.get(), room_, kFrameOfCrowd, nullptr, 0));
      expect_ok(fragmotion_crowd_step(crowd_.get(), inputs_.data(), kFrameOfCrowd));
    }
  }

 private:
  double left(std::size_t i) const { return std::hypot(goals_[i][0] - places_[i][0], goals_[i][1] - places_[i][1]); }

  void ask(std::size_t i) {
    const FragmotionState state = state_of(player(static_cast<int>(i)));
    places_[i] = {state.place.position[0], state.place.position[1]};
    inputs_[i].steer = FRAGMOTION_STEER_WORLD;
    for (int k = 0; k < 2; ++k) {
      inputs_[i].move[k] = left(i) < 1 ? 0 : static_cast<float>(1.3 * (goals_[i][k] - places_[i][k]) / left(i));
    }
  }

  Held<FragmotionCharacter> hero_;
  Held<FragmotionCrowd> crowd_;
  float room_;
  std::vector<FragmotionInput> inputs_;
  std::vector<std::array<double, 2>> goals_, places_;
  Nearest nearest_;
};

TEST(ApiMakeWay, LetsNobodyTouchWhereAHundredGoThroughOnePlace) {
  Circle circle(100, 20, 1, kRoom);
  circle.play(3000);
  std::printf("nearest %.2f m, %d arrived\n", circle.nearest().nearest, circle.arrived());
  EXPECT_GT(circle.nearest().nearest, 0.4);
  EXPECT_EQ(circle.arrived(), 100);
}

TEST(ApiMakeWay, LetsNobodyTouchWhereSixtyWantToBe) {
  Circle circle(60, 12, 0, kRoom);
  circle.play(900);
  EXPECT_GT(circle.nearest().nearest, 0.4);
}

// Alone by what is next to what they want, each stands before the one who stands before him.
TEST(ApiMakeWay, LetsFewPassWhoAllWaitForEachOther) {
  for (const int count : {4, 6, 8, 12}) {
    Circle circle(count, 3, 1, 0.35F);
    circle.play(450);
    EXPECT_EQ(circle.arrived(), count);
    EXPECT_GT(circle.nearest().nearest, 0.4) << count;
  }
}

TEST(ApiMakeWay, LetsThoseWaitWhoCannotAllBeInOnePlace) {
  for (const double uneven : {0.0, 0.05, 0.1}) {
    Circle circle(20, 6, 0, kRoom, uneven);
    double least = 1e9;
    for (int second = 0; second < (uneven == 0 ? 40 : 60); ++second) {
      circle.play(30);
      least = std::min(least, circle.mean_speed());
    }
    EXPECT_LT(least, 0.1) << "they do not circle for ever: " << uneven;
  }
}

// He would go between those who stay on his way and at his right hand.
TEST(ApiMakeWay, StepsAsideForWhoCannotGetPast) {
  const auto hero = loaded(*gait_character());
  const auto crowd = crowd_of(*hero, 3);
  const float places[3][2] = {{0, 0}, {0.78F, 0.21F}, {-0.26F, -0.9F}};
  for (int i = 0; i < 3; ++i) {
    const FragmotionPlace place{{places[i][0], places[i][1], 0}, static_cast<float>(-kPi / 2)};
    expect_ok(fragmotion_player_reset(fragmotion_crowd_player(crowd.get(), i), &place, 0));
  }
  std::vector<FragmotionInput> inputs(3, fragmotion_input());
  for (FragmotionInput& input : inputs) input.steer = FRAGMOTION_STEER_WORLD;
  inputs[0].move[0] = 1.3F;
  Nearest found;
  std::vector<std::array<double, 2>> at(3);
  for (int frame = 0; frame < 300; ++frame) {
    expect_ok(fragmotion_crowd_make_way(crowd.get(), kRoom, kFrameOfCrowd, nullptr, 0));
    expect_ok(fragmotion_crowd_step(crowd.get(), inputs.data(), kFrameOfCrowd));
    for (int i = 0; i < 3; ++i) {
      const FragmotionState state = state_of(fragmotion_crowd_player(crowd.get(), i));
      at[i] = {state.place.position[0], state.place.position[1]};
    }
    found.look(at);
  }
  EXPECT_GT(at[0][0], 5);
  EXPECT_GT(found.nearest, 0.4);
  for (int i = 1; i < 3; ++i) EXPECT_LT(std::hypot(at[i][0] - places[i][0], at[i][1] - places[i][1]), 2) << i;
}

TEST(ApiMakeWay, GoesBackToTheBit) {
  constexpr int kCount = 12;
  Circle circle(kCount, 4, 0, kRoom);
  circle.play(300);
  std::vector<std::vector<unsigned char>> states;
  for (int i = 0; i < kCount; ++i) states.push_back(saved(circle.player(i)));
  const auto checksums = [&] {
    std::vector<std::uint64_t> sums;
    for (int i = 0; i < kCount; ++i) sums.push_back(checksum_of(circle.player(i)));
    return sums;
  };
  circle.play(60);
  const auto later = checksums();
  for (int i = 0; i < kCount; ++i) {
    expect_ok(fragmotion_player_restore(circle.player(i), states[i].data(), states[i].size()));
  }
  circle.play(60);
  EXPECT_EQ(checksums(), later);
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
