// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motion/marker.hpp"
#include "motion/take.hpp"
#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// Frames a second that a clip may have: motion capture is made at up to some 2,000.
constexpr double kLowestRate = 0.1, kHighestRate = 10000;

/// One take on a skeleton at a fixed rate. Only the hips translate; the bones above them follow the character frame.
struct Clip {
  std::string name;
  double rate = 0;  ///< Frames a second.
  int frames = 0;
  std::vector<double> root_positions;  ///< [frames, 3] m: the hips' head in the world, z up
  std::vector<double> rotations;       ///< [frames, bones, 4]: the hips' in the world, every other bone's in its parent
  std::vector<double> headings;        ///< [frames] rad, unwrapped: where the character faces; see facing.hpp
  std::vector<Marker> markers = {};    ///< By their frames.
  bool led = false;                    ///< Was shown on the spot; its way is what its feet told.
};

/// Checks shapes, finite numbers, rate, the hips' places and at least two frames, and makes the quaternions unit,
/// successive ones on the same side. The rotations of bones outside the tree of the hips become their rest rotations,
/// whatever they were. Throws std::invalid_argument naming the clip, frame (from 0) and bone, or the marker.
Clip make_clip(const Skeleton& skeleton, Clip clip);

/// The take's motion on `skeleton`, bones matched by name. What bones other than the hips move away from their offsets
/// is dropped; the bones above the hips go into the hips' motion. Below the hips the bones must have the same parents
/// and rest rotations as in the take. Throws std::invalid_argument naming the bone that is missing or differs.
Clip clip_from_take(const Skeleton& skeleton, const Take& take);

/// The clip's motion as a take: the inverse of clip_from_take on its own skeleton. Bones above the hips rest. Throws
/// std::invalid_argument unless the clip has the skeleton's bones.
Take take_from_clip(const Skeleton& skeleton, const Clip& clip);

/// Kinematics::world of frame `frame` of a clip, of all bones or those of `bones`.
inline void world(const Kinematics& kinematics, const Clip& clip, int frame, Vector3* heads, Quaternion* orientations) {
  kinematics.world(load_vector(&clip.root_positions[std::size_t{3} * frame]),
                   &clip.rotations[std::size_t{4} * kinematics.bones() * frame], heads, orientations);
}
inline void world(const Kinematics& kinematics, const Clip& clip, int frame, const std::vector<int>& bones,
                  Vector3* heads, Quaternion* orientations) {
  kinematics.world(load_vector(&clip.root_positions[std::size_t{3} * frame]),
                   &clip.rotations[std::size_t{4} * kinematics.bones() * frame], bones, heads, orientations);
}

/// Frames begin .. end of a clip, as a clip of their own.
Clip part(const Clip& clip, int begin, int end);

}  // namespace fragmotion
