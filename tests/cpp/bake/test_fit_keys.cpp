// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "bake/fit_keys.hpp"

namespace fragmotion {
namespace {

std::vector<double> waves(int frames) {
  std::vector<double> values;
  for (int f = 0; f < frames; ++f) {
    const double t = f / 30.0;
    values.insert(values.end(), {std::sin(2 * t) + 0.2 * std::sin(11 * t), std::cos(3 * t), 0.1 * t * t});
  }
  return values;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b, int width) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); i += width) {
    double sum = 0;
    for (int k = 0; k < width; ++k) sum += (a[i + k] - b[i + k]) * (a[i + k] - b[i + k]);
    most = std::max(most, std::sqrt(sum));
  }
  return most;
}

TEST(FitKeys, StaysWithinItsTolerance) {
  const std::vector<double> values = waves(400);
  std::size_t before = values.size();
  for (const double tolerance : {1e-4, 1e-3, 1e-2, 1e-1}) {
    const FittedKeys keys = fit_keys(values, 3, tolerance);
    EXPECT_LE(farthest(keys.drawn, values, 3), tolerance);
    EXPECT_LT(keys.key_frames.size(), before) << "a wider tolerance needs fewer keys";
    before = keys.key_frames.size();
    EXPECT_EQ(keys.key_frames.front(), 0);
    EXPECT_EQ(keys.key_frames.back(), 399);
    for (const int frame : keys.key_frames) {
      for (int k = 0; k < 3; ++k) EXPECT_EQ(keys.drawn[3 * frame + k], values[3 * frame + k]);
    }
  }
}

TEST(FitKeys, NeedsTwoKeysForACubic) {
  std::vector<double> values;
  for (int f = 0; f < 50; ++f) values.push_back(1 + 0.3 * f - 0.02 * f * f + 3e-4 * f * f * f);
  const FittedKeys keys = fit_keys(values, 1, 0.01);
  EXPECT_EQ(keys.key_frames, (std::vector<int>{0, 49}));
  EXPECT_NEAR(keys.slopes[0], 0.3, 1e-3);
}

TEST(FitKeys, KeepsAJumpOfOneFrame) {
  std::vector<double> values(30, 0.0);
  values[11] = 1;
  const FittedKeys keys = fit_keys(values, 1, 0.01);
  EXPECT_LE(farthest(keys.drawn, values, 1), 0.01);
}

TEST(FitKeys, TakesASingleFrameAndTwo) {
  EXPECT_EQ(fit_keys({1, 2}, 2, 0.1).key_frames, std::vector<int>{0});
  EXPECT_EQ(fit_keys({1, 2}, 1, 0.1).key_frames, (std::vector<int>{0, 1}));
}

TEST(FitKeys, RefusesWhatItCannotFit) {
  EXPECT_THROW(fit_keys({}, 1, 0.1), std::invalid_argument);
  EXPECT_THROW(fit_keys({1, 2, 3}, 2, 0.1), std::invalid_argument);
  EXPECT_THROW(fit_keys({1, 2}, 0, 0.1), std::invalid_argument);
  EXPECT_THROW(fit_keys({1, 2}, 1, 0), std::invalid_argument);
  EXPECT_THROW(fit_keys({1, std::numeric_limits<double>::quiet_NaN()}, 1, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion
