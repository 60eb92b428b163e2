// SPDX-License-Identifier: MIT
#pragma once

#include "ground/feet_ahead.hpp"
#include "runtime/playback.hpp"
#include "runtime/pose_correction.hpp"

namespace fragmotion {

/// What the feet of the body that Workspace::shown shows do next, if what plays goes on to where they stand, and in its
/// take where it ends before. Uses Workspace::poses.
FeetAhead look_ahead(const Playback& playback, const RootGovernor& governor, const PoseCorrection& correction,
                     Workspace& workspace);

}  // namespace fragmotion
