// SPDX-License-Identifier: MIT
#include "api/shift.hpp"

namespace fragmotion {

Vector3 Shift::place(const Vector3& inside) const {
  if (none) return inside;
  const Vector2 turned = turn_by(heading) * Vector2{inside.head<2>()} + offset;
  return {turned.x(), turned.y(), inside.z() + lift};
}

Vector3 Shift::direction(const Vector3& inside) const {
  if (none) return inside;
  const Vector2 turned = turn_by(heading) * Vector2{inside.head<2>()};
  return {turned.x(), turned.y(), inside.z()};
}

Vector3 Shift::place_inside(const Vector3& outside) const {
  if (none) return outside;
  const Vector2 turned = turn_by(-heading) * Vector2{outside.head<2>() - offset};
  return {turned.x(), turned.y(), outside.z() - lift};
}

Vector3 Shift::direction_inside(const Vector3& outside) const {
  if (none) return outside;
  const Vector2 turned = turn_by(-heading) * Vector2{outside.head<2>()};
  return {turned.x(), turned.y(), outside.z()};
}

CharacterFrame Shift::frame(const CharacterFrame& inside) const {
  if (none) return inside;
  return {turn_by(heading) * inside.position + offset, inside.heading + heading};
}

}  // namespace fragmotion
