// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>

#include "base/random.hpp"
#include "classes/clustering.hpp"
#include "mocap_files.hpp"

namespace fragmotion {
namespace {

// change(i, row) of each fragment's coordinates.
template <typename Change>
void change_rows(Trajectories& t, const Change& change) {
  for (int i = 0; i < t.count; ++i) {
    std::vector<float> row = t.whole.read(i);
    change(i, row);
    t.whole.set(i, row.data());
  }
}

// Points in `groups` blobs; `grid` rounds the coordinates, so that some points coincide.
Trajectories blobs(int count, int points, int groups, std::uint64_t seed, double grid = 0) {
  Random random(seed);
  Trajectories t;
  t.count = count;
  t.whole = TipRows(count, points);
  const std::size_t stride = t.whole.stride();
  std::vector<float> centers(3 * groups * stride);
  for (float& value : centers) value = static_cast<float>(4 * random.uniform());
  change_rows(t, [&](int, std::vector<float>& row) {
    const int group = random.below(groups);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < points; ++k) {
        double value = centers[(3 * group + axis) * stride + k] + random.uniform() - 0.5;
        if (grid > 0) value = std::round(value / grid) * grid;
        row[axis * stride + k] = static_cast<float>(value);
      }
    }
  });
  return t;
}

// i % modulus of each i below `count`.
std::vector<int> modulo(int count, int modulus) {
  std::vector<int> values;
  for (int i = 0; i < count; ++i) values.push_back(i % modulus);
  return values;
}

std::vector<float> equal_weights(const Trajectories& t) { return std::vector<float>(t.count, 1); }

// The result looked at naively, in double precision.
class Naive {
 public:
  Naive(const Trajectories& t, const std::vector<float>& weights, const Classes& classes)
      : stride_(t.whole.stride()), width_(t.whole.width()), means_(classes.count * width_, 0) {
    for (int i = 0; i < t.count; ++i) rows_.push_back(t.whole.read(i));
    std::vector<double> total(classes.count, 0);
    for (int i = 0; i < t.count; ++i) {
      const int k = classes.labels[i];
      total[k] += weights[i];
      for (std::size_t j = 0; j < width_; ++j) means_[k * width_ + j] += weights[i] * rows_[i][j];
    }
    for (int k = 0; k < classes.count; ++k) {
      for (std::size_t j = 0; j < width_; ++j) means_[k * width_ + j] /= total[k];
    }
  }

  double distance(int i, int k) const {
    double sum = 0;
    for (int j = 0; j < stride_; ++j) {
      double square = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t at = std::size_t(axis) * stride_ + j;
        square += std::pow(rows_[i][at] - means_[k * width_ + at], 2);
      }
      sum += std::sqrt(square);
    }
    return sum;
  }

 private:
  int stride_;
  std::size_t width_;
  std::vector<std::vector<float>> rows_;
  std::vector<double> means_;
};

void expect_fixed_point(const Trajectories& t, const std::vector<float>& weights, const Classes& classes) {
  const Naive naive(t, weights, classes);
  double inertia = 0;
  for (int i = 0; i < t.count; ++i) {
    const double own = naive.distance(i, classes.labels[i]);
    for (int k = 0; k < classes.count; ++k) EXPECT_LE(own, naive.distance(i, k) * (1 + 1e-4) + 1e-4) << "point " << i;
    inertia += weights[i] * own * own;
  }
  EXPECT_NEAR(classes.inertia, inertia, 1e-4 * inertia + 1e-4);
}

void expect_classes(const Trajectories& t, const std::vector<float>& weights, const Classes& classes, int count) {
  ASSERT_EQ(classes.count, count);
  ASSERT_EQ(classes.labels.size(), static_cast<std::size_t>(t.count));
  ASSERT_EQ(classes.representatives.size(), static_cast<std::size_t>(count));
  for (const int label : classes.labels) ASSERT_TRUE(label >= 0 && label < count);
  EXPECT_TRUE(std::is_sorted(classes.representatives.begin(), classes.representatives.end()));
  const Naive naive(t, weights, classes);
  const std::vector<std::vector<int>> members = classes.members();
  for (int k = 0; k < count; ++k) {
    ASSERT_FALSE(members[k].empty()) << "class " << k << " is empty";
    const int medoid = classes.representatives[k];
    ASSERT_TRUE(medoid >= 0 && medoid < t.count);
    EXPECT_EQ(classes.labels[medoid], k);
    for (const int i : members[k]) EXPECT_LE(naive.distance(medoid, k), naive.distance(i, k) * (1 + 1e-4) + 1e-4);
  }
}

