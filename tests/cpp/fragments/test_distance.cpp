// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "fragments/distance.hpp"
#include "motion/pose.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

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

  std::vector<Vector3> trajectory(int f, int poses) const {
    const Fragment& fragment = pool_.fragments[f];
    std::vector<Vector3> all;
    for (int i = 0; i < poses; ++i) {
      const double frame = fragment.begin + (fragment.end - fragment.begin) * double(i) / (poses - 1);
      const auto pose = tips(fragment, frame, frame_at(pool_.clips[fragment.clip], fragment.begin));
      all.insert(all.end(), pose.begin(), pose.end());
    }
    return all;
  }

  double transition(int f, int g) const {
    const Fragment &from = pool_.fragments[f], &to = pool_.fragments[g];
    return difference(tips(from, from.end, frame_at(pool_.clips[from.clip], from.end)),
                      tips(to, to.begin, frame_at(pool_.clips[to.clip], to.begin)));
  }

  static double difference(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).norm();
    return sum;
  }

 private:
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

// As they are kept.
std::vector<Vector3> trajectory(const Trajectories& t, int f, int poses) {
  const std::vector<float> rows = t.whole.read(f);
  const int stride = t.whole.stride();
  std::vector<Vector3> points;
  for (int i = 0; i < t.tips * poses; ++i) points.emplace_back(rows[i], rows[stride + i], rows[2 * stride + i]);
  return points;
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
      const std::vector<Vector3> kept = trajectory(t, f, poses), exact = naive.trajectory(f, poses);
      for (std::size_t i = 0; i < exact.size(); ++i) {
        EXPECT_LT((kept[i] - exact[i]).cwiseAbs().maxCoeff(), 0.5 * t.whole.unit(f) + 1e-6);
      }
      EXPECT_NEAR(fragment_distance(t, f, g), NaiveTips::difference(kept, trajectory(t, g, poses)), 1e-4);
      EXPECT_NEAR(transition_distance(t, f, g), naive.transition(f, g), 1e-4);
    }
  }
}

TEST(Trajectories, RefuseNumbersOfPosesThatAreNone) {
  const FragmentPool pool = small_pool();
  for (const int poses : {std::numeric_limits<int>::min(), -1, 0, 1, kMostPoses + 1, 477218589}) {
    EXPECT_THROW(trajectories(pool, poses), std::invalid_argument) << poses;
  }
  EXPECT_EQ(trajectories(pool, 2).whole.stride(), TipRows(0, 2 * trajectories(pool, 2).tips).stride());
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

void expect_same_bits(const Trajectories& a, const Trajectories& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_TRUE(a.whole == b.whole);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.last, b.last);
}

TEST(Trajectories, AreTheSameBitsForAnyNumberOfThreads) {
  const FragmentPool pool = small_pool();
  expect_same_bits(trajectories(pool, 16, 1), trajectories(pool, 16, 3));
}

TEST(Trajectories, AreTheSameBitsWhereSomeAreKnown) {
  FragmentPool pool = small_pool();
  const std::size_t all = pool.fragments.size();
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, all / 2, all}) {
    FragmentPool part = pool;
    part.fragments.resize(count);
    const Trajectories known = trajectories(part);
    pool.fragments[0].lead_out = 1 - pool.fragments[0].lead_out;  // how it is played may be known later
    expect_same_bits(trajectories(pool, kPoses, 3, known), trajectories(pool));
  }
}

}  // namespace
}  // namespace fragmotion
