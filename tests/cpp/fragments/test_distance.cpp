// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "fragmotion/fragments/distance.hpp"
#include "fragmotion/motion/pose.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

using Rows = std::vector<float>;

Rows random_rows(Random& random, int points, int stride) {
  Rows rows(std::size_t{3} * stride, 0);
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < points; ++i) rows[axis * stride + i] = static_cast<float>(4 * random.uniform() - 2);
  }
  return rows;
}

double naive_distance(const Rows& a, const Rows& b, int stride) {
  double sum = 0;
  for (int i = 0; i < stride; ++i) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = static_cast<double>(a[axis * stride + i]) - b[axis * stride + i];
      square += d * d;
    }
    sum += std::sqrt(square);
  }
  return sum;
}

TEST(TipDistance, IsTheSumOfEuclideanDistances) {
  Random random(1);
  for (int n = 0; n < 300; ++n) {
    const int points = 1 + random.below(50), stride = (points + kLanes - 1) / kLanes * kLanes;
    const Rows a = random_rows(random, points, stride), b = random_rows(random, points, stride);
    const double expected = naive_distance(a, b, stride);
    EXPECT_NEAR(tip_distance(a.data(), b.data(), stride), expected, 2e-6 * expected);
  }
}

// The eight partial sums that the contract fixes, one after another.
float plain_distance(const Rows& a, const Rows& b, int stride) {
  float sums[kLanes] = {};
  for (int i = 0; i < stride; ++i) {
    const float dx = a[i] - b[i], dy = a[stride + i] - b[stride + i], dz = a[2 * stride + i] - b[2 * stride + i];
    sums[i % kLanes] += std::sqrt(dx * dx + dy * dy + dz * dz);
  }
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

TEST(TipDistance, IsThePlainLoopToTheBit) {
  Random random(3);
  for (int n = 0; n < 1000; ++n) {
    const int points = 1 + random.below(400), stride = padded(points);
    const Rows a = random_rows(random, points, stride), b = random_rows(random, points, stride);
    EXPECT_EQ(tip_distance(a.data(), b.data(), stride), plain_distance(a, b, stride));
  }
}

TEST(TipDistance, IsANormOfTheDifference) {
  Random random(2);
  const int stride = 24;
  for (int n = 0; n < 300; ++n) {
    const Rows a = random_rows(random, 22, stride), b = random_rows(random, 22, stride),
               c = random_rows(random, 22, stride);
    const auto distance = [&](const Rows& p, const Rows& q) { return tip_distance(p.data(), q.data(), stride); };
    EXPECT_EQ(distance(a, a), 0);
    EXPECT_GT(distance(a, b), 0);
    EXPECT_EQ(distance(a, b), distance(b, a));
    EXPECT_LE(distance(a, c), (distance(a, b) + distance(b, c)) * (1 + 1e-6));
    Rows half = a;  // halfway between a and b: homogeneity and shift invariance
    for (std::size_t i = 0; i < half.size(); ++i) half[i] = 0.5F * (a[i] + b[i]);
    EXPECT_NEAR(distance(a, half), 0.5 * distance(a, b), 1e-5 * distance(a, b));
  }
}

// Dis in double precision, straight from the paper and design.md.
class NaiveTips {
 public:
  explicit NaiveTips(const FragmentPool& pool) : pool_(pool), kinematics_(pool.skeleton) {}

  std::vector<Vector3> tips(const Fragment& f, double at, const CharacterFrame& frame) const {
    const Clip& clip = pool_.clips[f.clip];
    const int bones = kinematics_.bones();
    std::vector<double> rotations(std::size_t{4} * bones);
    const Vector3 root = sample_pose(clip, at, rotations.data());
    std::vector<Vector3> heads(bones), tips;
    std::vector<Quaternion> orientations(bones);
    kinematics_.world(root, rotations.data(), heads.data(), orientations.data());
    for (const int b : measured_bones(pool_.skeleton)) {
      const Vector3 tip = heads[b] + orientations[b] * pool_.skeleton.tips[b];
      tips.push_back(frame.to_local(tip) * 1.8 / stature(pool_.skeleton));
    }
    return tips;
  }

  double fragments(int f, int g, int poses) const {
    double sum = 0;
    for (int i = 0; i < poses; ++i) {
      const auto at = [&](int k) {
        const Fragment& fragment = pool_.fragments[k];
        const double frame = fragment.begin + (fragment.end - fragment.begin) * double(i) / (poses - 1);
        return tips(fragment, frame, frame_at(pool_.clips[fragment.clip], fragment.begin));
      };
      sum += difference(at(f), at(g));
    }
    return sum;
  }

  double transition(int f, int g) const {
    const Fragment &from = pool_.fragments[f], &to = pool_.fragments[g];
    return difference(tips(from, from.end, frame_at(pool_.clips[from.clip], from.end)),
                      tips(to, to.begin, frame_at(pool_.clips[to.clip], to.begin)));
  }

 private:
  static double difference(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).norm();
    return sum;
  }

  const FragmentPool& pool_;
  Kinematics kinematics_;
};

FragmentPool small_pool(double size = 1) {
  Gait walk, run, curve;
  run.y = 3;
  run.cycle = 0.6;
  curve.turn = 1;
  for (Gait* gait : {&walk, &run, &curve}) gait->size = size, gait->seconds = 2;
  return gait_pool({gait_clip(walk), gait_clip(run), gait_clip(curve)}, size);
}