TEST(Cluster, EndsWhereEveryPointHasItsNearestMean) {
  for (int seed = 1; seed <= 12; ++seed) {
    const Trajectories t = blobs(150 + 20 * seed, 3 + seed, 8, seed, seed % 3 == 0 ? 0.25 : 0);
    Random random(seed);
    std::vector<float> weights = equal_weights(t);
    if (seed % 2 == 0) {
      for (float& w : weights) w = static_cast<float>(0.2 + random.uniform());
    }
    ClusterOptions options;
    options.classes = 2 + 2 * seed;
    options.restarts = 2;
    options.iterations = 1000;
    options.seed = seed;
    SCOPED_TRACE(seed);
    const Classes classes = cluster(t, weights, options);
    expect_classes(t, weights, classes, options.classes);
    expect_fixed_point(t, weights, classes);
  }
}

TEST(Cluster, LeavesNoClassEmptyHoweverFewTheIterations) {
  for (int seed = 1; seed <= 300; ++seed) {
    const Trajectories t = blobs(14 + seed % 9, 1, 3, seed, seed % 2 == 0 ? 0.5 : 0);
    std::set<std::vector<float>> distinct;
    for (int i = 0; i < t.count; ++i) distinct.insert(t.whole.read(i));
    ClusterOptions options;
    options.classes = std::min<int>(3 + seed % 10, static_cast<int>(distinct.size()));
    options.iterations = 1 + seed % 4;
    options.restarts = 1;
    options.seed = seed;
    const Classes classes = cluster(t, equal_weights(t), options);
    for (const std::vector<int>& members : classes.members()) ASSERT_FALSE(members.empty()) << "seed " << seed;
    for (const int medoid : classes.representatives) ASSERT_GE(medoid, 0) << "seed " << seed;
  }
}

TEST(Cluster, FindsBlobsThatLieFarApart) {
  Trajectories t = blobs(60, 4, 1, 3);
  change_rows(t, [](int i, std::vector<float>& row) { row[0] += static_cast<float>(50 * (i % 5)); });
  ClusterOptions options;
  options.classes = 5;
  const Classes classes = cluster(t, equal_weights(t), options);
  for (int i = 0; i < t.count; ++i) EXPECT_EQ(classes.labels[i], classes.labels[i % 5]);
  EXPECT_EQ(std::set<int>(classes.labels.begin(), classes.labels.end()).size(), 5U);
}

TEST(Cluster, AWeightOfTwoCountsAsTwoPoints) {
  const Trajectories t = blobs(40, 2, 4, 9);
  Trajectories twice = t;
  twice.count = 80;
  twice.whole = t.whole.some(modulo(80, 40));
  ClusterOptions options;
  options.classes = 1;
  const Classes doubled = cluster(t, std::vector<float>(40, 2), options),
                both = cluster(twice, equal_weights(twice), options);
  EXPECT_NEAR(doubled.inertia, both.inertia, 1e-4 * both.inertia);
}

// Every fragment is in the nearest class of its own kind.
TEST(Cluster, NeverMixesKinds) {
  for (const int count : {60, 400, 3000}) {  // the last is sampled
    const Trajectories t = blobs(count, 5, 4, count);
    Random random(count);
    const std::vector<float> weights = equal_weights(t);
    std::vector<char> kinds;
    for (int i = 0; i < count; ++i) kinds.push_back(random.uniform() < 0.1 ? 1 : 0);
    ClusterOptions options;
    options.classes = 12;
    options.kinds = kinds;
    const Classes classes = cluster(t, weights, options);
    const Naive naive(t, weights, classes);
    const auto kind_of = [&](int k) { return kinds[classes.representatives[k]]; };
    int ones = 0, misplaced = 0;
    for (int k = 0; k < classes.count; ++k) ones += kind_of(k);
    EXPECT_TRUE(ones > 0 && ones < classes.count);
    for (int i = 0; i < count; ++i) {
      const int own = classes.labels[i];
      ASSERT_EQ(kind_of(own), kinds[i]) << i;
      for (int k = 0; k < classes.count; ++k) {
        if (kind_of(k) == kinds[i] && naive.distance(i, k) < naive.distance(i, own) - 1e-3) ++misplaced;
      }
    }
    EXPECT_LE(misplaced, count / 100);
  }
}

