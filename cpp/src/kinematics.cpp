// SPDX-License-Identifier: MIT
#include "fragmotion/kinematics.hpp"

#include <cassert>
#include <cmath>

namespace fragmotion {

namespace {

constexpr double kDegenerate = 1e-9;

/// Unit vector to the character's right in the hips' frame.
Vector3 right_of_hips(const Skeleton& skeleton, const std::vector<Vector3>& heads, const Quaternion& hips) {
  const Roles& roles = skeleton.roles;
  Vector3 right = -Vector3::UnitX();  // Blender's characters face -y
  if (roles.left_thigh >= 0 && roles.right_thigh >= 0) {
    const Vector3 line = heads[roles.right_thigh] - heads[roles.left_thigh];
    if (line.norm() > kDegenerate) right = line.normalized();
  }
  return hips.conjugate() * right;
}

}  // namespace

Vector3 CharacterFrame::to_world(const Vector3& local) const {
  return Vector3{position.x(), position.y(), 0} + rotation() * local;
}

Vector3 CharacterFrame::to_local(const Vector3& world) const {
  return rotation().conjugate() * (world - Vector3{position.x(), position.y(), 0});
}

Kinematics::Kinematics(const Skeleton& skeleton) : skeleton_(skeleton), carried_(skeleton.size()) {
  const int hips = skeleton.roles.hips;
  assert(hips >= 0 && hips < skeleton.size());
  rest_pose(skeleton_, rest_heads_, rest_rotations_);
  for (int b = 0; b < bones(); ++b) carried_[b] = !skeleton_.is_below(b, hips);
  right_ = right_of_hips(skeleton_, rest_heads_, rest_rotations_[hips]);
  rest_frame_ = frame(rest_heads_[hips], rest_rotations_[hips]);
}

CharacterFrame Kinematics::frame(const Vector3& position, const Quaternion& rotation) const {
  const Vector3 right = rotation * right_;
  const bool upright = right.head<2>().norm() >= kDegenerate;
  return {position.head<2>(), upright ? std::atan2(right.y(), right.x()) : 0};
}

void Kinematics::world(const Vector3& root_position, const double* rotations, Vector3* heads,
                       Quaternion* orientations) const {
  const int hips = skeleton_.roles.hips;
  const CharacterFrame now = frame(root_position, load_quaternion(rotations + 4 * hips));
  const Quaternion turned = now.rotation() * rest_frame_.rotation().conjugate();
  for (int b = 0; b < bones(); ++b) {
    const int parent = skeleton_.parents[b];
    const Quaternion rotation = load_quaternion(rotations + 4 * b);
    if (carried_[b]) {
      heads[b] = now.to_world(rest_frame_.to_local(rest_heads_[b]));
      orientations[b] = turned * rest_rotations_[b];
    } else if (b == hips) {
      heads[b] = root_position;
      orientations[b] = rotation;
    } else {
      heads[b] = heads[parent] + orientations[parent] * skeleton_.offsets[b];
      orientations[b] = orientations[parent] * rotation;
    }
  }
}

}  // namespace fragmotion
