// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "fragments/body_tips.hpp"
#include "fragments/gait_edit.hpp"
#include "measured_clips.hpp"
#include "motion/legs.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

// A gait's cycle: frames after which its pose comes again.
int cycle_of(const Gait& gait, const Clip& clip) { return static_cast<int>(std::lround(gait.cycle * clip.rate)); }

TEST(Transformed, ByNothingIsTheSourceRoundAndRound) {
  Gait gait;
  gait.turn = 0.5;
  gait.heading = 1;
  const Clip clip = moved(kSkeleton, gait_clip(gait), {{2, -1}, 0.5});
  const int cycle = cycle_of(gait, clip), frames = std::min(2 * cycle + 7, clip.frames - 21);
  const Clip same = transformed(kKinematics, find_legs(kKinematics, {clip}), clip, find_contacts(kKinematics, clip), 20,
                                20 + cycle, frames, {});
  ASSERT_EQ(same.frames, frames + 1);
  EXPECT_EQ(same.rate, clip.rate);
  for (int f = 0; f < same.frames; ++f) {
    const Vector3 root = load_vector(&clip.root_positions[3 * (20 + f)]);
    EXPECT_LT((load_vector(&same.root_positions[3 * f]) - root).norm(), 1e-3) << f;
    EXPECT_NEAR(same.headings[f], clip.headings[20 + f], 1e-3);
    for (int b = 0; b < kSkeleton.size(); ++b) {
      const Quaternion q = load_quaternion(&same.rotations[std::size_t{4} * (f * kSkeleton.size() + b)]);
      const Quaternion p = load_quaternion(&clip.rotations[std::size_t{4} * ((20 + f) * kSkeleton.size() + b)]);
      EXPECT_LT(q.angularDistance(p), 0.01);
    }
  }
}

TEST(Transformed, LeadsBackToItsBeginning) {
  const Clip clip = gait_clip({1.2, 0, 0});
  const Legs legs = find_legs(kKinematics, {clip});
  GaitEdit change;
  change.direction = 0.7;
  change.speed = 1.3;
  for (const int length : {26, 28, 33}) {  // no cycles
    const Clip made =
        transformed(kKinematics, legs, clip, find_contacts(kKinematics, clip), 20, 20 + length, length, change);
    BodyTips tips(kSkeleton);
    const int stride = padded(tips.points());
    std::vector<float> first(std::size_t{3} * stride), last(first);
    for (const auto& [frame, rows] : {std::pair{0, &first}, std::pair{length, &last}}) {
      tips.pose(load_vector(&made.root_positions[3 * frame]),
                &made.rotations[std::size_t{4} * kSkeleton.size() * frame]);
      tips.write(frame_at(made, frame), rows->data(), stride, 0);
    }
    EXPECT_LT(tip_distance(first.data(), last.data(), stride) / tips.points(), 0.01) << length;
  }
}

TEST(Transformed, BackwardIsTheSourceBackward) {
  Gait gait;
  gait.turn = 0.5;
  const Clip clip = gait_clip(gait);
  const int cycle = cycle_of(gait, clip);
  const Clip back = transformed(kKinematics, find_legs(kKinematics, {clip}), clip, find_contacts(kKinematics, clip),
                                20 + cycle, 20, cycle, {});
  ASSERT_EQ(back.frames, cycle + 1);
  for (int f = 0; f < back.frames; ++f) {
    const int source = 20 + cycle - f;
    EXPECT_LT((load_vector(&back.root_positions[3 * f]) - load_vector(&clip.root_positions[3 * source])).norm(), 1e-3);
    EXPECT_NEAR(back.headings[f], clip.headings[source], 1e-3) << f;
    const std::size_t width = std::size_t{4} * kSkeleton.size();
    for (std::size_t b = 0; b < width; b += 4) {
      const Quaternion q = load_quaternion(&back.rotations[f * width + b]);
      EXPECT_LT(q.angularDistance(load_quaternion(&clip.rotations[source * width + b])), 0.01);
    }
  }
}

// How far the ball of the right foot is to the right of the left one's at least.
double least_apart(const Clip& clip) {
  PosedBones posed(kSkeleton.size());
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < clip.frames; ++f) {
    world(kKinematics, clip, f, posed.heads.data(), posed.rotations.data());
    const auto place = [&](int foot, int toe) {
      return frame_at(clip, f).to_local(ball(kSkeleton, foot, toe, posed)).x();
    };
    const Roles& roles = kSkeleton.roles;
    least = std::min(least, place(roles.right_foot, roles.right_toe) - place(roles.left_foot, roles.left_toe));
  }
  return least;
}

// How far a clip's left foot is turned at most from any one frame to any other, rad, as the character sees it.
double roll_of(const Clip& clip) {
  PosedBones posed(kSkeleton.size());
  std::vector<Quaternion> feet;
  double most = 0;
  for (int f = 0; f < clip.frames; ++f) {
    world(kKinematics, clip, f, posed.heads.data(), posed.rotations.data());
    feet.push_back(frame_at(clip, f).rotation().conjugate() * posed.rotations[kSkeleton.roles.left_foot]);
    for (const Quaternion& other : feet) most = std::max(most, feet.back().angularDistance(other));
  }
  return most;
}

