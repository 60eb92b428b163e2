// SPDX-License-Identifier: MIT
#include "motion/bobbing.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "base/quantile.hpp"
#include "motion/soles.hpp"

namespace fragmotion {
namespace {

constexpr double kTooFar = 5;  // times: flights go farther than legs, too; jumps that are drawn 4 times at most

// The hips' heights, and how high they are over what is lowest of the feet.
struct Bobbing {
  Eigen::ArrayXd hips, legs;
};

Bobbing bobbing_of(const Kinematics& kinematics, const Clip& clip) {
  Bobbing of{Eigen::ArrayXd(clip.frames), Eigen::ArrayXd(clip.frames)};
  const std::vector<SolePath> soles = find_soles(kinematics, clip);
  for (int f = 0; f < clip.frames; ++f) {
    of.hips[f] = of.legs[f] = clip.root_positions[std::size_t{3} * f + 2];
    double lowest = std::numeric_limits<double>::infinity();
    for (const SolePath& sole : soles) {
      for (const SolePoint& point : sole.points) lowest = std::min(lowest, point.path[f].z());
    }
    of.legs[f] -= lowest;
  }
  of.hips -= of.hips.mean(), of.legs -= of.legs.mean();
  return of;
}

}  // namespace

double bobs(const Kinematics& kinematics, const Clip& clip) {
  if (legs_with_feet(kinematics.skeleton().roles).empty()) return 0;
  const auto [hips, legs] = bobbing_of(kinematics, clip);
  const double both = (hips * legs).sum(), of_hips = hips.square().sum();
  return both > 0 && 2 * both * both > of_hips * legs.square().sum() ? of_hips / both : 0;
}

double bobs_too_far(const Kinematics& kinematics, const std::vector<Clip>& clips) {
  std::vector<double> told;
  for (const Clip& clip : clips) {
    const double times = bobs(kinematics, clip);
    if (times > 0) told.push_back(times);
  }
  if (told.empty() || *std::min_element(told.begin(), told.end()) < kTooFar) return 1;
  return median(told);
}

}  // namespace fragmotion
