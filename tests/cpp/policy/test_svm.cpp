// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "mocap_files.hpp"
#include "policy/greedy.hpp"
#include "policy/optimal.hpp"
#include "policy/svm.hpp"
#include "random_quality.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

// Classes with poses of random tips: what the SVM's features are made of.
struct World {
  Trajectories t;
  Classes classes;
  Quality quality;
  std::vector<double> features;
  std::vector<std::vector<int>> traces;

  World(int n, int fragments, std::uint64_t seed, int steps = 200) {
    Random random(seed);
    t.count = fragments;
    t.pose_stride = 8;
    for (int i = 0; i < fragments * 3 * t.pose_stride; ++i) {
      t.last.push_back(static_cast<float>(random.uniform()));
      t.first.push_back(static_cast<float>(random.uniform()));
    }
    classes.count = n;
    for (int k = 0; k < n; ++k) classes.representatives.push_back(fragments / n * k);
    quality = random_quality(random, n);
    features = class_features(t, classes);
    traces = {random_trace(random, steps, 12)};
  }
};

double row_distance(const double* a, const double* b, int width) {
  double sum = 0;
  for (int i = 0; i < width; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

TEST(ClassFeatures, KeepTheDistancesOfTheLastPosesUpToAScale) {
  const World w(6, 24, 1);  // six poses span five dimensions: nothing is lost
  const int width = static_cast<int>(w.features.size()) / 6;
  double scale = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b < a; ++b) {
      const float *p = w.t.last_pose(w.classes.representatives[a]), *q = w.t.last_pose(w.classes.representatives[b]);
      double poses = 0;
      for (int i = 0; i < 3 * w.t.pose_stride; ++i) poses += std::pow(double(p[i]) - q[i], 2);
      const double ratio = row_distance(&w.features[a * width], &w.features[b * width], width) / std::sqrt(poses);
      if (scale == 0) scale = ratio;
      EXPECT_NEAR(ratio, scale, 1e-6 * scale);
    }
  }
}

TEST(ClassFeatures, AreUncorrelatedAndInUnitsOfTheFirstOnesSpread) {
  const World w(40, 40, 2);
  const int width = static_cast<int>(w.features.size()) / 40;
  EXPECT_LE(width, 8);
  double previous = 2;
  for (int i = 0; i < width; ++i) {
    for (int j = 0; j <= i; ++j) {
      double mean = 0, product = 0;
      for (int k = 0; k < 40; ++k) {
        mean += w.features[k * width + i] / 40;
        product += w.features[k * width + i] * w.features[k * width + j] / 40;
      }
      EXPECT_NEAR(mean, 0, 1e-9);
      if (i != j) {
        EXPECT_NEAR(product, 0, 1e-9);
        continue;
      }
      if (i == 0) {
        EXPECT_NEAR(product, 1, 1e-9);
      }
      EXPECT_LE(product, previous + 1e-12);
      previous = product;
    }
  }
}

TEST(ClassFeatures, OfOneClassAreFinite) {
  const World w(1, 3, 3);
  for (const double value : w.features) EXPECT_TRUE(std::isfinite(value));
}

TEST(SvmSamples, AreTheStepsOfOptimalsPaths) {
  World w(6, 24, 4);
  Random random(1);
  w.traces.push_back(random_trace(random, 50));
  const ControlSpace space;
  const SvmSamples samples = svm_samples(w.quality, w.traces, w.features, space);
  ASSERT_EQ(samples.labels.size(), 250U);
  const int width = static_cast<int>(w.features.size()) / 6;
  ASSERT_EQ(samples.width, width + 4);
  std::size_t row = 0;
  for (const std::vector<int>& trace : w.traces) {
    const OptimalPath path = optimal_path(w.quality, trace);
    for (std::size_t i = 0; i < trace.size(); ++i, ++row) {
      EXPECT_EQ(samples.labels[row], path.classes[i + 1]);
      const double* x = &samples.inputs[row * samples.width];
      for (int k = 0; k < width; ++k) EXPECT_EQ(x[k], w.features[path.classes[i] * width + k]);
    }
  }
  // The control's part of the inputs is ControlDis as a Euclidean distance.
  for (std::size_t a = 0; a < 50; ++a) {
    const double *x = &samples.inputs[a * samples.width], *y = &samples.inputs[(a + 1) * samples.width];
    EXPECT_NEAR(row_distance(x + width, y + width, 4),
                space.distance(space.point(w.traces[0][a]), space.point(w.traces[0][a + 1])), 1e-12);
  }
}