TEST(Cluster, OfManyFragmentsDoesNotMissTheOnlyOneOfItsKind) {
  const Trajectories t = blobs(3000, 5, 4, 1);
  ClusterOptions options;
  options.classes = 12;
  for (const int only : {0, 1, 2999}) {
    options.kinds.assign(t.count, 0);
    options.kinds[only] = 1;
    const std::vector<std::vector<int>> members = cluster(t, equal_weights(t), options).members();
    EXPECT_EQ(std::count(members.begin(), members.end(), std::vector<int>{only}), 1) << only;
  }
}

TEST(Cluster, RefusesKindsThatAreNotOneAFragment) {
  const Trajectories t = blobs(100, 5, 4, 1);
  for (const std::vector<char>& kinds : {std::vector<char>(99, 0), std::vector<char>(100, 2)}) {
    ClusterOptions options;
    options.classes = 12;
    options.kinds = kinds;
    EXPECT_THROW(cluster(t, equal_weights(t), options), std::invalid_argument);
  }
}

TEST(Cluster, IsTheSameForAnyNumberOfThreadsAndEveryRun) {
  const Trajectories t = blobs(400, 30, 12, 5);
  ClusterOptions options;
  options.classes = 20;
  options.threads = 1;
  const Classes one = cluster(t, equal_weights(t), options);
  for (const int threads : {1, 2, 3, 8}) {
    options.threads = threads;
    const Classes other = cluster(t, equal_weights(t), options);
    EXPECT_EQ(other.labels, one.labels);
    EXPECT_EQ(other.representatives, one.representatives);
    EXPECT_EQ(other.inertia, one.inertia);
  }
}

TEST(Cluster, MoreRestartsAreNeverWorse) {
  const Trajectories t = blobs(200, 4, 30, 6);
  double before = 1e30;
  for (const int restarts : {1, 2, 4, 8}) {
    ClusterOptions options;
    options.classes = 25;
    options.restarts = restarts;
    const double inertia = cluster(t, equal_weights(t), options).inertia;
    EXPECT_LE(inertia, before);
    before = inertia;
  }
}

TEST(Cluster, TakesTheRunThatScoresBest) {
  const Trajectories t = blobs(200, 4, 30, 6);
  ClusterOptions options;
  options.classes = 25;
  options.restarts = 6;
  double worst = 0;
  std::mutex mutex;
  const Classes found = cluster(t, equal_weights(t), options, [&](const Classes& classes) {
    const std::lock_guard lock(mutex);
    worst = std::max(worst, classes.inertia);
    return classes.inertia;
  });
  EXPECT_EQ(found.inertia, worst);
  EXPECT_GT(found.inertia, cluster(t, equal_weights(t), options).inertia);
}

TEST(Cluster, OneClassHoldsAllAndIsRepresentedByTheMedoid) {
  const Trajectories t = blobs(50, 3, 3, 7);
  ClusterOptions options;
  options.classes = 1;
  const Classes classes = cluster(t, equal_weights(t), options);
  expect_classes(t, equal_weights(t), classes, 1);
}

TEST(Cluster, AsManyClassesAsFragmentsHoldOneEach) {
  const Trajectories t = blobs(30, 3, 5, 8);
  ClusterOptions options;
  options.classes = 30;
  const Classes classes = cluster(t, equal_weights(t), options);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(classes.representatives[classes.labels[i]], i);
  EXPECT_NEAR(classes.inertia, 0, 1e-6);
}

