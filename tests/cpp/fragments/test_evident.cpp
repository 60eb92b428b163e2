// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fragments/coverage.hpp"
#include "motion/facing.hpp"
#include "small_skeleton.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

// A character on the spot whose hips turn at a constant rate and sway as a pelvis does in walking.
Clip turning_clip(double turn, double sway, double cycle, double rate, double seconds, double start = 0) {
  const Skeleton skeleton = humanoid();
  Clip clip;
  clip.name = "turning";
  clip.rate = rate;
  clip.frames = static_cast<int>(seconds * rate) + 1;
  for (int f = 0; f < clip.frames; ++f) {
    const double t = f / rate, heading = start + turn * t + sway * std::sin(2 * kPi * t / cycle);
    clip.root_positions.insert(clip.root_positions.end(), {0, 0, 0.96});
    for (int b = 0; b < skeleton.size(); ++b) {
      const double angle = b == 0 ? heading + kPi : 0;
      clip.rotations.insert(clip.rotations.end(), {std::cos(angle / 2), 0, 0, std::sin(angle / 2)});
    }
  }
  return clip;
}

TEST(Facing, FindsAConstantTurnToItsEnds) {
  const Kinematics kinematics(humanoid());
  for (const double turn : {-3.0, -0.5, 0.0, 1.2, 4.0}) {
    for (const double rate : {24.0, 29.97, 60.0, 120.0}) {
      const Clip clip = turning_clip(turn, 0, 1, rate, 3, 0.4);
      const std::vector<double> found = facing(kinematics, clip);
      ASSERT_EQ(found.size(), static_cast<std::size_t>(clip.frames));
      const double turns = std::round((found[0] - 0.4) / (2 * kPi)) * 2 * kPi;
      for (int f = 0; f < clip.frames; ++f) EXPECT_NEAR(found[f] - turns, 0.4 + turn * f / rate, 1e-9);
    }
  }
}

TEST(Facing, DoesNotTakeTheSwayOfThePelvisForTurning) {
  const Kinematics kinematics(humanoid());
  const double sway = 0.2, rate = 60;
  for (const double turn : {-1.0, 0.0, 1.2}) {
    const Clip clip = turning_clip(turn, sway, 1, rate, 4);
    const std::vector<double> found = facing(kinematics, clip);
    const int reach = static_cast<int>(rate);
    for (int f = 0; f < clip.frames; ++f) {
      const bool inside = f >= reach && f < clip.frames - reach;
      EXPECT_NEAR(found[f], turn * f / rate, inside ? 0.45 * sway : 1.1 * sway) << "frame " << f;
    }
  }
}

TEST(Facing, IsUnwrapped) {
  const Clip clip = turning_clip(5, 0.1, 1, 30, 6);
  const std::vector<double> found = facing(Kinematics(humanoid()), clip);
  for (int f = 1; f < clip.frames; ++f) EXPECT_LT(std::abs(found[f] - found[f - 1]), 0.5);
  EXPECT_NEAR(found.back() - found.front(), 30, 0.5);
}

TEST(Facing, TakesClipsOfTwoFrames) {
  Clip clip = turning_clip(1, 0, 1, 30, 1);
  clip.frames = 2;
  const std::vector<double> found = facing(Kinematics(humanoid()), clip);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[1] - found[0], 1.0 / 30, 1e-9);
}

TEST(SegmentMasses, SumToOneAndFallOnTheBody) {
  for (const Skeleton& skeleton : {humanoid(), small_skeleton()}) {
    const std::vector<double> masses = segment_masses(skeleton);
    ASSERT_EQ(masses.size(), static_cast<std::size_t>(skeleton.size()));
    EXPECT_NEAR(std::accumulate(masses.begin(), masses.end(), 0.0), 1, 1e-12);
    for (int b = 0; b < skeleton.size(); ++b) {
      EXPECT_GE(masses[b], 0);
      if (!skeleton.is_below(b, skeleton.roles.hips)) {
        EXPECT_EQ(masses[b], 0) << skeleton.names[b];
      }
    }
  }
}

