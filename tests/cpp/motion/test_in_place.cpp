// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "io/asf_amc.hpp"
#include "io/bvh.hpp"
#include "mocap_files.hpp"
#include "motion/cycle.hpp"
#include "motion/in_place.hpp"
#include "stilts.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

// The clip without its hips' way over the ground, and without their turning where that goes as well.
Clip on_the_spot(const Skeleton& skeleton, Clip clip, bool straight = false) {
  for (int f = 0; f < clip.frames; ++f) {
    clip.root_positions[std::size_t{3} * f] = clip.root_positions[std::size_t{3} * f + 1] = 0;
    if (!straight) continue;
    double* hips = &clip.rotations[std::size_t{4} * (f * skeleton.size() + skeleton.roles.hips)];
    const double turned = clip.headings[f] - clip.headings[0];
    store_quaternion(CharacterFrame{{0, 0}, -turned}.rotation() * load_quaternion(hips), hips);
  }
  clip.headings.clear();
  return make_clip(skeleton, std::move(clip));
}

double length(const std::vector<Vector2>& steps) {
  double sum = 0;
  for (const Vector2& step : steps) sum += step.norm();
  return sum;
}

// The way of the hips in spans of a fourth of a second, m.
double way_of_hips(const Clip& clip) {
  const int span = static_cast<int>(std::lround(clip.rate / 4));
  std::vector<Vector2> steps;
  for (int f = span; f < clip.frames; f += span) {
    const double* at = &clip.root_positions[std::size_t{3} * f];
    steps.push_back((load_vector(at) - load_vector(at - std::size_t{3} * span)).head<2>());
  }
  return length(steps);
}

TEST(FeetWay, IsThatOfAWalkerInAnyDirection) {
  for (const double size : {1.0, 10.0}) {
    for (const Gait& gait : {Gait{0, 1.2}, Gait{0, -1}, Gait{1, 0}, Gait{-0.7, 0.7}}) {
      Gait sized = gait;
      sized.size = size;
      const Kinematics kinematics(humanoid(size));
      const Clip clip = on_the_spot(kinematics.skeleton(), gait_clip(sized));
      const auto way = find_feet_way(kinematics, clip);
      ASSERT_TRUE(way);
      EXPECT_EQ(way->turn, 0);
      EXPECT_NEAR(way->mean.x(), gait.x * size, 0.05 * size);
      EXPECT_NEAR(way->mean.y(), gait.y * size, 0.05 * size);
    }
  }
}

TEST(FeetWay, KeepsItsVelocityInAFlight) {
  const Gait gait{0, 3, 0, 3, 60, 0.6, 0.3};
  const Kinematics kinematics(humanoid());
  const auto way = find_feet_way(kinematics, on_the_spot(kinematics.skeleton(), gait_clip(gait)));
  ASSERT_TRUE(way);
  for (const Vector2& velocity : way->velocities) EXPECT_NEAR(velocity.norm(), 3, 0.3);
}

// A foot that strikes the ground for less than a frame, as in drawn runs: the body bounces over each step.
TEST(FeetWay, IsToldByFeetThatAreNowhereLowForLong) {
  const Gait gait{0, 3, 0, 2, 24, 0.5};
  const Kinematics kinematics(humanoid());
  Clip clip = on_the_spot(kinematics.skeleton(), gait_clip(gait));
  for (int f = 0; f < clip.frames; ++f) {
    const double steps = 2 * f / gait.rate / gait.cycle - 0.6;  // whole in the middle of a stance
    clip.root_positions[std::size_t{3} * f + 2] += 0.2 * std::abs(std::sin(kPi * steps));
  }
  const auto way = find_feet_way(kinematics, clip);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->mean.y(), 3, 0.15);
}

// The clip rolled about where it goes, on the ground, to its left.
Clip leaning(const Skeleton& skeleton, Clip clip, double angle) {
  for (int f = 0; f < clip.frames; ++f) {
    const Eigen::Rotation2Dd facing(clip.headings[f]);
    const Vector2 ahead = facing * Vector2::UnitY();
    const Quaternion roll(Eigen::AngleAxisd(-angle, Vector3(ahead.x(), ahead.y(), 0)));
    double *root = &clip.root_positions[std::size_t{3} * f],
           *hips = &clip.rotations[std::size_t{4} * (f * skeleton.size() + skeleton.roles.hips)];
    const Vector3 place = roll * load_vector(root);
    std::copy_n(place.data(), 3, root);
    store_quaternion(roll * load_quaternion(hips), hips);
  }
  clip.headings.clear();
  return make_clip(skeleton, std::move(clip));
}