TEST(Cluster, RefusesWhatCannotBeClustered) {
  const Trajectories t = blobs(20, 2, 2, 1);
  Trajectories same = t;
  same.whole = t.whole.some(modulo(20, 3));
  const auto error = [](const Trajectories& points, int classes, std::vector<float> weights) {
    ClusterOptions options;
    options.classes = classes;
    return error_of([&] { cluster(points, weights, options); });
  };
  const std::string more = error(t, 21, equal_weights(t));
  EXPECT_NE(more.find("21 classes"), std::string::npos) << more;
  EXPECT_NE(more.find("only 20"), std::string::npos) << more;
  EXPECT_NE(error(same, 4, equal_weights(t)).find("only 3"), std::string::npos);
  EXPECT_NE(error(same, 4, equal_weights(t)).find("distinct"), std::string::npos);
  EXPECT_EQ(error(same, 3, equal_weights(t)), "no error");
  EXPECT_NE(error(t, 0, equal_weights(t)).find("must be 1 to"), std::string::npos);
  EXPECT_NE(error(t, 2, {1, 2}).find("weight"), std::string::npos);
}

TEST(Cluster, RefusesFragmentsWithoutPointsAndRestartsWithoutEnd) {
  Trajectories none;
  none.count = 60;
  EXPECT_NE(error_of([&] { cluster(none, equal_weights(none), {}); }).find("point"), std::string::npos);
  Trajectories few = blobs(20, 2, 2, 1);
  ClusterOptions options;
  options.classes = 2;
  options.restarts = std::numeric_limits<int>::max();
  EXPECT_NE(error_of([&] { cluster(few, equal_weights(few), options); }).find("restarts"), std::string::npos);
  few.count = 19;
  EXPECT_NE(error_of([&] { cluster(few, equal_weights(few), {}); }).find("trajectory"), std::string::npos);
}

TEST(Cluster, RefusesWeightsThatAreOutOfAllProportion) {
  const float nan = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
  const Trajectories t = blobs(20, 2, 2, 1);
  ClusterOptions options;
  options.classes = 3;
  for (const float weight : {0.0F, -1.0F, nan, infinite}) {
    std::vector<float> weights = equal_weights(t);
    weights[7] = weight;
    const std::string error = error_of([&] { cluster(t, weights, options); });
    EXPECT_NE(error.find("fragment 7"), std::string::npos) << weight;
    EXPECT_NE(error.find("weight"), std::string::npos) << weight;
  }
}

TEST(Cluster, GivesClassesAtEveryScaleThatItAccepts) {
  for (const float scale : {1e-38F, 1e-20F, 1e-3F, 1e3F, 1e8F}) {
    Trajectories t = blobs(40, 2, 2, 1);
    change_rows(t, [&](int, std::vector<float>& row) {
      for (float& value : row) value *= scale;
    });
    for (const float weight : {1e-38F, 1.0F, 1e38F}) {
      ClusterOptions options;
      options.classes = 5;
      const Classes classes = cluster(t, std::vector<float>(t.count, weight), options);
      for (const std::vector<int>& members : classes.members()) EXPECT_FALSE(members.empty()) << scale;
      for (const int medoid : classes.representatives) EXPECT_GE(medoid, 0) << scale;
      EXPECT_TRUE(std::isfinite(classes.inertia)) << scale;
    }
  }
}

TEST(Cluster, RunsOnceWhereNoRestartIsAskedFor) {
  const Trajectories t = blobs(50, 2, 2, 1);
  for (const int restarts : {0, -3}) {
    ClusterOptions options;
    options.classes = 3;
    options.restarts = restarts;
    const auto told = [](double fraction, const std::string&) {
      EXPECT_TRUE(fraction >= 0 && fraction <= 1) << fraction;
      return true;
    };
    expect_classes(t, equal_weights(t), cluster(t, equal_weights(t), options, {}, told), 3);
  }
}

TEST(Cluster, RefusesOptionsOutOfTheirRanges) {
  const Trajectories t = blobs(50, 2, 2, 1);
  const auto error = [&](int classes, int restarts, int iterations) {
    ClusterOptions options;
    options.classes = classes;
    options.restarts = restarts;
    options.iterations = iterations;
    return error_of([&] { cluster(t, equal_weights(t), options); });
  };
  for (const int bad : {-1, 0, 10001}) EXPECT_NE(error(bad, 1, 1).find("classes must be 1 to"), std::string::npos);
  EXPECT_NE(error(2, 10001, 1).find("restarts must be 1 to 10000"), std::string::npos);
  for (const int bad : {-1, 0, 1000001}) EXPECT_NE(error(2, 1, bad).find("iterations must be"), std::string::npos);
}

