// SPDX-License-Identifier: MIT
#pragma once

namespace fragmotion {

/// Frames a second of games and of what is measured of them,
constexpr double kGameRate = 60;
/// and s from one to the next.
constexpr double kGameStep = 1 / kGameRate;

/// Poses a second that tell how fast a body moves: noise of keys and markers tells more of what is between closer ones.
constexpr double kPoseRate = 30;

/// Poses a second that tell which there are: joints are near each for longer than from one to the next.
constexpr double kPostureRate = 10;

}  // namespace fragmotion
