// SPDX-License-Identifier: MIT
#include "skeleton/kinematics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "base/rounding.hpp"
#include "base/vectorised.hpp"

#pragma GCC diagnostic ignored "-Wpsabi"  // how vectors are returned, of functions that are inlined

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

/// Four numbers side by side: x, y, z and, of a rotation, w.
using Four = double __attribute__((vector_size(32)));

/// Those that lie anywhere in memory.
[[gnu::always_inline]] inline Four load_four(const double* numbers) {
  Four four;
  std::memcpy(&four, numbers, sizeof(four));
  return four;
}

[[gnu::always_inline]] inline void store_four(const Four& four, double* numbers) {
  std::memcpy(numbers, &four, sizeof(four));
}

template <int kA, int kB, int kC, int kD>
[[gnu::always_inline]] inline Four ordered(const Four& v) {
  return Four{v[kA], v[kB], v[kC], v[kD]};
}

[[gnu::always_inline]] inline Four four(const Vector3& v) { return Four{v.x(), v.y(), v.z(), 0}; }

/// From head and orientation of a bone to those of one that hangs on it. The sums are in the order of product() and of
/// turned().
[[gnu::always_inline]] inline void attach(const Four& offset, const Four& wxyz, Four& head, Four& turn) {
  const Four yzx = ordered<1, 2, 0, 3>(turn), zxy = ordered<2, 0, 1, 3>(turn),
             across = 2 * (yzx * ordered<2, 0, 1, 3>(offset) - zxy * ordered<1, 2, 0, 3>(offset));
  head = head + offset + turn[3] * across + yzx * ordered<2, 0, 1, 3>(across) - zxy * ordered<1, 2, 0, 3>(across);
  turn = turn[3] * ordered<1, 2, 3, 0>(wxyz) + turn[0] * (ordered<0, 3, 2, 1>(wxyz) * Four{1, -1, 1, -1}) +
         turn[1] * (ordered<3, 0, 1, 2>(wxyz) * Four{1, 1, -1, -1}) +
         turn[2] * (ordered<2, 1, 0, 3>(wxyz) * Four{-1, 1, 1, -1});
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

[[gnu::cold]] Kinematics::Kinematics(const Skeleton& skeleton) {
  const int hips = skeleton.roles.hips;
  assert(hips >= 0 && hips < skeleton.size());
  const auto parts = std::make_shared<Parts>();
  parts->skeleton = skeleton;
  for (const Vector3& offset : skeleton.offsets) parts->offsets.push_back({offset.x(), offset.y(), offset.z(), 0});
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

[[gnu::cold]] std::vector<int> Kinematics::chains(const std::vector<int>& ends) const {
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
  heads[hips] = root_position;
  orientations[hips] = load_quaternion(rotations + std::ptrdiff_t{4} * hips);
  const auto turn_of = [&](int b) { return orientations[b].coeffs().data(); };
  Four head = four(root_position), turn = load_four(turn_of(hips));
  int last = hips;
  for (const int b : bones) {
    const int parent = skeleton.parents[b];
    if (parent != last) head = four(heads[parent]), turn = load_four(turn_of(parent));
    const Four offset = load_four(parts_->offsets[b].data()), wxyz = load_four(rotations + std::ptrdiff_t{4} * b);
    attach(offset, wxyz, head, turn);
    heads[b] = {head[0], head[1], head[2]};
    store_four(turn, turn_of(b));
    last = b;
  }
}

}  // namespace fragmotion