TEST(Cluster, TakesTheFirstRunWhereNoScoreIsANumber) {
  const Trajectories t = blobs(50, 2, 2, 1);
  ClusterOptions options;
  options.classes = 3;
  const Classes classes = cluster(t, equal_weights(t), options, [](const Classes&) { return std::nan(""); });
  expect_classes(t, equal_weights(t), classes, 3);
}

// Poses of some tips that swing, as bones do.
Trajectories swings(int count, int tips, int poses, std::uint64_t seed) {
  Trajectories t = blobs(count, tips * poses, 1, seed);
  Random random(seed);
  t.tips = tips;
  change_rows(t, [&](int, std::vector<float>& row) {
    for (int axis = 0; axis < 3; ++axis) {
      const double kind = random.below(6), speed = kind + 0.3 * random.uniform(), phase = 0.2 * random.uniform();
      float* to = &row[std::size_t(axis) * t.whole.stride()];
      for (int pose = 0; pose < poses; ++pose) {
        for (int k = 0; k < tips; ++k) {
          to[pose * tips + k] = static_cast<float>(k + std::sin(0.3 * speed * pose + phase + k));
        }
      }
    }
  });
  return t;
}

TEST(Cluster, SettlesAmongAllPosesOfMotions) {
  for (const int poses : {2, 7, 8, 16, 19}) {
    const Trajectories t = swings(300, 5, poses, poses);
    ClusterOptions options;
    options.classes = 12;
    options.iterations = 1000;
    SCOPED_TRACE(poses);
    const Classes classes = cluster(t, equal_weights(t), options);
    expect_classes(t, equal_weights(t), classes, options.classes);
    expect_fixed_point(t, equal_weights(t), classes);
  }
}

TEST(Cluster, FindsMotionsThatDifferOnlyWithinAFewPoses) {
  Trajectories t = swings(4, 3, 16, 1);  // sums of poses tell none of these from another
  change_rows(t, [&](int i, std::vector<float>& row) {
    std::fill(row.begin(), row.end(), 0.0F);
    row[0] = static_cast<float>(i);
    row[t.tips] = static_cast<float>(-i);
  });
  ClusterOptions options;
  options.classes = 4;
  EXPECT_EQ(cluster(t, equal_weights(t), options).labels, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Cluster, OfManyFragmentsSettlesAmongAllWhatItFindsInASample) {
  const Trajectories t = swings(999, 4, 16, 3);
  ClusterOptions options;
  options.classes = 6;
  options.iterations = 1000;
  const Classes classes = cluster(t, equal_weights(t), options, [&](const Classes& found) {
    expect_classes(t, equal_weights(t), found, options.classes);
    expect_fixed_point(t, equal_weights(t), found);
    return -found.inertia;
  });
  EXPECT_EQ(classes.labels, cluster(t, equal_weights(t), options).labels);
  for (const int threads : {1, 2, 3, 16}) {
    options.threads = threads;
    const Classes other = cluster(t, equal_weights(t), options);
    EXPECT_EQ(other.labels, classes.labels);
    EXPECT_EQ(other.representatives, classes.representatives);
    EXPECT_EQ(other.inertia, classes.inertia);
  }
}

TEST(Cluster, OfManyFragmentsIsHardlyWorseThanWhereAllAreLookedAt) {
  const Trajectories t = swings(4000, 4, 16, 5);
  Trajectories fewer = t;  // a run looks at all of them at once
  fewer.count = 2999;
  fewer.whole = t.whole.some(modulo(fewer.count, fewer.count));
  ClusterOptions options;
  options.classes = 30;
  const double sampled = cluster(t, equal_weights(t), options).inertia / t.count;
  EXPECT_LE(sampled, 1.05 * cluster(fewer, equal_weights(fewer), options).inertia / fewer.count);
}

TEST(Cluster, IsCancelledByItsProgress) {
  const Trajectories t = blobs(50, 2, 2, 1);
  ClusterOptions options;
  options.classes = 3;
  int calls = 0;
  const Progress stop = [&](double, const std::string&) { return ++calls < 2; };
  EXPECT_THROW(cluster(t, equal_weights(t), options, {}, stop), Cancelled);
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace fragmotion