TEST(SvmPolicy, RemembersItsTrainingSamplesWhereThePenaltyIsHigh) {
  const World w(6, 24, 5);
  SvmOptions options;
  options.c = 1e4;
  options.gamma = 4;
  const SvmPolicy found = svm_policy(w.quality, w.traces, w.features, ControlSpace(), options);
  EXPECT_EQ(found.c, 1e4);
  EXPECT_EQ(found.gamma, 4);
  EXPECT_EQ(found.accuracy, 0);
  const OptimalPath path = optimal_path(w.quality, w.traces[0]);
  // Equal inputs may have several labels, as the best next class depends on what comes: those cannot all be right.
  int right = 0, determined = 0;
  for (std::size_t i = 0; i < w.traces[0].size(); ++i) {
    bool one = true;
    for (std::size_t j = 0; j < w.traces[0].size(); ++j) {
      const bool same = path.classes[j] == path.classes[i] && w.traces[0][j] == w.traces[0][i];
      one = one && (!same || path.classes[j + 1] == path.classes[i + 1]);
    }
    if (!one) continue;
    ++determined;
    right += found.policy(path.classes[i], w.traces[0][i]) == path.classes[i + 1] ? 1 : 0;
  }
  EXPECT_GT(determined, 30);
  EXPECT_EQ(right, determined);
}

TEST(SvmPolicy, ChoosesItsParametersAlikeForAnyNumberOfThreads) {
  const World w(8, 24, 6);
  SvmOptions options;
  options.threads = 1;
  const SvmPolicy one = svm_policy(w.quality, w.traces, w.features, ControlSpace(), options);
  EXPECT_GT(one.c, 0);
  EXPECT_GT(one.gamma, 0);
  EXPECT_GE(one.accuracy, 0);
  EXPECT_LE(one.accuracy, 1);
  for (const int threads : {1, 2, 5}) {
    options.threads = threads;
    const SvmPolicy other = svm_policy(w.quality, w.traces, w.features, ControlSpace(), options);
    EXPECT_EQ(other.c, one.c);
    EXPECT_EQ(other.gamma, one.gamma);
    EXPECT_EQ(other.accuracy, one.accuracy);
    EXPECT_EQ(other.policy.next, one.policy.next);
  }
}

TEST(SvmPolicy, LearnsASingleClass) {
  World w(3, 9, 7);
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) w.quality.smoothness[from * 3 + to] = to == 2 ? 1 : 0.1;
  }
  std::fill(w.quality.match.begin(), w.quality.match.end(), 1.0);
  const SvmPolicy found = svm_policy(w.quality, w.traces, w.features, ControlSpace());
  for (const int next : found.policy.next) EXPECT_EQ(next, 2);
}

TEST(SvmPolicy, LearnsFromTheShortestTrace) {
  World w(3, 9, 8);
  w.traces = {{0, 50}};
  const SvmPolicy found = svm_policy(w.quality, w.traces, w.features, ControlSpace());
  for (const int next : found.policy.next) EXPECT_TRUE(next >= 0 && next < 3);
}

TEST(SvmPolicy, KeepsTheParameterThatIsGivenAndSearchesTheOther) {
  const World w(8, 24, 6);
  SvmOptions options;
  options.c = 3;
  const SvmPolicy searched = svm_policy(w.quality, w.traces, w.features, ControlSpace(), options);
  EXPECT_EQ(searched.c, 3);
  EXPECT_GT(searched.gamma, 0);
  EXPECT_GT(searched.accuracy, 0);
  options = {};
  options.gamma = 0.3;
  const SvmPolicy other = svm_policy(w.quality, w.traces, w.features, ControlSpace(), options);
  EXPECT_EQ(other.gamma, 0.3);
  EXPECT_GT(other.c, 0);
  EXPECT_GT(other.accuracy, 0);
}

// With blocks of 50 samples, these would be one fold, which has nothing else to learn from.
TEST(SvmPolicy, CrossValidatesShortTraces) {
  for (const int steps : {6, 20, 50}) {
    const World w(3, 9, 11, steps);
    EXPECT_GT(svm_policy(w.quality, w.traces, w.features, ControlSpace()).accuracy, 0) << steps;
  }
}

TEST(SvmPolicy, RefusesParametersOutOfRange) {
  const World w(3, 9, 9);
  const auto error = [&](double c, double gamma) {
    return error_of([&] { svm_policy(w.quality, w.traces, w.features, ControlSpace(), {c, gamma}); });
  };
  for (const double bad : {-1.0, 1.1e6, std::nan(""), static_cast<double>(INFINITY), 1e308, 1e-308}) {
    EXPECT_NE(error(bad, 1).find("C and gamma"), std::string::npos) << bad;
    EXPECT_NE(error(1, bad).find("C and gamma"), std::string::npos) << bad;
  }
}

TEST(SvmPolicy, RefusesClassesWithoutFeatures) {
  const World w(3, 9, 9);
  for (const std::size_t count : {0, 2, 4}) {
    const auto error = error_of([&] { svm_policy(w.quality, w.traces, std::vector<double>(count), ControlSpace()); });
    EXPECT_NE(error.find("features"), std::string::npos) << count;
  }
}

TEST(SvmPolicy, RefusesToLearnFromNothing) {
  const World w(3, 9, 9);
  EXPECT_NE(error_of([&] { svm_policy(w.quality, {}, w.features, ControlSpace()); }).find("trace"), std::string::npos);
}

TEST(SvmPolicy, IsCancelledByItsProgress) {
  const World w(4, 12, 10);
  const Progress stop = [](double, const std::string&) { return false; };
  EXPECT_THROW(svm_policy(w.quality, w.traces, w.features, ControlSpace(), {}, stop), Cancelled);
}

}  // namespace
}  // namespace fragmotion
