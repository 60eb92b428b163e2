// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/ranges.hpp"
#include "skeleton/skeleton.hpp"

namespace fragmotion {
namespace {

// Legs end at joints that every rig has, and are the length by which gaits of bodies of all sizes are alike (Alexander,
// "Optimization and Gaits in the Locomotion of Vertebrates", 1989). Necks do not: rigs begin them anywhere from between
// the collar bones to C7.
constexpr double kLeastStature = 1e-3, kMostStature = 1e7;  // m

/// From a leaf's tip to another leaf's tip, the longest way through `root` or below: each bone joins its two longest
/// branches.
double longest_chain(const Skeleton& skeleton, int root) {
  std::vector<double> longest(skeleton.size(), 0), second(skeleton.size(), 0);
  std::vector<bool> leaf(skeleton.size(), true);
  double chain = 0;
  for (int bone = skeleton.size() - 1; bone >= root; --bone) {
    if (!skeleton.is_below(bone, root)) continue;
    if (leaf[bone]) longest[bone] = skeleton.tips[bone].norm();
    chain = std::max(chain, longest[bone] + second[bone]);
    if (bone == root) break;
    const int parent = skeleton.parents[bone];
    leaf[parent] = false;
    double branch = skeleton.offsets[bone].norm() + longest[bone];
    if (branch > longest[parent]) std::swap(branch, longest[parent]);
    second[parent] = std::max(second[parent], branch);
  }
  return chain;
}

/// By the way along the bones from hip joint to ankle; 0 where there is no such leg.
double stature_of(const Skeleton& skeleton, const LegRoles& leg) {
  if (!skeleton.is_below(leg.foot, leg.thigh)) return 0;
  const bool whole = ends_without_foot(skeleton, leg);
  double length = whole ? skeleton.tips[leg.foot].norm() : 0;
  for (int bone = leg.foot; bone != leg.thigh; bone = skeleton.parents[bone]) length += skeleton.offsets[bone].norm();
  return length / (whole ? kHipHeightOfStature : kLegOfStature);
}

}  // namespace

double stature(const Skeleton& skeleton) {
  const std::array<LegRoles, kMostLegs> legs = leg_roles(skeleton.roles);
  const double left = stature_of(skeleton, legs[0]), right = stature_of(skeleton, legs[1]);
  if (left > 0 && right > 0) return (left + right) / 2;
  if (left > 0 || right > 0) return std::max(left, right);
  return longest_chain(skeleton, std::max(skeleton.roles.hips, 0));
}

void check_stature(const Skeleton& skeleton) {
  const double height = stature(skeleton);
  if (height >= kLeastStature && height <= kMostStature) return;
  throw std::invalid_argument("the bones from '" + skeleton.names[skeleton.roles.hips] + "' on make a character " +
                              text_of(height) + " m tall: it must be 1 mm to 10,000 km");
}

double standard_scale(const Skeleton& skeleton) { return 1.8 / stature(skeleton); }

}  // namespace fragmotion
