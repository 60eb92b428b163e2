// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "doctor/examine.hpp"
#include "doctor/mend.hpp"
#include "doctor/patient.hpp"
#include "walker.hpp"

namespace fragmotion {

inline constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

inline Take take_of(const Skeleton& skeleton, const Clip& clip) {
  Take take{skeleton, clip.name, clip.rate, clip.frames, {}, clip.rotations};
  for (int f = 0; f < clip.frames; ++f) {
    for (int b = 0; b < skeleton.size(); ++b) {
      const Vector3 place = b == 0 ? load_vector(&clip.root_positions[3 * f]) : skeleton.offsets[b];
      take.translations.insert(take.translations.end(), {place.x(), place.y(), place.z()});
    }
  }
  return make_take(take);
}

inline Take with_basis(const Take& take, const Eigen::Matrix3d& basis, double scale = 1) {
  Patient patient(take);
  patient.change_basis(basis, scale);
  Take changed = patient.take();
  changed.unit = take.unit;
  return changed;
}

inline Take walk(const Gait& gait = {}) { return take_of(humanoid(), gait_clip(gait, "walk")); }

inline std::vector<Finding> findings_of(const Take& take) { return examine({take}, 1)[0].findings; }

inline std::vector<std::string> codes_of(const Take& take) {
  std::vector<std::string> codes;
  for (const Finding& finding : findings_of(take)) codes.push_back(finding.code);
  return codes;
}

inline double* rotation(Take& take, int frame, const std::string& bone) {
  return &take.rotations[std::size_t{4} * (frame * take.skeleton.size() + take.skeleton.find(bone))];
}

inline double* place(Take& take, int frame, int bone = 0) {
  return &take.translations[std::size_t{3} * (frame * take.skeleton.size() + bone)];
}

inline Take picked(const Take& take, const std::vector<int>& frames) {
  Take result = take;
  result.frames = 0;
  result.translations.clear();
  result.rotations.clear();
  const std::size_t bones = take.skeleton.names.size();
  for (const int f : frames) {
    ++result.frames;
    const auto t = take.translations.begin() + static_cast<std::ptrdiff_t>(3 * bones * f);
    const auto r = take.rotations.begin() + static_cast<std::ptrdiff_t>(4 * bones * f);
    result.translations.insert(result.translations.end(), t, t + static_cast<std::ptrdiff_t>(3 * bones));
    result.rotations.insert(result.rotations.end(), r, r + static_cast<std::ptrdiff_t>(4 * bones));
  }
  return result;
}

inline std::vector<int> counted(int count, int first = 0) {
  std::vector<int> frames(count);
  std::iota(frames.begin(), frames.end(), first);
  return frames;
}

inline void expect_near(const Take& take, const Take& clean, double tolerance) {
  ASSERT_EQ(take.frames, clean.frames);
  std::vector<double> ours, theirs, rotations;
  world_transforms(take, ours, rotations);
  world_transforms(clean, theirs, rotations);
  double farthest = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) farthest = std::max(farthest, std::abs(ours[i] - theirs[i]));
  EXPECT_LE(farthest, tolerance);
}

/// Exactly one finding, of this code and these frames; mended it is gone, and the take is the clean one again.
inline void expect_mended(const Take& damaged, const std::string& code, int begin, int end, const Take& clean,
                          double tolerance = 1e-9) {
  const std::vector<Finding> findings = findings_of(damaged);
  ASSERT_EQ(codes_of(damaged), std::vector<std::string>{code});
  EXPECT_EQ(findings[0].begin, begin);
  EXPECT_EQ(findings[0].end, end);
  EXPECT_FALSE(findings[0].text.empty());
  EXPECT_TRUE(findings[0].mendable);
  const Take mended = mend(damaged, findings);
  EXPECT_EQ(codes_of(mended), std::vector<std::string>{});
  expect_near(mended, clean, tolerance);
  EXPECT_EQ(mend(mended, findings).rotations, mended.rotations);
}

}  // namespace fragmotion