TEST(Transformed, SidewaysTheFeetAreLiftedFlat) {
  Clip clip = gait_clip({});
  const int cycle = cycle_of({}, clip);
  for (int f = 0; f < clip.frames; ++f) {
    for (const int foot : {kSkeleton.roles.left_foot, kSkeleton.roles.right_foot}) {
      double* local = &clip.rotations[std::size_t{4} * (f * kSkeleton.size() + foot)];
      const Eigen::AngleAxisd roll(0.25 * (1 - std::cos(2 * kPi * f / cycle)), Vector3::UnitX());
      store_quaternion(load_quaternion(local) * roll, local);
    }
  }
  const double before = roll_of(clip);
  ASSERT_GT(before, 0.3);
  GaitEdit change;
  change.direction = kPi / 2;
  const Clip made = transformed(kKinematics, find_legs(kKinematics, {clip}), clip, {}, 20, 20 + cycle, cycle, change);
  EXPECT_LT(roll_of(made), 0.4 * before);
}

TEST(Transformed, SidewaysTheFeetDoNotCross) {
  Gait gait;
  gait.y = 1;
  const Clip clip = gait_clip(gait);
  const int cycle = cycle_of(gait, clip);
  const double before = least_apart(clip);
  ASSERT_GT(before, 0.05);
  for (const double direction : {-kPi / 2, -kPi / 4, kPi / 4, kPi / 2}) {
    GaitEdit change;
    change.direction = direction;
    const Clip made = transformed(kKinematics, find_legs(kKinematics, {clip}), clip, find_contacts(kKinematics, clip),
                                  20, 20 + cycle, cycle, change);
    EXPECT_GT(least_apart(made), 0.07) << direction;
  }
}

TEST(Transformed, DoesToTheEvidentControlWhatItSays) {
  const ControlSpace space;
  Random random(1);
  for (int n = 0; n < 40; ++n) {
    Gait gait;
    gait.x = random.uniform() - 0.5;
    gait.y = 0.6 + random.uniform();
    gait.turn = random.uniform() - 0.5;
    const Clip clip = gait_clip(gait);
    const double usual = usual_of({clip});
    const int begin = random.below(30), end = begin + cycle_of(gait, clip);
    GaitEdit change;
    change.direction = n % 4 == 0 ? 2 * random.uniform() - 1 : 0;
    change.speed = n % 4 == 1 ? 0.5 + random.uniform() : 1;
    change.turn = n % 4 == 2 ? 2 * random.uniform() - 1 : 0;
    change.tempo = n % 4 == 3 ? 0.8 + 0.4 * random.uniform() : 1;
    const Clip made =
        transformed(kKinematics, find_legs(kKinematics, {clip}), clip, {}, begin, end, end - begin, change);
    const Control before = evident_of(clip, begin, end, usual, space),
                  after = evident_of(made, 0, end - begin, usual, space);
    const Vector2 expected =
        Eigen::Rotation2Dd(change.direction) * Vector2(before.x, before.y) * change.speed * change.tempo;
    EXPECT_NEAR(after.x, expected.x(), 0.15) << n;  // the path is transformed; the limbs swing as before
    EXPECT_NEAR(after.y, expected.y(), 0.15) << n;
    if (change.turn == 0) {
      const CharacterFrame start = frame_at(clip, begin);
      const Vector2 went = frame_at(clip, end).position - start.position;
      const Vector2 goes = frame_at(made, end - begin).position - frame_at(made, 0).position;
      EXPECT_LT((goes - Eigen::Rotation2Dd(change.direction) * went * change.speed).norm(), 1e-9);
    }
    EXPECT_NEAR(after.turn, change.tempo * before.turn + change.turn / space.turn_rate(), 1e-6) << n;
  }
}

TEST(Hop, CrouchesFliesAsABodyFallsAndLandsAsItTookOff) {
  const Hop hop(0.2, 0.15, 0.25);
  const double take_off = hop.crouch(), landing = take_off + hop.flight(), step = 1e-4;
  EXPECT_NEAR(hop.flight(), 2 * std::sqrt(2 * 0.2 / 9.81), 1e-9);
  EXPECT_NEAR(hop.at(0), 0, 1e-9);
  EXPECT_NEAR(hop.at(0.25), -0.15, 1e-9);
  EXPECT_NEAR(hop.at((take_off + landing) / 2), 0.2, 1e-9);
  const auto speed = [&](double t) { return (hop.at(t + step) - hop.at(t - step)) / (2 * step); };
  for (double t = 2 * step; t < hop.seconds() - 2 * step; t += 0.01) {
    EXPECT_NEAR(hop.at(t), hop.at(hop.seconds() - t), 1e-9) << t;
    EXPECT_NEAR(speed(t + 0.005), speed(t), 0.01 * 20) << t;  // no force is greater than twice the weight
    if (t > take_off + step && t + 0.01 < landing - step) {
      EXPECT_NEAR((speed(t + 0.01) - speed(t)) / 0.01, -9.81, 0.01) << t;
    }
  }
}