// With feet that do not turn while they stand, as of a gait that turns.
Clip planted(const Skeleton& skeleton, Clip clip, const Gait& gait) {
  for (int f = 0; f < clip.frames; ++f) {
    for (const double side : {1.0, -1.0}) {
      const double phase = f / gait.rate / gait.cycle + (side > 0 ? 0 : 0.5), part = phase - std::floor(phase);
      const double stance = part < 0.6 ? part - 0.3 : 0.3 * (0.8 - part) / 0.2;
      const int bone = skeleton.find(side > 0 ? "foot.L" : "foot.R");
      double* foot = &clip.rotations[std::size_t{4} * (f * skeleton.size() + bone)];
      const Eigen::AngleAxisd turned(-gait.turn * gait.cycle * stance, Vector3::UnitZ());
      store_quaternion(load_quaternion(foot) * turned, foot);
    }
  }
  return clip;
}

TEST(FeetWay, TurnsAsFeetDoIfTheBodyLeansAsFarAsThatPullsItOut) {
  const Kinematics kinematics(humanoid());
  const Skeleton& skeleton = kinematics.skeleton();
  for (const double turn : {0.8, -0.8}) {
    const Gait gait{0, 3, turn, 0.6, 60, 0.6};
    const Clip run = planted(skeleton, on_the_spot(skeleton, gait_clip(gait), true), gait);
    const double lean = std::atan(3 * turn / kGravity);
    const auto upright = find_feet_way(kinematics, run);
    const auto leant = find_feet_way(kinematics, leaning(skeleton, run, lean));
    const auto outward = find_feet_way(kinematics, leaning(skeleton, run, -lean));
    ASSERT_TRUE(upright && leant && outward);
    EXPECT_EQ(upright->turn, 0);
    EXPECT_EQ(outward->turn, 0);
    EXPECT_NEAR(leant->turn, turn, 0.1);
    EXPECT_NEAR(leant->mean.norm(), 3 - std::abs(turn) * 0.9 * std::sin(std::abs(lean)), 0.03) << "inside of its feet";
  }
}

// An importer may have invented the end of a hoof, which then is in the ground where the foot swings: not low is what
// goes back there, but the ankle's path tells forth from back.
TEST(FeetWay, IsForthHoweverLongFeetAreThoughtToBe) {
  for (const double longer : {3.0, 5.0}) {
    Skeleton skeleton = humanoid();
    for (const char* foot : {"foot.L", "foot.R"}) skeleton.tips[skeleton.find(foot)] *= longer;
    const Kinematics kinematics(skeleton);
    Clip clip = on_the_spot(skeleton, gait_clip({0, 1.2}));
    for (int f = 0; f < clip.frames; ++f) {
      for (const double side : {1.0, -1.0}) {  // where the foot is lifted it points down
        const double phase = f / clip.rate + (side > 0 ? 0 : 0.5), swing = (phase - std::floor(phase) - 0.6) / 0.4;
        if (swing < 0) continue;
        const int bone = skeleton.find(side > 0 ? "foot.L" : "foot.R");
        double* foot = &clip.rotations[std::size_t{4} * (f * skeleton.size() + bone)];
        store_quaternion(load_quaternion(foot) * Eigen::AngleAxisd(std::sin(kPi * swing), Vector3::UnitX()), foot);
      }
    }
    const auto way = find_feet_way(kinematics, clip);
    ASSERT_TRUE(way) << longer;
    EXPECT_GT(way->mean.y(), 0) << longer;
  }
}

// A foot that comes down while it still goes forth is lowest, and most level, where it turns.
TEST(FeetWay, IsNotToldByFeetThatGoForth) {
  const Gait gait{0, 3, 0, 2, 24, 0.5};
  const Kinematics kinematics(humanoid());
  Clip clip = on_the_spot(kinematics.skeleton(), gait_clip(gait));
  for (int f = 0; f < clip.frames; ++f) {
    const double steps = 2 * f / gait.rate / gait.cycle - 0.05;  // whole where a foot strikes
    clip.root_positions[std::size_t{3} * f + 2] += 0.1 * std::abs(std::sin(kPi * steps));
  }
  const auto way = find_feet_way(kinematics, clip);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->mean.y(), 3, 0.45);
}

