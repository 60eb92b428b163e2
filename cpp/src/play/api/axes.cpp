// SPDX-License-Identifier: MIT
#include "api/axes.hpp"

#include <cmath>

namespace fragmotion {
namespace {

void write_rotation(const Quaternion& q, float* xyzw) {
  for (int i = 0; i < 4; ++i) xyzw[i] = static_cast<float>(q.coeffs()[i]);
}

}  // namespace

Axes::Axes(FragmotionAxes axes, double unit) : bone_{1, 1, 1}, unit_(unit) {
  const double half = std::sqrt(0.5);
  switch (axes) {
    case FRAGMOTION_AXES_GLTF:
      from_ = {0, 2, 1};
      sign_ = {1, 1, -1};
      bones_ = {half, -half, 0, 0};
      break;
    case FRAGMOTION_AXES_UNITY:
      from_ = {0, 2, 1};
      sign_ = {1, 1, 1};
      bone_ = {-1, 1, 1};
      bones_ = {0, 0, half, half};
      break;
    case FRAGMOTION_AXES_UNREAL:
      from_ = {1, 0, 2};
      sign_ = {1, 1, 1};
      bone_ = {1, -1, 1};
      bones_ = {half, 0, 0, half};
      break;
    default:
      from_ = {0, 1, 2};
      sign_ = {1, 1, 1};
      bones_ = Quaternion::Identity();
  }
  yaw_ = bone_[0] * bone_[1] * bone_[2];
  for (int i = 0; i < 3; ++i) turn_[i] = yaw_ * bone_[i];
}

Vector3 Axes::direction(const Vector3& ours) const {
  return {sign_[0] * ours[from_[0]], sign_[1] * ours[from_[1]], sign_[2] * ours[from_[2]]};
}

Vector3 Axes::ours(const float theirs[3]) const {
  Vector3 found;
  for (int i = 0; i < 3; ++i) found[from_[i]] = sign_[i] * static_cast<double>(theirs[i]);
  return found;
}

void Axes::write_place(const Vector3& ours, float* theirs) const {
  const Vector3 found = unit_ * direction(ours);
  for (int i = 0; i < 3; ++i) theirs[i] = static_cast<float>(found[i]);
}

void Axes::write_heading(double heading, float rotation[4]) const {
  const Vector3 up = std::sin(yaw(heading) / 2) * direction(Vector3::UnitZ());
  write_rotation({std::cos(heading / 2), up.x(), up.y(), up.z()}, rotation);
}

FragmotionTransform Axes::global(const Vector3& place, const Quaternion& rotation) const {
  FragmotionTransform theirs;
  write_place(place, theirs.position);
  write_rotation(bones_ * mirrored(rotation), theirs.rotation);
  return theirs;
}

FragmotionTransform Axes::local(const Vector3& place, const Quaternion& rotation) const {
  FragmotionTransform theirs;
  for (int i = 0; i < 3; ++i) theirs.position[i] = static_cast<float>(unit_ * bone_[i] * place[i]);
  write_rotation(mirrored(rotation), theirs.rotation);
  return theirs;
}

Quaternion Axes::mirrored(const Quaternion& q) const {
  return {q.w(), turn_[0] * q.x(), turn_[1] * q.y(), turn_[2] * q.z()};
}

}  // namespace fragmotion
