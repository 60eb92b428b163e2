// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "retarget/body.hpp"

namespace fragmotion {

/// What a viewer may find fault with.
struct RetargetRemark {
  std::string code;  ///< "foot_skate", "contact", "hips" or "limb".
  bool is_error = false;
  std::string text;
};

/// What came of a clip on another body, beside the clip itself.
struct RetargetReport {
  double foot_skate = 0;         ///< Mean horizontal speed of balls and heels, the more weighted the lower, m/s.
  double source_foot_skate = 0;  ///< The same of the source, in lengths of the target.
  double foot_skate_ratio = 0;   ///< The one over the other, of which each is counted 1 mm/s more.
  double contact_error = 0;      ///< Greatest height of a standing foot over or under where the source has it, m.
  double knee_beyond = 0;        ///< How far a knee bends less or more than it ever does in the source, rad.
  double hips_moved = 0;         ///< How far at most the hips are lowered or raised for the legs to reach, m.
  std::map<std::string, double> limb_angles;  ///< See limb_angles().
  std::vector<RetargetRemark> remarks;
};

struct RetargetedClip {
  Clip clip;
  RetargetReport report;
};

/// Brings clips of one body onto another. Bones are turned away from the compared pose as in the source; along spine,
/// neck and fingers of other counts the turn is spread. Lengths are scaled by the legs. Feet go where the source's do,
/// as far apart as the hips are, and stand as long and as still; the knees bend in the plane and range of the source.
/// Bones without a role rest on their parents; twist bones have their share.
class Retarget {
 public:
  /// Throws std::invalid_argument where neither rest pose nor clips tell how a body stands, unless both are the same
  /// body but for names, scale and the bones' frames.
  Retarget(const Body& source, const Body& target);
  ~Retarget();
  Retarget(Retarget&&) noexcept;
  Retarget& operator=(Retarget&&) noexcept;

  struct Parts;  ///< What does not change from clip to clip.

  /// Metres of the target for a metre of the source.
  double scale() const;

  /// A clip of the source's skeleton on the target's, by the same name. Throws std::invalid_argument where the clip
  /// has another number of bones.
  RetargetedClip apply(const Clip& clip) const;

  /// apply() of each clip, on `threads` threads (0: as many as the machine has).
  std::vector<RetargetedClip> apply(const std::vector<Clip>& clips, int threads = 0) const;

 private:
  std::unique_ptr<const Parts> parts_;
};

}  // namespace fragmotion
