// SPDX-License-Identifier: MIT
#include "doctor/basis.hpp"

#include <algorithm>

#include "skeleton/role_map.hpp"

namespace fragmotion {
namespace {

Vector3 middle_of_feet(const Patient& patient, int frame) {
  return 0.5 * (patient.head(frame, patient.legs[0].end) + patient.head(frame, patient.legs[1].end));
}

// From the feet to the head, or on four legs to where they begin: head and tail may be held anywhere.
Vector3 from_the_feet(const Patient& patient, int frame) {
  if (!patient.is_four_legged()) return patient.head(frame, patient.skull) - middle_of_feet(patient, frame);
  Vector3 up = Vector3::Zero();
  for (const Limb3& leg : patient.legs) up += patient.head(frame, leg.top) - patient.head(frame, leg.end);
  return up;
}

Vector3 across(const Patient& patient, int frame, const Vector3& up) {
  const Vector3 right = patient.head(frame, patient.legs[1].top) - patient.head(frame, patient.legs[0].top);
  return right - right.dot(up) * up;
}

/// Whether it goes along `up` from one bone to the other.
bool points(const Patient& resting, int from, int to, const Vector3& up) {
  if (from < 0 || to < 0) return false;
  const Vector3 way = resting.head(0, to) - resting.head(0, from);
  return way.dot(up) > kNearAxis * way.norm();
}

}  // namespace

Vector3 nearest_axis(const Vector3& direction) {
  int axis = 0;
  const double most = direction.cwiseAbs().maxCoeff(&axis);
  Vector3 result = Vector3::Zero();
  if (most > kNearAxis * direction.norm()) result[axis] = direction[axis] > 0 ? 1 : -1;
  return result;
}

std::string axis_name(const Vector3& axis) {
  for (int i = 0; i < 3; ++i) {
    if (axis[i] != 0) return std::string(axis[i] > 0 ? "+" : "-") + "XYZ"[i];
  }
  return "";
}

Vector3 up_axis(const Patient& patient) {
  if (!patient.has_legs() || (patient.skull < 0 && !patient.is_four_legged())) return Vector3::Zero();
  Vector3 sum = Vector3::Zero();
  const int apart = frames_between_looks(patient.frames());
  int poses = 0;
  for (int f = 0; f < patient.frames(); f += apart, ++poses) {
    const Vector3 up = from_the_feet(patient, f);
    if (up.norm() > 0) sum += up.normalized();
  }
  return sum.norm() > kNearAxis * poses ? nearest_axis(sum) : Vector3::Zero();
}

Vector3 standing_axis(const Patient& resting) {
  const Vector3 up = up_axis(resting);
  if (up.isZero(0) || !points(resting, resting.hips, resting.skull, up)) return Vector3::Zero();
  for (const Limb3& leg : resting.legs) {
    if (!points(resting, leg.end, leg.top, up)) return Vector3::Zero();
  }
  return up;
}

Vector3 front_axis(const Patient& resting) {
  const Vector3 up = standing_axis(resting);
  if (up.isZero(0)) return Vector3::Zero();
  const Vector3 feet = resting.toe_direction(0, 0) + resting.toe_direction(0, 1), ahead = feet - feet.dot(up) * up;
  const bool point = ahead.norm() > 0.02 * resting.stature();
  return nearest_axis(point ? ahead : Vector3{up.cross(across(resting, 0, up))});
}

}  // namespace fragmotion