TEST(FeetWay, IsNoneOfWhatGoesOrStands) {
  const Kinematics kinematics(humanoid());
  EXPECT_FALSE(find_feet_way(kinematics, gait_clip({0, 1.2})));
  EXPECT_FALSE(find_feet_way(kinematics, gait_clip({0, 0})));
  EXPECT_FALSE(find_feet_way(kinematics, gait_clip({0, 0, 1})));
}

TEST(WayAhead, IsStraightAheadWhateverTheFeetDo) {
  Skeleton footless = humanoid();
  footless.roles.left_foot = footless.roles.right_foot = -1;
  const Kinematics kinematics(footless);
  const Clip clip = on_the_spot(footless, gait_clip({0, 1.2, 0, 1, 30}));
  EXPECT_FALSE(find_feet_way(kinematics, clip));
  const auto way = way_ahead(kinematics, clip, 3);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->mean.x(), 0, 0.05);
  EXPECT_NEAR(way->mean.y(), 3, 0.05);
  EXPECT_NEAR(way_of_hips(led(kinematics, clip, *way)), 3 * 24 / 30., 0.1);
  EXPECT_FALSE(way_ahead(kinematics, gait_clip({0, 1.2}), 3)) << "it goes by itself";
}

TEST(MayGo, SayCyclesOnTheSpotThatAreNoStands) {
  Skeleton footless = humanoid();
  footless.roles.left_foot = footless.roles.right_foot = -1;
  for (const Skeleton& skeleton : {humanoid(), footless}) {
    const Kinematics kinematics(skeleton);
    EXPECT_TRUE(may_go(kinematics, on_the_spot(skeleton, gait_clip({0, 1.2, 0, 1, 30}))));
    EXPECT_FALSE(may_go(kinematics, on_the_spot(skeleton, gait_clip({0, 0, 0, 1, 30}))));
    EXPECT_FALSE(may_go(kinematics, gait_clip({0, 1.2, 0, 1, 30})));
    Clip part = on_the_spot(skeleton, gait_clip({0, 1.2, 0, 1, 30}));
    part.frames = part.frames * 2 / 3;
    part.root_positions.resize(std::size_t{3} * part.frames);
    part.rotations.resize(std::size_t{4} * part.frames * skeleton.size());
    part.headings.resize(part.frames);
    EXPECT_FALSE(may_go(kinematics, part)) << "no cycle";
  }
}

TEST(FeetWay, LeadsACycleIntoItself) {
  const Kinematics kinematics(humanoid());
  const Clip clip = on_the_spot(kinematics.skeleton(), gait_clip({0, 1.2, 0, 1, 30}));
  const auto way = find_feet_way(kinematics, clip);
  ASSERT_TRUE(way);
  const Clip moved = led(kinematics, clip, *way), faster = led(kinematics, clip, *way, 1.5);
  EXPECT_NEAR(way_of_hips(moved), 1.2 * 24 / 30, 0.03);
  EXPECT_NEAR(way_of_hips(faster), 1.5 * way_of_hips(moved), 1e-9);
}

// As where a file holds a cycle's last pose while its other clips last: no frozen body glides on.
TEST(FeetWay, IsNoneWhileThePoseIsHeld) {
  const Kinematics kinematics(humanoid());
  const Clip clip = on_the_spot(kinematics.skeleton(), gait_clip({0, 1.2, 0, 2}));
  Clip held = clip;
  const std::size_t values = clip.rotations.size() / clip.frames;
  for (; held.frames < 2 * clip.frames; ++held.frames) {
    held.rotations.insert(held.rotations.end(), clip.rotations.end() - static_cast<std::ptrdiff_t>(values),
                          clip.rotations.end());
    held.root_positions.insert(held.root_positions.end(), clip.root_positions.end() - 3, clip.root_positions.end());
    held.headings.push_back(clip.headings.back());
  }
  const auto way = find_feet_way(kinematics, clip), longer = find_feet_way(kinematics, held);
  ASSERT_TRUE(way && longer);
  EXPECT_EQ(longer->mean, way->mean);
  ASSERT_EQ(longer->velocities.size(), static_cast<std::size_t>(held.frames - 1));
  EXPECT_EQ(longer->velocities.back(), Vector2::Zero());
  EXPECT_EQ(without_held_end(held).frames, clip.frames);
}

