// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.hpp"
#include "policy/bridge.hpp"
#include "small_character.hpp"
#include "split_bones.hpp"

namespace fragmotion {
namespace {

// Fragments as points on a line: one tip, first and last pose at random places.
struct Line {
  Trajectories t;
  FragmentPool pool;
  Classes classes;

  explicit Line(std::uint64_t seed, int count = 12) {
    Random random(seed);
    t.count = count;
    t.reach = 1;
    t.pose_stride = kLanes;
    t.first.assign(std::size_t{3} * count * kLanes, 0);
    t.last = t.first;
    classes.count = count;
    for (int i = 0; i < count; ++i) {
      t.first[std::size_t{3} * i * kLanes] = static_cast<float>(10 * random.uniform());
      t.last[std::size_t{3} * i * kLanes] = static_cast<float>(10 * random.uniform());
      Fragment fragment;
      if (random.below(3) > 0) fragment.evident = {0, 1.2, 0, 0};
      if (random.below(6) == 0) fragment.evident = {0, 0, 1, 0};  // on the spot
      pool.fragments.push_back(fragment);
      classes.representatives.push_back(i);
      classes.labels.push_back(i);
    }
  }
};

TEST(StandBridges, GoBetweenFarClassesByTheShortestWay) {
  const ControlSpace space;
  int bridged = 0;
  for (int seed = 1; seed <= 30; ++seed) {
    const Line line(seed);
    const double threshold = 3;
    const std::vector<int> bridges = stand_bridges(line.pool.fragments, line.t, line.classes, space, threshold);
    ASSERT_EQ(bridges.size(), 144U);
    for (int from = 0; from < 12; ++from) {
      for (int to = 0; to < 12; ++to) {
        const double direct = transition_distance(line.t, from, to);
        int expected = -1;
        double shortest = 1e30;
        for (int stand = 0; stand < 12; ++stand) {
          const Control& evident = line.pool.fragments[stand].evident;
          if (evident.y != 0 || evident.turn != 0) continue;
          const double there = transition_distance(line.t, from, stand), on = transition_distance(line.t, stand, to);
          if (direct > threshold && there < direct && on < direct && there + on < shortest) {
            shortest = there + on;
            expected = stand;
          }
        }
        EXPECT_EQ(bridges[from * 12 + to], expected);
        bridged += expected >= 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(bridged, 100);
}

TEST(StandBridges, AreOfAllowedClassesOnly) {
  const ControlSpace space;
  for (int seed = 1; seed <= 30; ++seed) {
    const Line line(seed);
    Line moving = line;  // the same, where every other class stands no more
    std::vector<bool> allowed(12, true);
    for (int k = 0; k < 12; k += 2) {
      allowed[k] = false;
      moving.pool.fragments[k].evident = {0, 1.2, 0, 0};
    }
    EXPECT_EQ(stand_bridges(line.pool.fragments, line.t, line.classes, space, 3, allowed),
              stand_bridges(moving.pool.fragments, moving.t, moving.classes, space, 3));
  }
}

TEST(StandBridges, AreNoneWhereNothingStandsOrNothingIsFar) {
  Line line(4);
  const std::vector<int> near = stand_bridges(line.pool.fragments, line.t, line.classes, ControlSpace(), 100);
  EXPECT_EQ(std::count(near.begin(), near.end(), -1), 144);
  for (Fragment& f : line.pool.fragments) f.evident = {0, 1.2, 0, 0};
  const std::vector<int> none = stand_bridges(line.pool.fragments, line.t, line.classes, ControlSpace(), 0.1);
  EXPECT_EQ(std::count(none.begin(), none.end(), -1), 144);
}

// Stands, or lies as one who fell forward or backward by an angle.
Clip fallen(double angle) {
  Gait stand;
  stand.y = 0;
  Clip clip = gait_clip(stand);
  const std::size_t width = clip.rotations.size() / clip.frames;
  for (int f = 0; f < clip.frames; ++f) {
    double* hips = &clip.rotations[width * f];
    store_quaternion(load_quaternion(hips) * Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitX())), hips);
  }
  return make_clip(humanoid(), clip);
}

TEST(StandBridges, AreTheSameWhereTheSameLimbsAreOfMoreBones) {
  BuildOptions options;
  options.classes = 6;
  options.synthesize = false;
  options.policies = {"greedy"};
  const std::vector<Clip> takes{gait_clip({}), fallen(0), fallen(1.5), fallen(-1.5)};
  const Character character = build(humanoid(), takes, {{{}, {}}}, options);
  const std::vector<int> none(character.bridges.size(), -1);
  EXPECT_NE(character.bridges, none);  // from the one fall to the other
  EXPECT_EQ(with_split_bones(character)->bridges, character.bridges);
}

}  // namespace
}  // namespace fragmotion