TEST(SegmentMasses, AreDempstersWhereTheRolesAreKnown) {
  const Skeleton skeleton = humanoid();
  const std::vector<double> masses = segment_masses(skeleton);
  const auto mass = [&](const char* bone) { return masses[skeleton.find(bone)]; };
  EXPECT_NEAR(mass("head"), 0.081, 2e-3);
  EXPECT_NEAR(mass("thigh.L"), 0.1, 2e-3);
  EXPECT_NEAR(mass("shin.R"), 0.0465, 2e-3);
  EXPECT_NEAR(mass("foot.L"), 0.0145, 2e-3);
  EXPECT_NEAR(mass("upper_arm.L"), 0.028, 2e-3);
  EXPECT_NEAR(mass("forearm.R"), 0.016, 2e-3);
  EXPECT_NEAR(mass("hand.R"), 0.006, 2e-3);
  EXPECT_NEAR(mass("hips") + mass("spine"), 0.497, 3e-3);
}

TEST(SegmentMasses, AreEqualWithoutRoles) {
  Skeleton skeleton = humanoid();
  skeleton.roles.left_hand = -1;
  for (const double mass : segment_masses(skeleton)) EXPECT_NEAR(mass, 1.0 / skeleton.size(), 1e-12);
}

TEST(CenterOfMass, IsTheMeanOfTheBonesMiddlesByMass) {
  const Skeleton skeleton = humanoid();
  const Kinematics kinematics(skeleton);
  const Clip clip = make_clip(skeleton, random_clip(skeleton, 5, 3));
  const std::vector<double> masses = segment_masses(skeleton);
  const std::vector<Vector3> centers = center_of_mass(kinematics, clip);
  ASSERT_EQ(centers.size(), 5U);
  for (int f = 0; f < 5; ++f) {
    std::vector<Vector3> heads(skeleton.size());
    std::vector<Quaternion> rotations(skeleton.size());
    world(kinematics, clip, f, heads.data(), rotations.data());
    Vector3 expected = Vector3::Zero();
    for (int b = 0; b < skeleton.size(); ++b) {
      const Vector3 tail = heads[b] + rotations[b].toRotationMatrix() * skeleton.tips[b];
      expected += masses[b] * (heads[b] + tail) / 2;
    }
    EXPECT_LT((centers[f] - expected).norm(), 1e-12);
  }
}

TEST(CenterOfMass, GoesWithTheCharacter) {
  const Skeleton skeleton = humanoid();
  const Kinematics kinematics(skeleton);
  const Clip clip = gait_clip({});
  const CharacterFrame move{{3, -2}, 2};
  const std::vector<Vector3> before = center_of_mass(kinematics, clip),
                             after = center_of_mass(kinematics, moved(skeleton, clip, move));
  for (int f = 0; f < clip.frames; ++f) EXPECT_LT((after[f] - move.to_world(before[f])).norm(), 1e-12);
}

Control evident_of(const Gait& gait, const ControlSpace& space, int begin, int end) {
  const Kinematics kinematics(humanoid(gait.size));
  const Clip clip = gait_clip(gait);
  const BodyMotion motion = body_motion(kinematics, clip);
  Gait stand = gait;
  stand.x = stand.y = stand.turn = stand.jump = 0;
  const double usual = usual_height({body_motion(kinematics, gait_clip(stand))});
  return evident_control(motion, clip.rate, begin, end, usual, space);
}

TEST(EvidentControl, IsTheVelocityOfAStraightPathWhateverItsHeading) {
  const ControlSpace space;
  for (const double heading : {0.0, 1.0, -2.5}) {
    for (int direction = 0; direction < 8; ++direction) {
      Gait gait;
      gait.heading = heading;
      gait.x = 1.5 * std::cos(direction * kPi / 4);
      gait.y = 1.5 * std::sin(direction * kPi / 4);
      const Control found = evident_of(gait, space, 20, 50);  // a whole cycle
      EXPECT_NEAR(found.x, gait.x, 0.03);
      EXPECT_NEAR(found.y, gait.y, 0.03);
      EXPECT_NEAR(found.turn, 0, 0.02);
      EXPECT_EQ(found.jump, 0);
    }
  }
}

TEST(EvidentControl, IsTheTurnRateOfACurve) {
  const ControlSpace space;
  for (const double turn : {-1.5, -0.6, 0.6, 1.5}) {
    Gait gait;
    gait.turn = turn;
    const Control found = evident_of(gait, space, 30, 45);
    EXPECT_NEAR(found.turn, turn / space.turn_rate(), 0.05);
    EXPECT_NEAR(std::hypot(found.x, found.y), 1.2, 0.15);
  }
}

TEST(EvidentControl, StandingIsZero) {
  Gait gait;
  gait.y = 0;
  const Control found = evident_of(gait, ControlSpace(), 10, 20);
  for (const double value : {found.x, found.y, found.turn, found.jump}) EXPECT_NEAR(value, 0, 1e-9);
}