// A drawn fox's run ends with a frame in which a few bones turn by a hundredth of what they do otherwise.
TEST(FeetWay, LeavesAHeldEndOutThatHardlyMoves) {
  const Kinematics kinematics(humanoid());
  const Clip clip = on_the_spot(kinematics.skeleton(), gait_clip({0, 1.2, 0, 2}));
  Clip held = clip;
  const std::size_t values = clip.rotations.size() / clip.frames, last = clip.rotations.size() - values;
  for (std::size_t i = last; i < last + values; ++i) {
    held.rotations.push_back(clip.rotations[i] + 0.005 * (clip.rotations[i] - clip.rotations[i - values]));
  }
  held.root_positions.insert(held.root_positions.end(), clip.root_positions.end() - 3, clip.root_positions.end());
  held.headings.push_back(clip.headings.back());
  ++held.frames;
  EXPECT_EQ(without_held_end(held).frames, clip.frames);
}

// A drawn foot may go back faster, or slower, for a moment as it comes down: it stands for longer than that.
TEST(FeetWay, IsNotToldByASlapOfTheFeetAtAnyFrameRate) {
  const Kinematics kinematics(humanoid());
  for (const double rate : {24.0, 30.0, 60.0, 120.0}) {
    const Gait gait{0, 1.2, 0, 4, rate};
    Clip clip = on_the_spot(kinematics.skeleton(), gait_clip(gait));
    for (int f = 0; f < clip.frames; ++f) {  // the body back by 12 cm as each foot comes down, slowly forth again
      const double steps = 2 * f / gait.rate / gait.cycle, part = steps - std::floor(steps);
      clip.root_positions[std::size_t{3} * f + 1] += 0.12 * (part < 0.12 ? -part / 0.12 : (part - 1) / 0.88);
    }
    const auto way = find_feet_way(kinematics, clip);
    ASSERT_TRUE(way);
    EXPECT_NEAR(way->mean.y() / (1.2 - 0.12 / 0.44), 1, 0.02) << rate;
  }
}

// Nothing but where the body faces tells forth from back.
TEST(FeetWay, OfLegsOfASingleBoneLeadsAheadAsFarAsTheyOpen) {
  const Kinematics kinematics(stilts());
  const auto way = find_feet_way(kinematics, stilts_on_the_spot(0.1));
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->mean.x(), 0, 0.01);
  EXPECT_NEAR(way->mean.y(), kStiltsGo, 0.05 * kStiltsGo);
}

// The same legs with knees and feet, which stay as they are.
Skeleton pendulums() {
  Skeleton skeleton = stilts();
  for (const int leg : {2, 3}) {
    skeleton.names.push_back(leg == 2 ? "shin-left" : "shin-right");
    skeleton.names.push_back(leg == 2 ? "foot-left" : "foot-right");
    skeleton.parents.insert(skeleton.parents.end(), {leg, static_cast<int>(skeleton.parents.size())});
    skeleton.offsets.insert(skeleton.offsets.end(), {{0, 0, -0.45}, {0, 0, -0.45}});
    skeleton.tips.insert(skeleton.tips.end(), {{0, 0, -0.45}, {0, -0.12, 0}});
  }
  skeleton.rest_rotations.assign(8, Quaternion::Identity());
  skeleton.roles = {};
  return make_skeleton(std::move(skeleton));
}

// Under hips that neither rise nor fall; both legs as the left one where they swing together.
Clip swinging(const Skeleton& skeleton, bool together) {
  Clip clip = stilts_on_the_spot(0), legs = clip;
  clip.rotations.clear();
  for (int f = 0; f < clip.frames; ++f) {
    clip.root_positions[std::size_t{3} * f + 2] = 0.9;
    const auto from = legs.rotations.begin() + std::ptrdiff_t{16} * f;
    if (together) std::copy(from + 8, from + 12, from + 12);
    clip.rotations.insert(clip.rotations.end(), from, from + 16);
    for (int bone = 0; bone < 4; ++bone) clip.rotations.insert(clip.rotations.end(), {1, 0, 0, 0});
  }
  return make_clip(skeleton, std::move(clip));
}

Clip backward(const Skeleton& skeleton, const Clip& clip) {
  Clip result = clip;
  for (int f = 0; f < clip.frames; ++f) {
    const std::ptrdiff_t size = std::ptrdiff_t{4} * skeleton.size(), from = clip.frames - 1 - f;
    std::copy_n(clip.root_positions.begin() + 3 * from, 3, result.root_positions.begin() + std::ptrdiff_t{3} * f);
    std::copy_n(clip.rotations.begin() + size * from, size, result.rotations.begin() + size * f);
  }
  return make_clip(skeleton, std::move(result));
}

