// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

namespace fragmotion {

/// Of a rig that was exported whole, whose mesh follows bones that hang on controls (Auto-Rig Pro's): on which other of
/// the `bearing` bones, which carry the mesh, each of them hangs whose parent is none; all but one do. It is told by
/// the motion alone: a joint stays in its place in the frame of the bone that it hangs on, and of bones that go
/// together it is the nearest; twist bones, by their names, carry no other. `parents` [bones], `poses` [frames, bones,
/// 4, 4] (row-major, in the armature's space).
std::map<int, int> find_joints(const std::vector<std::string>& names, const std::vector<int>& parents,
                               const double* poses, int frames, const std::vector<int>& bearing);

}  // namespace fragmotion
