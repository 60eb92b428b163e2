// SPDX-License-Identifier: MIT
#pragma once

#include "io/rigid_matrix.hpp"

namespace fragmotion {

/// How bones go in each other's frames in poses [frames, bones, 4, 4] of an armature (row-major, in its space), which
/// must outlive it.
class Straying {
 public:
  Straying(const double* poses, int frames, int bones) : poses_(poses), frames_(frames), bones_(bones) {}

  /// How far the head of a bone goes from frame to frame as another bone sees it, summed; -1: as the armature does.
  double of(int bone, int from) const;

  /// The diagonal of the box that holds it.
  double span(int bone, int from) const;

  /// How far it is from another bone's head, summed over the frames.
  double apart(int bone, int other) const;

 private:
  Vector3 head(int frame, int bone) const { return pose(frame, bone).topRightCorner<3, 1>(); }
  Vector3 seen(int frame, int bone, int from) const;
  RowMajor pose(int frame, int bone) const {
    return RowMajor(poses_ + 16 * (static_cast<std::size_t>(frame) * bones_ + bone));
  }

  const double* poses_;
  int frames_, bones_;
};

}  // namespace fragmotion