TEST(FeetWay, OfLegsThatSwingLikePendulumsLeadsAheadAsFarAsTheyOpen) {
  const Skeleton skeleton = pendulums();
  ASSERT_EQ(skeleton.names[skeleton.roles.left_foot], "foot-left");
  const auto way = find_feet_way(Kinematics(skeleton), swinging(skeleton, false));
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->mean.x(), 0, 0.01);
  EXPECT_NEAR(way->mean.y(), kStiltsGo, 0.05 * kStiltsGo);
}

// As of a drawn gallop, whose hind legs swing together: the same motion, whichever end it begins at.
TEST(FeetWay, OfFeetThatGoForthAndBackOnOnePathLeadsAhead) {
  const Skeleton skeleton = pendulums();
  const Clip clip = swinging(skeleton, true);
  for (const Clip& each : {clip, backward(skeleton, clip)}) {
    const auto way = find_feet_way(Kinematics(skeleton), each);
    ASSERT_TRUE(way);
    EXPECT_NEAR(way->mean.x(), 0, 0.01);
    EXPECT_GT(way->mean.y(), kStiltsGo);
  }
}

void expect_found_again(const Take& take) {
  const Clip clip = clip_from_take(take.skeleton, take);
  if (clip.frames < 2 * clip.rate) return;  // a stride and a half
  const Kinematics kinematics(take.skeleton);
  const Clip still = on_the_spot(take.skeleton, clip);
  const auto way = find_feet_way(kinematics, still);
  ASSERT_TRUE(way) << take.name;
  EXPECT_NEAR(way_of_hips(led(kinematics, still, *way)) / way_of_hips(clip), 1, 0.05) << take.name;
}

TEST(FeetWay, IsThatOfRealTakesThatWereTakenAwayTheirs) {
  const std::filesystem::path bandai = shared_mocap() / "bandai-namco", cmu = shared_mocap() / "cmu";
  const auto files = files_in(bandai, ".bvh");
  if (files.empty()) GTEST_SKIP() << "no motion capture beside the project";
  for (std::size_t i = 0; i < files.size(); i += 3) expect_found_again(read_bvh(files[i]));
  expect_found_again(read_asf_amc(cmu / "02.asf", cmu / "02_01.amc"));
}

// So many frames from the middle of a clip, on a treadmill: without their mean velocity, which is left in `speed`.
Clip on_a_treadmill(const Skeleton& skeleton, const Clip& clip, int frames, double& speed) {
  const std::ptrdiff_t begin = (clip.frames - frames) / 2, end = begin + frames, size = 4 * skeleton.size();
  Clip part{clip.name, clip.rate, frames, {}, {}, {}};
  part.root_positions.assign(clip.root_positions.begin() + 3 * begin, clip.root_positions.begin() + 3 * end);
  part.rotations.assign(clip.rotations.begin() + size * begin, clip.rotations.begin() + size * end);
  const Vector3 first = load_vector(part.root_positions.data());
  const Vector3 step = (load_vector(&part.root_positions[std::size_t{3} * (frames - 1)]) - first) / (frames - 1);
  speed = step.head<2>().norm() * clip.rate;
  for (int f = 0; f < frames; ++f) {
    for (int axis = 0; axis < 2; ++axis) part.root_positions[std::size_t{3} * f + axis] -= f * step[axis];
  }
  return make_clip(skeleton, std::move(part));
}

// Every so many-th frame.
Clip thinned(const Skeleton& skeleton, const Clip& clip, int step) {
  Clip thin{clip.name, clip.rate / step, 0, {}, {}, {}};
  const std::ptrdiff_t values = std::ptrdiff_t{4} * skeleton.size();
  for (int f = 0; f < clip.frames; f += step, ++thin.frames) {
    const auto root = clip.root_positions.begin() + std::ptrdiff_t{3} * f;
    thin.root_positions.insert(thin.root_positions.end(), root, root + 3);
    const auto pose = clip.rotations.begin() + values * f;
    thin.rotations.insert(thin.rotations.end(), pose, pose + values);
  }
  return make_clip(skeleton, std::move(thin));
}

// A clip's speed is not that of its frames: a file keeps 24 or 30 of them, motion capture 60 or 120.
TEST(FeetWay, IsTheSameAtAnyFrameRate) {
  for (const double speed : {0.7, 1.2, 3.0}) {
    std::vector<double> told;
    for (const double rate : {24.0, 30.0, 60.0, 120.0}) {
      const Kinematics kinematics(humanoid());
      const auto way = find_feet_way(kinematics, on_the_spot(kinematics.skeleton(), gait_clip({0, speed, 0, 3, rate})));
      ASSERT_TRUE(way);
      told.push_back(way->mean.norm());
    }
    for (const double each : told) EXPECT_NEAR(each / told.back(), 1, 0.02) << speed;
  }
}