TEST(Trajectories, MeasureWhatTheNaiveFormulaSays) {
  const FragmentPool pool = small_pool();
  const NaiveTips naive(pool);
  for (const int poses : {2, 7, 16}) {
    const Trajectories t = trajectories(pool, poses);
    ASSERT_EQ(t.count, static_cast<int>(pool.fragments.size()));
    Random random(poses);
    for (int n = 0; n < 30; ++n) {
      const int f = random.below(t.count), g = random.below(t.count);
      EXPECT_NEAR(fragment_distance(t, f, g), naive.fragments(f, g, poses), 1e-4);
      EXPECT_NEAR(transition_distance(t, f, g), naive.transition(f, g), 1e-4);
    }
  }
}

TEST(Trajectories, RefuseNumbersOfPosesThatAreNone) {
  const FragmentPool pool = small_pool();
  for (const int poses : {std::numeric_limits<int>::min(), -1, 0, 1, kMostPoses + 1, 477218589}) {
    EXPECT_THROW(trajectories(pool, poses), std::invalid_argument) << poses;
  }
  EXPECT_EQ(trajectories(pool, 2).stride, padded(2 * trajectories(pool, 2).tips));
}

TEST(Trajectories, GoesOnWithoutADistanceInTheClip) {
  const FragmentPool pool = small_pool();
  const Trajectories t = trajectories(pool);
  for (int i = 1; i < t.count; ++i) {
    if (pool.fragments[i].clip == pool.fragments[i - 1].clip) {
      EXPECT_LT(transition_distance(t, i - 1, i), 1e-5);
    }
  }
}

TEST(Trajectories, CountTheMotionOfTheRoot) {
  Gait slow, fast;
  fast.y = 2;
  const FragmentPool pool = gait_pool({gait_clip(slow), gait_clip(fast)});
  const Trajectories t = trajectories(pool);
  const int points = static_cast<int>(measured_bones(pool.skeleton).size());
  EXPECT_GT(fragment_distance(t, 0, t.count - 1), 16 * points * 0.05);  // 5 cm a tip and pose at the least
}

TEST(Openings, AreTheFirstPoseAndTheOneATenthOfASecondLaterAsSeenFromThere) {
  const FragmentPool pool = gait_pool(gait_takes());
  const PackedPool packed = pack(pool);
  const std::vector<float> made = openings(packed);
  const int points = trajectories(pool).tips, stride = padded(2 * points);
  ASSERT_EQ(made.size(), pool.fragments.size() * 3 * stride);
  BodyTips tips(pool.skeleton);
  std::vector<double> rotations(std::size_t{4} * pool.skeleton.size());
  Rows expected(std::size_t{3} * stride, 0);
  for (std::size_t i = 0; i < pool.fragments.size(); ++i) {
    const Fragment& f = pool.fragments[i];
    const Clip& clip = pool.clips[f.clip];
    for (const double later : {0.0, 0.1}) {
      tips.pose(sample_pose(clip, f.begin + later * clip.rate, rotations.data()), rotations.data());
      tips.write(frame_at(clip, f.begin), expected.data(), stride, later > 0 ? points : 0);
    }
    EXPECT_LT(tip_distance(expected.data(), &made[i * 3 * stride], stride) / (2 * points), 1e-3) << i;
  }
}

TEST(FragmentDistance, DoesNotSeeWhereTheTakesStandOrFace) {
  FragmentPool pool = small_pool();
  const Trajectories before = trajectories(pool);
  Random random(8);
  for (Clip& clip : pool.clips) {
    const CharacterFrame move{{20 * random.uniform() - 10, 20 * random.uniform() - 10}, 6 * random.uniform() - 3};
    clip = moved(pool.skeleton, clip, move);
  }
  const Trajectories after = trajectories(pool);
  for (int f = 0; f < before.count; ++f) {
    for (int g = 0; g < before.count; ++g) {
      EXPECT_NEAR(fragment_distance(after, f, g), fragment_distance(before, f, g), 2e-4);
      EXPECT_NEAR(transition_distance(after, f, g), transition_distance(before, f, g), 2e-5);
    }
  }
}

TEST(FragmentDistance, IsThatOfACharacterOfOneEightyWhateverItsSize) {
  const FragmentPool usual = small_pool(), giant = small_pool(10), mouse = small_pool(0.05);
  const Trajectories t = trajectories(usual);
  for (const FragmentPool* other : {&giant, &mouse}) {
    ASSERT_EQ(other->fragments.size(), usual.fragments.size());
    const Trajectories scaled = trajectories(*other);
    for (int f = 0; f < t.count; ++f) {
      EXPECT_NEAR(fragment_distance(scaled, f, 0), fragment_distance(t, f, 0), 2e-4);
      EXPECT_NEAR(transition_distance(scaled, f, 0), transition_distance(t, f, 0), 2e-5);
    }
  }
}

TEST(Trajectories, AreTheSameBitsForAnyNumberOfThreads) {
  const FragmentPool pool = small_pool();
  const Trajectories one = trajectories(pool, 16, 1), three = trajectories(pool, 16, 3);
  EXPECT_EQ(one.whole, three.whole);
  EXPECT_EQ(one.first, three.first);
  EXPECT_EQ(one.last, three.last);
}

}  // namespace
}  // namespace fragmotion
