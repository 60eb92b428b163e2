// SPDX-License-Identifier: MIT
#include "base/turn_between.hpp"

#include <cmath>

#include "base/rounding.hpp"

namespace fragmotion {

Quaternion turn_between(const Vector3& from, const Vector3& to) {
  const double product = std::sqrt(from.squaredNorm() * to.squaredNorm()), w = product + dot(from, to);
  if (!(product > 0)) return Quaternion::Identity();
  if (std::isinf(product)) return turn_between(from / from.cwiseAbs().maxCoeff(), to / to.cwiseAbs().maxCoeff());
  if (w <= kFloatRounding * product) {
    const Vector3 across = from.unitOrthogonal();
    return turn_between(-from, to) * Quaternion{0, across.x(), across.y(), across.z()};
  }
  const Vector3 axis = from.cross(to);
  return Quaternion{w, axis.x(), axis.y(), axis.z()}.normalized();
}

}  // namespace fragmotion
