// SPDX-License-Identifier: MIT
#include "skeleton/kinematics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/rounding.hpp"
#include "base/vectorised.hpp"

namespace fragmotion {

namespace {

/// Unit vector to the character's right in the hips' frame.
Vector3 right_of_hips(const Skeleton& skeleton, const std::vector<Vector3>& heads, const Quaternion& hips) {
  const Roles& roles = skeleton.roles;
  Vector3 right = -Vector3::UnitX();  // Blender's characters face -y
  if (roles.left_thigh >= 0 && roles.right_thigh >= 0) {
    const Vector3 line = heads[roles.right_thigh] - heads[roles.left_thigh];
    if (line.norm() > kRounding) right = line.normalized();
  }
  return hips.conjugate() * right;
}

/// The rotation about z that brings +x to a direction; none where the direction is hardly one.
Quaternion rotation_towards(const Vector2& direction) {
  const double length = direction.norm();
  if (length < kRounding) return Quaternion::Identity();
  const double cosine = direction.x() / length, sine = direction.y() / length;
  const double larger = std::sqrt((1 + std::abs(cosine)) / 2), smaller = std::abs(sine) / (2 * larger);
  const double w = cosine < 0 ? smaller : larger, z = cosine < 0 ? larger : smaller;
  return {w, 0, 0, std::copysign(z, sine)};
}

/// From head and orientation of a bone to those of one that hangs on it. Number by number: what a vector instruction
/// would load has just been written in other parts, and would have to be waited for.
inline void attach(const Vector3& offset, const double* wxyz, Vector3& head, Quaternion& turn) {
  const double w = turn.w(), x = turn.x(), y = turn.y(), z = turn.z();
  const double u = 2 * (y * offset.z() - z * offset.y()), v = 2 * (z * offset.x() - x * offset.z()),
               t = 2 * (x * offset.y() - y * offset.x());
  head = {head.x() + offset.x() + w * u + y * t - z * v, head.y() + offset.y() + w * v + z * u - x * t,
          head.z() + offset.z() + w * t + x * v - y * u};
  const double a = wxyz[0], b = wxyz[1], c = wxyz[2], d = wxyz[3];
  turn = {w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c, w * c - x * d + y * a + z * b,
          w * d + x * c - y * b + z * a};
}

}  // namespace

Vector3 CharacterFrame::to_world(const Vector3& local) const {
  const auto [c, s] = PlaneTurn(heading);
  return {position.x() + c * local.x() - s * local.y(), position.y() + s * local.x() + c * local.y(), local.z()};
}

Vector3 CharacterFrame::to_local(const Vector3& world) const {
  const auto [c, s] = PlaneTurn(heading);
  const double x = world.x() - position.x(), y = world.y() - position.y();
  return {c * x + s * y, c * y - s * x, world.z()};
}

Kinematics::Kinematics(const Skeleton& skeleton) {
  const int hips = skeleton.roles.hips;
  assert(hips >= 0 && hips < skeleton.size());
  const auto parts = std::make_shared<Parts>();
  parts->skeleton = skeleton;
  rest_pose(skeleton, parts->rest_heads, parts->rest_rotations);
  for (int b = 0; b < skeleton.size(); ++b) {
    if (b != hips) (skeleton.is_below(b, hips) ? parts->below : parts->carried).push_back(b);
  }
  parts->right = right_of_hips(skeleton, parts->rest_heads, parts->rest_rotations[hips]);
  parts_ = parts;
  parts->rest_frame = frame(parts->rest_heads[hips], parts->rest_rotations[hips]);
  const Quaternion to_frame = parts->rest_frame.rotation().conjugate();
  for (Vector3& head : parts->rest_heads) head = parts->rest_frame.to_local(head);
  for (Quaternion& rotation : parts->rest_rotations) rotation = to_frame * rotation;
}

CharacterFrame Kinematics::frame(const Vector3& position, const Quaternion& rotation) const {
  const Vector3 right = rotation * parts_->right;
  const bool upright = right.head<2>().norm() >= kRounding;
  return {position.head<2>(), upright ? std::atan2(right.y(), right.x()) : 0};
}

// Poses the bones above the hips.
void Kinematics::carry(const Vector3& root_position, const Quaternion& hips, Vector3* heads,
                       Quaternion* orientations) const {
  const Quaternion turned = rotation_towards((hips * parts_->right).head<2>());
  const Vector3 place{root_position.x(), root_position.y(), 0};
  for (const int b : parts_->carried) {
    heads[b] = place + turned * parts_->rest_heads[b];
    orientations[b] = turned * parts_->rest_rotations[b];
  }
}

std::vector<int> Kinematics::chains(const std::vector<int>& ends) const {
  std::vector<int> bones;
  for (const int b : parts_->below) {
    const auto above = [&](int end) { return end >= 0 && skeleton().is_below(end, b); };
    if (std::any_of(ends.begin(), ends.end(), above)) bones.push_back(b);
  }
  return bones;
}

void Kinematics::world(const Vector3& root_position, const double* rotations, Vector3* heads,
                       Quaternion* orientations) const {
  world(root_position, rotations, parts_->below, heads, orientations);
}

void Kinematics::world(const Vector3& root_position, const double* rotations, const std::vector<int>& bones,
                       Vector3* heads, Quaternion* orientations) const {
  world_below(root_position, rotations, bones, heads, orientations);
  if (!parts_->carried.empty()) carry(root_position, orientations[skeleton().roles.hips], heads, orientations);
}

FRAGMOTION_VECTORISED void Kinematics::world_below(const Vector3& root_position, const double* rotations,
                                                   const std::vector<int>& bones, Vector3* heads,
                                                   Quaternion* orientations) const {
  const Skeleton& skeleton = parts_->skeleton;
  const int hips = skeleton.roles.hips;
  Vector3 head = heads[hips] = root_position;
  Quaternion turn = orientations[hips] = load_quaternion(rotations + std::ptrdiff_t{4} * hips);
  int last = hips;
  for (const int b : bones) {
    const int parent = skeleton.parents[b];
    if (parent != last) head = heads[parent], turn = orientations[parent];
    attach(skeleton.offsets[b], rotations + std::ptrdiff_t{4} * b, head, turn);
    heads[b] = head;
    orientations[b] = turn;
    last = b;
  }
}

}  // namespace fragmotion
