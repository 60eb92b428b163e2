// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

namespace fragmotion {

/// Bones that carry keys outside the chain of their parents, as feet that are the targets of a leg's IK: on which bone
/// each of `candidates` hangs, where it does. `parents` [bones], `poses` [frames, bones, 4, 4] (row-major, in the
/// armature's space). A bone hangs on the one, of those that it does not move, in whose frame its head goes least from
/// frame to frame, where that is a third at most of what it goes in its parent's: where the leg's IK does not reach, it
/// is off its place, but stays there. Two that are each other's left and right by their names hang alike.
std::map<int, int> find_hanging(const std::vector<std::string>& names, const std::vector<int>& parents,
                                const double* poses, int frames, const std::vector<int>& candidates);

/// How far the head of a bone goes to and fro as another bone sees it: the diagonal of the box that holds it in all
/// poses [frames, bones, 4, 4], in the armature's units.
double span_beside(const double* poses, int frames, int bones, int bone, int other);

/// The bones, in their order but each after its parent and the one that it hangs on; without those that hang on a bone
/// that they move.
std::vector<int> ordered_bones(const std::vector<int>& parents, const std::vector<int>& hangs);

}  // namespace fragmotion
