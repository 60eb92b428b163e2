// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// How far to the left, rad, the hips of takes are turned from where their body faces, as those of one that aims with a
/// rifle are, bladed to its target; 0 where the hips face as the body does. Rig and takes tell it together: in every
/// take that goes anywhere, straight ahead or aside, the hips are turned from where the rig faces at rest by nearer an
/// eighth of a turn than none or a quarter, all to the same side; the head looks nearer to there than to where the hips
/// face; and one take at least goes there.
double bladed_stance(const Kinematics& kinematics, const std::vector<Clip>& clips);

/// How far to the left, rad, each take faces from where its hips do, of those that are Clip::led and do not turn. The
/// body of a game is turned by what plays its clips, so that all face the same and go straight ahead, back or aside
/// from there, and hips that turn to where a sidestep goes do not face there. All 0 where the takes all go one way, or
/// so more nearly as their hips see it.
std::vector<double> take_told_turns(const Kinematics& kinematics, const std::vector<Clip>& takes);

/// The takes, facing as their body does: their headings, those of their hips, turned as is told, or else without the
/// turn of a bladed stance, the same in all of them.
void face_ahead(const Kinematics& kinematics, const std::vector<double>& told, std::vector<Clip>& clips);

}  // namespace fragmotion
