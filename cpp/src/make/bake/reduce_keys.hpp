// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bake/fit_keys.hpp"
#include "base/progress.hpp"
#include "io/rig.hpp"

namespace fragmotion {

/// A keyed property of one of the armature's bones, or of its object, on every frame.
struct Track {
  static constexpr int kObject = -1;

  int owner = kObject;         ///< The armature's bone, or kObject.
  std::string mode;            ///< LOCATION, or the rotation's: QUATERNION, AXIS_ANGLE, XYZ, XZY ...
  std::vector<double> values;  ///< [frames, width()] in the mode's terms; the armature's units or radians

  int width() const { return mode == "QUATERNION" || mode == "AXIS_ANGLE" ? 4 : 3; }
};

/// What the tracks were made of: the channels of all bones, and the object's own where it moves.
struct ArmatureMotion {
  Channels bones;
  std::vector<double> object_locations;  ///< [frames, 3], or empty where the object stands still
  std::vector<double> object_rotations;  ///< [frames, 4], likewise
};

/// What stands above the object's own location and rotation [4, 4], row-major, and its scale.
struct ObjectPlace {
  std::vector<double> above;
  Vector3 scale = Vector3::Ones();
};

/// How far a bone is at most from its place in the world, m, and from its direction, rad.
struct Deviation {
  double distance = 0;
  double angle = 0;
};

/// Keys of each track, in their order, and how far they bring a bone off.
struct ReducedKeys {
  std::vector<FittedKeys> tracks;  ///< A track that needs them all has no slopes.
  Deviation deviation;
};

/// So few keys (fit_keys) that on no frame a bone is further than `bound` from where it was. A bone's error adds to
/// those of the bones above it, so the tolerance that all tracks share is found by trial. Throws std::invalid_argument
/// on sizes that do not fit, on owners and modes that do not exist, on a bound that is not positive, and as Rig::clip
/// does.
ReducedKeys reduce_keys(const Rig& rig, const std::vector<Track>& tracks, const ArmatureMotion& motion,
                        const ObjectPlace& place, const Deviation& bound, const Progress& progress = {});

}  // namespace fragmotion
