// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "motion/bladed_stance.hpp"
#include "motion/in_place.hpp"
#include "small_build.hpp"

namespace fragmotion {
namespace {

constexpr double kBlade = 0.7;  // rad to the left

/// A take that goes straight where `way` (rad from ahead, to the left) says, hips turned by `hips` and the head by
/// `head` from there; ahead is where the humanoid faces at rest.
Clip take(double way, double hips, double head, double speed = 1.2) {
  Gait gait;
  gait.x = -speed * std::sin(way - hips);
  gait.y = speed * std::cos(way - hips);
  gait.heading = kPi + hips;
  const Skeleton skeleton = humanoid();
  Clip clip = gait_clip(gait, "take");
  for (int f = 0; f < clip.frames; ++f) {
    double* turn = &clip.rotations[4 * (std::size_t(f) * skeleton.size() + skeleton.roles.head)];
    store_quaternion(CharacterFrame{{0, 0}, head - hips}.rotation(), turn);
  }
  return clip;
}

std::vector<Clip> aiming(double blade = kBlade) {
  return {take(0, blade, 0, 0), take(0, blade, 0), take(kPi, blade - 0.1, 0), take(kPi / 2, blade + 0.1, 0),
          take(0, blade, 0, 3)};
}

double stance(const std::vector<Clip>& takes) { return bladed_stance(Kinematics(humanoid()), takes); }

TEST(BladedStance, IsHowFarTheHipsOfABodyThatAimsAreTurned) {
  for (const double blade : {kBlade, -kBlade}) EXPECT_NEAR(stance(aiming(blade)), blade, 0.03);
  EXPECT_NEAR(stance({take(0, kBlade, 0.2)}), kBlade, 0.03);
}

TEST(BladedStance, IsNoneOfABodyThatFacesAsItsHips) {
  EXPECT_EQ(stance(gait_takes()), 0);
  for (const double hips : {0.0, 0.3, kPi / 4, kPi / 2}) {
    EXPECT_EQ(stance({take(hips, hips, hips), take(hips + kPi / 2, hips, hips)}), 0) << hips;
    EXPECT_EQ(stance({take(0, hips, hips), take(kPi / 2, hips, hips)}), 0)
        << "as an actor who faces elsewhere " << hips;
  }
}

TEST(BladedStance, IsNoneOfASidestep) {
  EXPECT_EQ(stance({take(kPi / 2, 0, 0), take(-kPi / 2, 0, 0)}), 0);
  EXPECT_EQ(stance({take(kPi / 2, kBlade, 0), take(kPi / 2, kBlade, 0.2)}), 0) << "hips turn with the way";
}

TEST(BladedStance, IsNoneWhereOneTakeThatGoesDoesNotAgree) {
  Gait curve;
  curve.turn = 0.8;
  for (const Clip& other : {take(0, 0, 0), take(0, -kBlade, 0), take(0, kBlade, kBlade), gait_clip(curve)}) {
    std::vector<Clip> takes = aiming();
    takes.push_back(other);
    EXPECT_EQ(stance(takes), 0);
  }
}

TEST(BladedStance, BuildLearnsAWalkAheadAsOneAhead) {
  const std::vector<Clip> takes{take(0, kBlade, 0, 0), take(0, kBlade, 0)};
  BuildOptions options = few_classes();
  options.mirror = options.synthesize = false;
  const Character c = build(humanoid(), takes, some_traces(), options);
  for (const Fragment& f : c.pool.fragments) {
    if (f.clip == 0) continue;
    EXPECT_LT(std::abs(f.evident.x), 0.1) << f.begin;
  }
}

Clip on_the_spot(double way, double hips) {
  const Kinematics kinematics(humanoid());
  Clip clip = take(way, hips, 0, 2);
  for (int f = 0; f < clip.frames; ++f)
    clip.root_positions[std::size_t{3} * f] = clip.root_positions[std::size_t{3} * f + 1] = 0;
  const auto told = find_feet_way(kinematics, clip);
  return told ? led(kinematics, clip, *told) : clip;
}

// Games' sidesteps: the hips turn, in part, to where the body would go.
std::vector<Clip> on_the_spot(double turned) {
  std::vector<Clip> clips;
  for (const auto& [way, hips] : {std::pair{0.0, 0.3}, {kPi / 2, 1.7}, {-kPi / 2, -0.9}, {kPi, 0.3}})
    clips.push_back(on_the_spot(way + turned, hips + turned));
  return clips;
}

std::vector<double> told(const std::vector<Clip>& takes) { return take_told_turns(Kinematics(humanoid()), takes); }

TEST(ToldTurns, AreThoseOfClipsOnTheSpotFromWhereTheirHipsFaceHoweverTheRigRests) {
  const std::vector<double> hips{0.3, 1.7, -0.9, 0.3};
  for (const double rest : {0.0, 0.6, kPi}) {
    const std::vector<double> turns = told(on_the_spot(rest));
    for (std::size_t c = 0; c < hips.size(); ++c) EXPECT_NEAR(turns[c], -hips[c], 0.02) << c;
  }
  EXPECT_EQ(told(gait_takes()), std::vector<double>(gait_takes().size(), 0));
}

TEST(ToldTurns, AreNoneOfTakesThatGoEachWhereTheyFace) {
  std::vector<Clip> takes;
  for (const double way : {0.0, 0.3, 0.6, 1.1}) takes.push_back(on_the_spot(way, way));
  EXPECT_EQ(told(takes), std::vector<double>(4, 0));
}

TEST(ToldTurns, AreNoneOfTakesThatAllGoOneWay) {
  EXPECT_EQ(told({on_the_spot(0, 0.2), on_the_spot(0.1, -0.1)}), std::vector<double>(2, 0));
  EXPECT_NE(told({on_the_spot(0, 0.2), on_the_spot(kPi, 0.2)}), std::vector<double>(2, 0));
}

TEST(ToldTurns, AreThoseOfATakeWhoseWayIsKeptInItsFile) {
  const std::vector<Clip> clips = on_the_spot(0);
  std::vector<Clip> kept;
  for (const Clip& clip : clips) kept.push_back(clip_from_take(humanoid(), take_from_clip(humanoid(), clip)));
  EXPECT_EQ(told(kept), std::vector<double>(4, 0));
  for (Clip& clip : kept) clip.led = true;
  const std::vector<double> turns = told(clips), again = told(kept);
  for (std::size_t c = 0; c < turns.size(); ++c) EXPECT_NEAR(again[c], turns[c], 0.01) << c;
}

void turn_hips(Clip& clip, int f, double turn) {
  const Skeleton skeleton = humanoid();
  double* hips = &clip.rotations[4 * (std::size_t(f) * skeleton.size() + skeleton.roles.hips)];
  store_quaternion(CharacterFrame{{0, 0}, turn}.rotation() * load_quaternion(hips), hips);
}

TEST(ToldTurns, AreNoneOfTakesThatTurn) {
  std::vector<Clip> clips = on_the_spot(0);
  for (Clip& clip : clips) {
    for (int f = 0; f < clip.frames; ++f) {
      turn_hips(clip, f, f / clip.rate);
      clip.headings[f] += f / clip.rate;
    }
  }
  EXPECT_EQ(told(clips), std::vector<double>(4, 0));
}

TEST(ToldTurns, AreThoseOfShortCyclesWhoseHipsSwayTogether) {
  const Skeleton skeleton = humanoid();
  const std::vector<double> hips{0.3, 1.7, -0.9, 0.3};
  std::vector<Clip> clips = on_the_spot(0);
  for (Clip& clip : clips) {
    clip.frames = 31;
    clip.root_positions.resize(std::size_t{3} * clip.frames);
    clip.rotations.resize(4 * skeleton.size() * clip.frames);
    for (int f = 0; f < clip.frames; ++f) turn_hips(clip, f, 0.6 * std::sin(2 * kPi * f / clip.rate));
    clip.headings.clear();
    clip = make_clip(skeleton, std::move(clip));
    clip.led = true;
    ASSERT_GT(std::abs(clip.headings.back() - clip.headings.front()), kPi / 12) << "as smoothed, it turns";
  }
  const std::vector<double> turns = told(clips);
  for (std::size_t c = 0; c < hips.size(); ++c) EXPECT_NEAR(turns[c], -hips[c], 0.05) << c;
}

TEST(ToldTurns, LetBuildLearnSidestepsAsThese) {
  BuildOptions options = few_classes();
  options.mirror = options.synthesize = false;
  const Character c = build(humanoid(), on_the_spot(0), some_traces(), options);
  const double ways[][2] = {{0, 2}, {-2, 0}, {2, 0}, {0, -2}};
  for (const Fragment& f : c.pool.fragments) {
    EXPECT_NEAR(f.evident.x, ways[f.clip][0], 0.3) << f.clip;
    EXPECT_NEAR(f.evident.y, ways[f.clip][1], 0.3) << f.clip;
  }
}

}  // namespace
}  // namespace fragmotion
