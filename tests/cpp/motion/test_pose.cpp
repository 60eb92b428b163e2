// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "motion/pose.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

Clip some_clip() { return make_clip(small_skeleton(), random_clip(small_skeleton(), 6, 2)); }

TEST(BlendRotations, GoesTheShorterArcAtConstantSpeed) {
  Random random(1);
  for (int n = 0; n < 200; ++n) {
    const Quaternion a = random_rotation(random), b = random_rotation(random);
    const double angle = a.angularDistance(b), w = random.uniform();
    double from[4], to[4], out[4];
    store_quaternion(a, from);
    store_quaternion(Quaternion(-b.w(), -b.x(), -b.y(), -b.z()), to);
    blend_rotations(from, to, w, 1, out);
    const Quaternion between = load_quaternion(out);
    EXPECT_NEAR(between.norm(), 1, 1e-12);
    EXPECT_NEAR(between.angularDistance(a), w * angle, 1e-6);
    EXPECT_NEAR(between.angularDistance(b), (1 - w) * angle, 1e-6);
  }
}

TEST(BlendRotations, MayWriteOverItsInput) {
  const Clip clip = some_clip();
  std::vector<double> a(clip.rotations.begin(), clip.rotations.begin() + 32),
      b(clip.rotations.begin() + 32, clip.rotations.begin() + 64);
  std::vector<double> expected(32), over_b = b;
  blend_rotations(a.data(), b.data(), 0.3, 8, expected.data());
  blend_rotations(a.data(), over_b.data(), 0.3, 8, over_b.data());
  EXPECT_EQ(over_b, expected);
  blend_rotations(a.data(), b.data(), 0.3, 8, a.data());
  EXPECT_EQ(a, expected);
}

TEST(SamplePose, IsTheClipAtItsFramesAndHeldAtItsEnds) {
  const Clip clip = some_clip();
  std::vector<double> pose(32);
  for (const double at : {-3.0, 0.0, 1.0, 4.0, 5.0, 9.5}) {
    const int frame = static_cast<int>(std::max(0.0, std::min(5.0, at)));
    EXPECT_LT((sample_pose(clip, at, pose.data()) - load_vector(&clip.root_positions[3 * frame])).norm(), 1e-15);
    for (int i = 0; i < 32; ++i) EXPECT_NEAR(pose[i], clip.rotations[32 * frame + i], 1e-15) << at;
    EXPECT_NEAR(frame_at(clip, at).heading, clip.headings[frame], 1e-15);
  }
}

TEST(SamplePose, IsBetweenTheFrames) {
  const Clip clip = some_clip();
  std::vector<double> pose(32);
  const Vector3 root = sample_pose(clip, 2.25, pose.data());
  const Vector3 a = load_vector(&clip.root_positions[6]), b = load_vector(&clip.root_positions[9]);
  EXPECT_LT((root - (a + 0.25 * (b - a))).norm(), 1e-14);
  for (int bone = 2; bone < 8; ++bone) {
    const Quaternion p = load_quaternion(&clip.rotations[64 + 4 * bone]),
                     q = load_quaternion(&clip.rotations[96 + 4 * bone]);
    EXPECT_NEAR(load_quaternion(&pose[4 * bone]).angularDistance(p), 0.25 * p.angularDistance(q), 1e-6);
  }
  const CharacterFrame frame = frame_at(clip, 2.25);
  EXPECT_LT((frame.position - root.head<2>()).norm(), 1e-15);
  EXPECT_NEAR(frame.heading, 0.75 * clip.headings[2] + 0.25 * clip.headings[3], 1e-14);
}

TEST(EaseInEaseOut, GoesFromZeroToOneFlatAtBothEnds) {
  EXPECT_EQ(ease_in_ease_out(-1), 0);
  EXPECT_EQ(ease_in_ease_out(0), 0);
  EXPECT_EQ(ease_in_ease_out(1), 1);
  EXPECT_EQ(ease_in_ease_out(2), 1);
  EXPECT_LT(ease_in_ease_out(1e-4), 1e-7);
  EXPECT_GT(ease_in_ease_out(1 - 1e-4), 1 - 1e-7);
  for (double t = 0; t < 1; t += 0.01) {
    EXPECT_LE(ease_in_ease_out(t), ease_in_ease_out(t + 0.01));
    EXPECT_NEAR(ease_in_ease_out(t) + ease_in_ease_out(1 - t), 1, 1e-12);
  }
}

}  // namespace
}  // namespace fragmotion
