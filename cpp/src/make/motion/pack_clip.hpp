// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "motion/mirror.hpp"
#include "motion/packed_clip.hpp"

namespace fragmotion {

/// The grid for these clips' poses, and for their images where `turns` says how those follow.
PoseGrid pose_grid(const Skeleton& skeleton, const std::vector<Clip>& clips, const MirrorTurns& turns = {});

/// Keeps a clip: bones' ends within 0.1 mm, and rotations in the parent and in the world within 0.1 degrees, of a
/// character of 1.8 m. Each bone's turn makes good what the bones above it leave, so that errors do not add up.
PackedClip pack(const Skeleton& skeleton, std::shared_ptr<const PoseGrid> grid, const Clip& clip);

}  // namespace fragmotion