TEST(Hop, SwingsTheArmsBackAndThenForwardAndLowersThemInTheAir) {
  Gait stands{0, 0, 0};
  Clip clip = gait_clip(stands);
  const Hop hop(0.3, 0.15, 0.2);
  add_hop(kKinematics, find_legs(kKinematics, {clip}), clip, hop);
  const auto hands = [&](double seconds) {  // ahead of their shoulders, m
    PosedBones posed(kSkeleton.size());
    const int f = static_cast<int>(std::lround(seconds * clip.rate));
    world(kKinematics, clip, f, posed.heads.data(), posed.rotations.data());
    Vector2 least = Vector2::Constant(1);
    for (int side = 0; side < 2; ++side) {
      const Arm arm = resting_arms(kSkeleton)[side];
      const Vector2 way = (posed.heads[arm.hand] - posed.heads[arm.upper]).head<2>();
      least[side] = (Eigen::Rotation2Dd(-clip.headings[f]) * way).y();
    }
    EXPECT_NEAR(least[0], least[1], 0.05) << "both together";
    return least.mean();
  };
  const double usual = hands(hop.seconds()), landing = hop.crouch() + hop.flight();
  EXPECT_LT(hands(0.1), usual - 0.1);
  EXPECT_GT(hands(hop.crouch() + hop.flight() / 4), usual + 0.3);
  EXPECT_NEAR(hands(landing), usual, 0.05);
}

TEST(Hop, BendsTheKneesWithTheFeetNeverBelowWhereTheyWere) {
  Clip clip = gait_clip({1.2, 0, 0}), before = clip;
  const Legs legs = find_legs(kKinematics, {clip});
  const Hop hop(0.3, 0.15, 0.2);
  add_hop(kKinematics, legs, clip, hop);
  double highest = 0, lowest = 0;
  PosedBones was(kSkeleton.size()), is(kSkeleton.size());
  for (int f = 0; f < clip.frames; ++f) {
    const double by = clip.root_positions[3 * f + 2] - before.root_positions[3 * f + 2];
    highest = std::max(highest, by);
    lowest = std::min(lowest, by);
    world(kKinematics, before, f, was.heads.data(), was.rotations.data());
    world(kKinematics, clip, f, is.heads.data(), is.rotations.data());
    for (const Leg& leg : legs) {
      const double lift = is.heads[leg.foot].z() - was.heads[leg.foot].z();
      EXPECT_GT(lift, -3e-3) << f;
      EXPECT_NEAR((is.heads[leg.foot] - was.heads[leg.foot]).head<2>().norm(), 0, 0.02);
      if (by <= 0) {
        EXPECT_NEAR(lift, 0, 0.01) << f;
      }
    }
    const int head = kSkeleton.roles.head;
    const double bows = (is.heads[head] - is.heads[0]).y() - (was.heads[head] - was.heads[0]).y();
    const double forward = std::cos(clip.headings[f]) * bows;
    if (by < -0.05) {
      EXPECT_GT(forward, 0.03) << f;
    }
    if (f >= hop.seconds() * clip.rate || by >= 0) {
      EXPECT_NEAR(bows, 0, 1e-6) << f;
    }
  }
  const double scale = standard_scale(kSkeleton);
  EXPECT_NEAR(highest * scale, 0.3, 0.01);
  EXPECT_NEAR(lowest * scale, -0.15, 0.01);
}

// The greatest speed of a ball of the foot that stands, m/s.
double slide(const Clip& clip, const Contacts& contacts, int begin, int end) {
  const Legs legs = find_legs(kKinematics, {clip});
  PosedBones posed(kKinematics.bones());
  double most = 0;
  for (int side = 0; side < 2; ++side) {
    Vector3 before = Vector3::Zero();
    for (int f = 0, standing = 0; f < clip.frames; ++f) {
      world(kKinematics, clip, f, posed.heads.data(), posed.rotations.data());
      const Vector3 now = ball(kKinematics.skeleton(), legs[side], posed);
      standing = contacts.feet[side][begin + f % (end - begin)] ? standing + 1 : 0;
      if (standing > 4) most = std::max(most, (now - before).head<2>().norm() * clip.rate);
      before = now;
    }
  }
  return most;
}

TEST(Transformed, KeepsPlantedFeetWhereTheyAre) {
  const Clip clip = gait_clip({1.2, 0, 0});
  const Contacts contacts = find_contacts(kKinematics, clip);
  for (const double direction : {kPi / 4, -kPi / 2}) {
    GaitEdit change;
    change.direction = direction;
    change.speed = 0.8;
    change.turn = 0.5;
    const Clip planted = transformed(kKinematics, find_legs(kKinematics, {clip}), clip, contacts, 15, 45, 35, change);
    EXPECT_LT(slide(planted, contacts, 15, 45), 0.15) << direction;
  }
}

}  // namespace
}  // namespace fragmotion
