// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace fragmotion {

/// An armature as an animation package stores it (Blender's conventions). Matrices are row-major.
struct Armature {
  std::vector<std::string> names;
  std::vector<int> parents;            ///< Parents before children; -1 where a bone has none, which several may.
  std::vector<double> rest;            ///< [bones, 4, 4]: rest matrices in the armature's space, y along the bone
  std::vector<double> lengths;         ///< [bones]: along y, in the armature's units; far too long: shortened
  std::vector<double> world;           ///< [4, 4]: the object's matrix; its scale makes metres of the armature's units
  std::vector<bool> inherit_rotation;  ///< [bones], or empty: all true
  std::vector<bool> local_location;    ///< [bones], or empty: all true
  std::map<std::string, std::string> roles;  ///< Role ("hips", "left_foot" ...) -> bone, over what the names tell
  /// Bone -> the bone that it moves with, though it is the child of another: a foot that is the target of a leg's IK.
  std::map<std::string, std::string> hangs = {};
  /// Bone -> the location (x, y, z) and rotation (w, x, y, z) that it is held at, as in Channels.
  std::map<std::string, std::array<double, 7>> held = {};
  /// Bone -> how many times as large as it rests it is posed, with all its descendants.
  std::map<std::string, double> sizes = {};
};

/// With the flags that it has not, and without lengths that are far too long. Throws std::invalid_argument on wrong
/// sizes or order, and on roles or bones that do not exist.
Armature checked_armature(Armature armature);

/// How a bone is called in errors.
std::string bone_label(const Armature& armature, int bone);

/// On which bone each hangs: its parent, where nothing else is said.
std::vector<int> hanging(const Armature& armature);

/// All bones, each after its parent and the one that it hangs on. Throws std::invalid_argument on one that hangs on a
/// bone that it moves.
std::vector<int> checked_order(const Armature& armature, const std::vector<int>& hangs);

}  // namespace fragmotion