TEST(EvidentControl, ShowsAJumpByItsRise) {
  Gait gait;
  gait.y = 0;
  gait.jump = 0.3;
  EXPECT_EQ(evident_of(gait, ControlSpace(), 38, 53).jump, 1);
  EXPECT_EQ(evident_of(gait, ControlSpace(), 5, 20).jump, 0);
  gait.jump = 0.14;
  const double some = evident_of(gait, ControlSpace(), 38, 53).jump;
  EXPECT_GT(some, 0);
  EXPECT_LT(some, 1);
}

TEST(EvidentControl, ShowsTwoFifthsOfTheJumpThatItLeadsIntoOrOutOf) {
  constexpr double kRate = 60, kGravity = 9.81;
  for (const double height : {0.14, 0.3}) {
    const double flight = std::sqrt(8 * height / kGravity);  // s, from frame 60 on
    const int landing = 60 + static_cast<int>(std::lround(flight * kRate));
    BodyMotion motion;
    for (int f = 0; f <= landing + 40; ++f) {
      const double phase = std::clamp((f - 60) / kRate / flight, 0.0, 1.0);
      motion.center.emplace_back(0, 0, 1 + 4 * height * phase * (1 - phase));
      motion.heading.push_back(0);
      motion.in_gait.push_back(false);
    }
    const auto jump = [&](int begin, int end) {
      return evident_control(motion, kRate, begin, end, 1, ControlSpace()).jump;
    };
    const double whole = jump(60, landing);
    EXPECT_NEAR(whole, std::min(1.0, (height - 0.08) / 0.12), 0.02);
    EXPECT_EQ(jump(35, 60), 0);
    EXPECT_EQ(jump(landing + 1, landing + 30), 0);
    EXPECT_NEAR(jump(40, 62), 0.4 * whole, 0.03) << height;
    EXPECT_NEAR(jump(landing - 2, landing + 20), 0.4 * whole, 0.03) << height;
  }
}

TEST(EvidentControl, IsTheSameForAGiantInItsOwnSpace) {
  Gait gait;
  gait.turn = 0.7;
  gait.jump = 0.15;
  const double scale = 1.8 / stature(humanoid());
  const Control usual = evident_of(gait, ControlSpace(1.2, 3.3, 1.2, scale), 35, 50);
  gait.size = 10;
  const Control giant = evident_of(gait, ControlSpace(12, 33, 1.2, scale / 10), 35, 50);
  EXPECT_NEAR(giant.x, 10 * usual.x, 1e-6);
  EXPECT_NEAR(giant.y, 10 * usual.y, 1e-6);
  EXPECT_NEAR(giant.turn, usual.turn, 1e-9);
  EXPECT_NEAR(giant.jump, usual.jump, 1e-6);
}

TEST(UsualHeight, IsTheMedianOverAllClips) {
  BodyMotion low, high;
  for (int i = 0; i < 5; ++i) low.center.emplace_back(0, 0, 1 + 0.01 * i);
  for (int i = 0; i < 4; ++i) high.center.emplace_back(0, 0, 2);
  EXPECT_NEAR(usual_height({low, high}), 1.04, 1e-12);
  EXPECT_EQ(usual_height({}), 0);
}

TEST(Coverage, CountsEveryFragmentOnceAndMeasuresTheNearest) {
  const ControlSpace space;
  Random random(5);
  FragmentPool pool;
  for (int i = 0; i < 60; ++i) {
    Fragment fragment;
    fragment.evident = {7 * random.uniform() - 3.5, 7 * random.uniform() - 3.5, 2 * random.uniform() - 1,
                        random.uniform()};
    pool.fragments.push_back(fragment);
  }
  const Coverage found = coverage(pool.fragments, space);
  EXPECT_EQ(std::accumulate(found.counts.begin(), found.counts.end(), 0), 60);
  for (int c = 0; c < kPaperPoints; ++c) {
    int count = 0;
    double nearest = 1e9;
    for (const Fragment& f : pool.fragments) {
      count += space.nearest(f.evident) == c ? 1 : 0;
      nearest = std::min(nearest, space.distance(f.evident, space.point(c)));
    }
    EXPECT_EQ(found.counts[c], count);
    EXPECT_EQ(found.distances[c], nearest);
  }
}

}  // namespace
}  // namespace fragmotion
