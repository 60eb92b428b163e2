// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "fragments/body_tips.hpp"
#include "small_skeleton.hpp"

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

// hips (0.2), spine (0.2 + 0.3), and two legs of a thigh and a foot.
TEST(TipReach, IsTheWayFromTheHipsToEachTipOfACharacterOfOneEighty) {
  const Skeleton skeleton = small_skeleton();
  const double thigh = std::hypot(0.1, 0.05), shin = std::hypot(0.02, 0.4);
  const double sum = 0.2 + 0.5 + 2 * (thigh + 0.4) + 2 * (thigh + shin + 0.2);
  EXPECT_NEAR(tip_reach(skeleton), sum * 1.8 / stature(skeleton), 1e-12);
  EXPECT_EQ(BodyTips(skeleton).reach(), tip_reach(skeleton));
}

TEST(BodyTips, AreWhereBonesEndWhetherAnotherBoneBeginsThereOrNone) {
  Skeleton skeleton = small_skeleton();
  skeleton.tips[3] = skeleton.offsets[4];  // a thigh and its foot; the other's have a gap between them
  const Kinematics kinematics(skeleton);
  const std::vector<int> bones = measured_bones(skeleton);
  BodyTips tips(skeleton);
  Random random(6);
  const auto number = [&] { return 2 * random.uniform() - 1; };
  PosedBones posed(skeleton.size());
  std::vector<double> rotations(std::size_t{4} * skeleton.size());
  for (int b = 0; b < skeleton.size(); ++b)
    store_quaternion(Quaternion{number(), number(), number(), number()}.normalized(), &rotations[std::size_t{4} * b]);
  const Vector3 root{number(), number(), number()};
  kinematics.world(root, rotations.data(), posed.heads.data(), posed.rotations.data());
  const int stride = padded(tips.points());
  Rows rows(std::size_t{3} * stride, 0);
  tips.pose(root, rotations.data());
  tips.write({}, rows.data(), stride, 0);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    const int b = bones[i];
    const Vector3 end = standard_scale(skeleton) * (posed.heads[b] + posed.rotations[b] * skeleton.tips[b]);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(rows[axis * stride + i], end[axis], 1e-6) << b;
  }
}

TEST(TipWriter, WritesWhatBodyTipsWritesToTheBitOfAnyNumberOfPoses) {
  const Skeleton skeleton = small_skeleton();
  BodyTips tips(skeleton);
  TipWriter writer(skeleton);
  ASSERT_EQ(writer.points(), tips.points());
  Random random(5);
  const auto number = [&] { return 2 * random.uniform() - 1; };
  const int stride = padded(tips.points() + 1);
  for (const int poses : {1, TipWriter::kPoses - 1, TipWriter::kPoses, 3 * TipWriter::kPoses + 2}) {
    std::vector<Rows> expected(poses, Rows(std::size_t{3} * stride, 0)), written = expected;
    for (int pose = 0; pose < poses; ++pose) {
      double* rotations = writer.rotations();
      for (int b = 0; b < skeleton.size(); ++b)
        store_quaternion(Quaternion{number(), number(), number(), number()}.normalized(), rotations + 4 * b);
      const Vector3 root{number(), number(), number()};
      const CharacterFrame frame{{number(), number()}, 4 * number()};
      tips.pose(root, rotations);
      tips.write(frame, expected[pose].data(), stride, pose % 2);
      writer.add(root, frame, written[pose].data(), stride, pose % 2);
    }
    writer.flush();
    EXPECT_EQ(written, expected) << poses;
  }
}

}  // namespace
}  // namespace fragmotion
