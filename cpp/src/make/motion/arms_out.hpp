// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// arms_out() of arms that are held out as in a T pose: within 37 degrees of it.
constexpr double kArmsOut = 0.8;

/// Of arms on their way there or back.
constexpr double kArmsHalfOut = kArmsOut / 2;

/// How far out to the sides two arms point, the one that does so less: 1 straight out, 0 down, ahead or up. Of the
/// heads of upper arms and hands, left and right, in one frame.
inline double arms_out(const Vector3& left_arm, const Vector3& left_hand, const Vector3& right_arm,
                       const Vector3& right_hand) {
  const Vector3 right = (right_arm - left_arm).normalized();
  return std::min((left_hand - left_arm).normalized().dot(-right), (right_hand - right_arm).normalized().dot(right));
}

}  // namespace fragmotion
