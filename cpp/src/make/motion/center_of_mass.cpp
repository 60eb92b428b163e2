// SPDX-License-Identifier: MIT
#include "motion/center_of_mass.hpp"

#include <numeric>

namespace fragmotion {
namespace {

// Shares `mass` equally among the bones from `bone` up to, but without, `end`.
void share_up_to(const Skeleton& skeleton, int bone, int end, double mass, std::vector<double>& masses) {
  std::vector<int> chain;
  for (int b = bone; b >= 0 && b != end; b = skeleton.parents[b]) chain.push_back(b);
  for (const int b : chain) masses[b] += mass / static_cast<double>(chain.size());
}

// Gives the bone and the bones above it, one segment each, the masses in `segments`.
void share_limb(const Skeleton& skeleton, int bone, std::initializer_list<double> segments,
                std::vector<double>& masses) {
  for (const double mass : segments) {
    if (bone < 0) return;
    masses[bone] += mass;
    bone = skeleton.parents[bone];
  }
}

}  // namespace

std::vector<double> segment_masses(const Skeleton& skeleton) {
  const Roles& roles = skeleton.roles;
  std::vector<double> masses(skeleton.size(), 0);
  const bool complete =
      roles.head >= 0 && roles.left_hand >= 0 && roles.right_hand >= 0 && roles.left_foot >= 0 && roles.right_foot >= 0;
  if (complete) {
    masses[roles.head] += 0.081;
    share_up_to(skeleton, skeleton.parents[roles.head], skeleton.parents[roles.hips], 0.497, masses);
    for (const int hand : {roles.left_hand, roles.right_hand})
      share_limb(skeleton, hand, {0.006, 0.016, 0.028}, masses);
    for (const int foot : {roles.left_foot, roles.right_foot})
      share_limb(skeleton, foot, {0.0145, 0.0465, 0.1}, masses);
  } else {
    for (int b = 0; b < skeleton.size(); ++b) masses[b] = skeleton.is_below(b, roles.hips) ? 1 : 0;
  }
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  for (double& mass : masses) mass /= total;
  return masses;
}

Vector3 center_of_mass(const Skeleton& skeleton, const std::vector<double>& masses, const PosedBones& posed) {
  Vector3 center = Vector3::Zero();
  for (std::size_t b = 0; b < masses.size(); ++b) {
    if (masses[b] > 0) center += masses[b] * (posed.heads[b] + posed.rotations[b] * (0.5 * skeleton.tips[b]));
  }
  return center;
}

std::vector<Vector3> center_of_mass(const Kinematics& kinematics, const Clip& clip) {
  const Skeleton& skeleton = kinematics.skeleton();
  const std::vector<double> masses = segment_masses(skeleton);
  std::vector<Vector3> centers;
  PosedBones posed(kinematics.bones());
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    centers.push_back(center_of_mass(skeleton, masses, posed));
  }
  return centers;
}

}  // namespace fragmotion
