// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fragments/blend.hpp"
#include "fragments/coverage.hpp"
#include "fragments/distance.hpp"
#include "fragments/gait_edit.hpp"
#include "fragments/synthesis.hpp"
#include "measured_clips.hpp"
#include "mocap_files.hpp"
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

// The pool with a clip's frames 0 .. end as one more fragment.
Trajectories with(FragmentPool pool, const Clip& clip, int end) {
  Fragment fragment;
  fragment.clip = static_cast<int>(pool.clips.size());
  fragment.end = end;
  pool.clips.push_back(make_clip(pool.skeleton, clip));
  pool.fragments.push_back(fragment);
  return trajectories(pool);
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

TEST(Interpolated, AtItsEndsIsTheOneOrTheOther) {
  Gait slow, fast;
  fast.y = 1.8;
  fast.heading = 2;
  const FragmentPool pool = gait_pool({gait_clip(slow), gait_clip(fast)});
  const int a = 2, b = static_cast<int>(pool.fragments.size()) - 3, last = static_cast<int>(pool.fragments.size());
  for (const double w : {0.0, 1.0}) {
    const Clip clip = interpolated(kKinematics, pool, pool.fragments[a], pool.fragments[b], w, 4);
    const Trajectories t = with(pool, clip, clip.frames - 1 - 4);
    EXPECT_LT(fragment_distance(t, last, w == 0 ? a : b), 1e-3);
    EXPECT_GT(fragment_distance(t, last, w == 0 ? b : a), 1);
  }
}

TEST(Interpolated, LiesBetweenWhatItIsMadeOf) {
  Gait slow, fast;
  fast.y = 1.8;
  const FragmentPool pool = gait_pool({gait_clip(slow), gait_clip(fast)});
  const double usual = usual_of(pool.clips);
  for (const Fragment& a : pool.fragments) {
    const Fragment& b = pool.fragments.back();
    const Clip clip = interpolated(kKinematics, pool, a, b, 0.5, 0);
    const double seconds = (clip.frames - 1) / clip.rate, mean = (pool.seconds(a) + pool.seconds(b)) / 2;
    EXPECT_NEAR(seconds, mean, 0.5 / clip.rate + 1e-9);
    const double speed = evident_of(clip, 0, clip.frames - 1, usual).y;
    EXPECT_GT(speed, std::min(a.evident.y, b.evident.y) - 0.15);
    EXPECT_LT(speed, std::max(a.evident.y, b.evident.y) + 0.15);
  }
}

FragmentPool synthesized(std::vector<Clip> clips, const ControlSpace& space) {
  FragmentPool pool = gait_pool(clips, 1, {}, &space);
  synthesize(pool, space, usual_of(clips));
  return pool;
}

// ControlDis to the nearest fragment.
double nearest(const FragmentPool& pool, const Control& control, const ControlSpace& space) {
  double least = std::numeric_limits<double>::infinity();
  for (const Fragment& f : pool.fragments) least = std::min(least, space.distance(f.evident, control));
  return least;
}

TEST(Synthesize, OnlyAddsAndBringsControlsNearer) {
  const std::vector<Clip> clips = gait_takes();
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const FragmentPool before = gait_pool(clips, 1, {}, &space), after = synthesized(clips, space);
  ASSERT_GT(after.fragments.size(), before.fragments.size());
  for (std::size_t i = 0; i < before.fragments.size(); ++i) {
    EXPECT_EQ(after.fragments[i].begin, before.fragments[i].begin);
    EXPECT_EQ(after.fragments[i].evident.y, before.fragments[i].evident.y);
  }
  const SpeedRange speeds(before.fragments, space);
  double sum_was = 0, sum_is = 0;
  for (int c = 0; c < kPaperPoints; ++c) {
    const Control able = speeds.within(space.point(c));
    const double was = nearest(before, able, space), is = nearest(after, able, space);
    EXPECT_LE(is, was);
    if (space.nearest(able) != c) continue;
    sum_was += was;
    sum_is += is;
  }
  EXPECT_LT(sum_is, 0.5 * sum_was);
}

TEST(Synthesize, GoesAsFastAsMayBeWhereNoTakeIsAsFastAsIsAsked) {
  const std::vector<Clip> clips = gait_takes();  // aside they go at 1.2 m/s
  const ControlSpace space(0.9, 2, 1.2, 1.8 / stature(kSkeleton));
  const SpeedRange speeds(gait_pool(clips, 1, {}, &space).fragments, space);
  const Control aside{2, 0, 0, 0}, able = speeds.within(aside);
  ASSERT_LT(able.speed(), 1.9);
  ASSERT_EQ(space.nearest(able), space.nearest(aside));
  EXPECT_LT(nearest(synthesized(clips, space), able, space), 0.15);
}

TEST(Synthesize, GoesRoundAndRoundWhereNoTakeGoesOn) {
  const std::vector<Clip> clips = gait_takes();
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const Control run{0, 3, 0, 0};
  const auto rounds = [&](const FragmentPool& pool) {
    int count = 0;
    for (const Fragment& f : pool.fragments)
      count += f.origin == Origin::transformed && space.distance(f.evident, run) <= kPerformed ? 1 : 0;
    return count;
  };
  FragmentPool pool = gait_pool(clips, 1, {}, &space), alone = pool;
  synthesize(pool, space, usual_of(clips));
  EXPECT_EQ(rounds(pool), 0) << "takes run on";
  alone.fragments.clear();
  for (const Fragment& f : gait_pool(clips, 1, {}, &space).fragments) {  // every other one of what runs
    const bool runs = space.distance(f.evident, run) <= kPerformed;
    if (!runs || alone.fragments.back().end != f.begin) alone.fragments.push_back(f);
  }
  synthesize(alone, space, usual_of(clips));
  EXPECT_GE(rounds(alone), 2);
}

TEST(Synthesize, SaysTruelyWhatItsFragmentsAre) {
  const std::vector<Clip> clips = gait_takes();
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const double usual = usual_of(clips);
  const FragmentPool pool = synthesized(clips, space);
  int made = 0;
  for (const Fragment& f : pool.fragments) {
    ASSERT_TRUE(f.clip >= 0 && f.clip < static_cast<int>(pool.clips.size()));
    const Clip& clip = pool.clips[f.clip];
    ASSERT_TRUE(f.begin >= 0 && f.begin < f.end && f.end < clip.frames);
    if (f.origin == Origin::captured) continue;
    ++made;
    EXPECT_NE(f.origin, Origin::mirrored);
    EXPECT_GE(pool.seconds(f), 0.1 - 1e-9);
    EXPECT_LE(pool.seconds(f), 0.5 + 1.0 / clip.rate);
    const Control found = evident_of(clip, f.begin, f.end, usual, space);
    EXPECT_NEAR(space.distance(found, f.evident), 0, 1e-6);
  }
  EXPECT_GT(made, 50);
}

// The greatest speed of a knee, m/s.
double fastest_knee(const Clip& clip, int begin, int end) {
  const Legs legs = find_legs(kKinematics, {clip});
  PosedBones posed(kKinematics.bones());
  std::array<Vector3, 2> before;
  double most = 0;
  for (int f = begin; f <= end; ++f) {
    world(kKinematics, clip, f, posed.heads.data(), posed.rotations.data());
    for (int side = 0; side < 2; ++side) {
      const Vector3 now = posed.heads[legs[side].knee];
      if (f > begin) most = std::max(most, (now - before[side]).norm() * clip.rate);
      before[side] = now;
    }
  }
  return most;
}

TEST(Synthesize, GoesBackwardWithoutKneesThatSnap) {
  Gait run;
  run.y = 3;
  run.cycle = 0.8;
  run.rate = 60;
  const Clip clip = gait_clip(run);
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const FragmentPool pool = synthesized({clip}, space);
  const double own = fastest_knee(pool.clips[0], 0, pool.clips[0].frames - 1);
  int found = 0;
  for (const Fragment& f : pool.fragments) {
    if (f.origin != Origin::transformed || f.evident.y > -1 || f.evident.jump > 0.5) continue;
    ++found;
    EXPECT_LT(fastest_knee(pool.clips[f.clip], f.begin, f.end), 1.1 * own);
  }
  EXPECT_GT(found, 1);
}

TEST(Synthesize, RefusesALengthOutOfItsRange) {
  FragmentPool pool = gait_pool({gait_clip({})});
  for (const double bad : {-1.0, std::nan(""), 1e8, double(INFINITY)}) {
    const std::string error = error_of([&] { synthesize(pool, ControlSpace(), 1, bad); });
    EXPECT_NE(error.find("longest fragment (s) must be 0.1 to 10"), std::string::npos) << bad;
  }
}

TEST(Synthesize, LetsEveryCharacterStand) {
  Gait run;
  run.y = 3;
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const FragmentPool pool = synthesized({gait_clip(run)}, space);
  EXPECT_LT(coverage(pool.fragments, space).distances[space.nearest({})], 0.05);  // it sways
}

// As a take stands for three seconds or more, or as one that is made and does for longer; nothing else is made.
TEST(Synthesize, StandsOnForLong) {
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  for (const double seconds : {0.0, 1.0, 6.0}) {
    std::vector<Clip> clips = gait_takes();
    Gait gait;
    gait.y = 0;
    gait.seconds = seconds;
    clips.erase(clips.begin());
    if (seconds > 0) clips.push_back(gait_clip(gait, "stand"));
    const FragmentPool pool = synthesized(clips, space);
    double standing = 0;
    for (const Fragment& f : pool.fragments) {
      if (pool.clips[f.clip].name != "standing") continue;
      EXPECT_LT(space.distance(f.evident, {}), 0.3);
      EXPECT_GT(pool.clips[f.clip].frames, 20 * 30) << "it plays nothing that only stands still";
      standing += pool.seconds(f);
    }
    if (seconds > 3) {
      EXPECT_EQ(standing, 0);
    } else {
      EXPECT_GT(standing, 20) << seconds;
    }
  }
}

TEST(Synthesize, IsDeterministic) {
  const ControlSpace space(1.2, 3, 1.2, 1.8 / stature(kSkeleton));
  const FragmentPool one = synthesized(gait_takes(), space), two = synthesized(gait_takes(), space);
  ASSERT_EQ(one.clips.size(), two.clips.size());
  for (std::size_t i = 0; i < one.clips.size(); ++i) EXPECT_EQ(one.clips[i].rotations, two.clips[i].rotations);
}

}  // namespace
}  // namespace fragmotion