// The stride that closes best, of those which end in a frame of every rate.
Clip stride_of(const Skeleton& skeleton, const Clip& clip, double& speed) {
  const Kinematics kinematics(skeleton);
  double nearest = std::numeric_limits<double>::infinity();
  Clip best;
  for (int begin = 0; begin + 161 <= clip.frames; begin += 4) {
    for (const int frames : {100, 120, 140}) {
      const Clip stride = part(clip, begin, begin + frames);
      const Clip ends = make_clip(skeleton, thinned(skeleton, stride, frames));
      PosedBones one(kinematics.bones()), other(kinematics.bones());
      world(kinematics, ends, 0, one.heads.data(), one.rotations.data());
      world(kinematics, ends, 1, other.heads.data(), other.rotations.data());
      double gap = 0;
      for (int b = 0; b < kinematics.bones(); ++b)
        gap += ((other.heads[b] - other.heads[0]) - (one.heads[b] - one.heads[0])).norm();
      if (gap < nearest) nearest = gap, best = stride;
    }
  }
  return on_a_treadmill(skeleton, best, best.frames, speed);
}

TEST(FeetWay, IsTheSameAtAnyFrameRateOfRealTakes) {
  const std::filesystem::path cmu = shared_mocap() / "cmu";
  if (files_in(cmu, ".amc").empty()) GTEST_SKIP() << "no motion capture beside the project";
  for (const char* name : {"02_01.amc", "02_02.amc"}) {
    const Take take = read_asf_amc(cmu / "02.asf", cmu / name);
    double speed = 0;
    const Clip still = stride_of(take.skeleton, clip_from_take(take.skeleton, take), speed);
    std::vector<double> told;
    for (const int step : {1, 2, 4, 5}) {
      const auto way = find_feet_way(Kinematics(take.skeleton), thinned(take.skeleton, still, step));
      ASSERT_TRUE(way) << name;
      told.push_back(way->mean.norm());
    }
    for (const double each : told) EXPECT_NEAR(each / told.front(), 1, 0.02) << name;
    EXPECT_NEAR(told.front() / speed, 1, 0.05) << name;
  }
}

// A foot that leaves the ground rolls over its tip and slows down: it must not slow the body down.
TEST(FeetWay, IsNoSlowerThanRealRuns) {
  double found = 0, real = 0;
  for (const auto& file : files_in(shared_mocap() / "bandai-namco", ".bvh")) {
    if (file.filename().string().find("2_run") == std::string::npos) continue;
    const Take take = read_bvh(file);
    const Clip clip = clip_from_take(take.skeleton, take);
    double speed = 0;
    const Clip still = on_a_treadmill(take.skeleton, clip, static_cast<int>(std::lround(clip.rate)), speed);
    const auto way = find_feet_way(Kinematics(take.skeleton), still);
    if (!way || std::abs(clip.headings.back() - clip.headings.front()) > 0.3) continue;
    found += way->mean.norm(), real += speed;
  }
  if (real == 0) GTEST_SKIP() << "no motion capture beside the project";
  EXPECT_NEAR(found / real, 1, 0.015);
}

TEST(FeetWay, TurnsAsTheFeetOfRealTakesTell) {
  int takes = 0;
  for (const auto& file : files_in(shared_mocap() / "bandai-namco", ".bvh")) {
    if (file.filename().string().find("walk-turn") == std::string::npos || takes == 12) continue;
    const Take take = read_bvh(file);
    const Clip clip = clip_from_take(take.skeleton, take);
    const double turned = clip.headings.back() - clip.headings.front();
    if (std::abs(turned) * clip.rate < kPi / 9 * clip.frames) continue;
    const Kinematics kinematics(take.skeleton);
    const Clip straight = on_the_spot(take.skeleton, clip, true);
    const auto way = find_feet_way(kinematics, straight);
    ASSERT_TRUE(way) << take.name;
    const Clip moved = led(kinematics, straight, *way);
    const double seconds = (clip.frames - 1) / clip.rate;
    EXPECT_NEAR(way->turn, turned / seconds, kPi / 18) << take.name;
    EXPECT_NEAR(way_of_hips(moved) / way_of_hips(clip), 1, 0.05) << take.name;
    ++takes;
  }
  if (takes == 0) GTEST_SKIP() << "no motion capture beside the project";
}

}  // namespace
}  // namespace fragmotion
