// SPDX-License-Identifier: MIT
#pragma once

#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// Of a leg's length: how far hips are from the ankle of a foot that stands at most.
constexpr double kHipsReach = 0.985;
/// s in which a leg that lands comes to bear the body, and in which hips get as low as it needs: a tenth of a walk's
/// cycle or less (J. Perry, "Gait Analysis", 1992: loading response).
constexpr double kLoading = 0.08;
/// rad by which a heel rises at most.
constexpr double kHighestHeel = 0.6;

/// How much of what is `over` 0 is taken away: softly up to `soft`, and all but half of that from there on.
double softly_over(double over, double soft);

/// How much higher the upper end of a leg of this length is than it reaches its ankle from, m; less than 0 where it
/// might be higher. One further aside than the leg is long is reached from no height: that of the ankle counts.
double too_high(double length, const Vector3& hip, const Vector3& ankle);

/// How a foot is turned whose heel rises by an angle about the ball, its ankle now `from_ball`.
Quaternion heel_turn(double angle, const Vector3& from_ball);

/// The least angle, rad, by which a heel must rise about the ball for its ankle, now `from_ball`, to come within
/// `length` of a hip that is `hip` from the ball; 0 where that brings it no nearer.
double rise_to_reach(const Vector3& hip, const Vector3& from_ball, double length);

/// rad that a hip turns a leg inward, and about as far outward: 33 degrees (A. Roaas and G. Andersson, "Normal range of
/// motion of the hip, knee and ankle joints in male subjects", Acta Orthopaedica Scandinavica 53, 1982).
constexpr double kTurnsInHip = 33 * kPi / 180;

/// Turns a leg in its hip about the vertical, by twice this; of its `bones` those above the thigh stay.
void turn_leg(const Leg& leg, const std::vector<int>& bones, const PlaneTurn& half, PosedBones& posed);

/// Turns a foot in the world, and its toe by `toe` alone: the foot's rotation in `posed`, which reach() keeps, and the
/// toe's in the local `rotations` [bones, 4].
void turn_foot(const Skeleton& skeleton, const Leg& leg, const Quaternion& foot, const Quaternion& toe,
               PosedBones& posed, double* rotations);

/// Lowers the hips, and all that hangs from them.
void lower_hips(double by, Vector3& root, PosedBones& posed);

}  // namespace fragmotion
