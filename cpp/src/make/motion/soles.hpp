// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/clip.hpp"

namespace fragmotion {

/// m of a character of 1.8 m over the ground that joints of feet are at most which stand on it; the lowest of them are
/// in the feet, and not every file has the toes' ends.
constexpr double kFootHeight = 0.08;
/// Whether feet whose lowest joint is so high stand on the ground, as nearly as files tell.
inline bool is_on_ground(double height) { return height >= -kFootHeight / 4 && height <= kFootHeight; }

/// m of a character of 1.8 m over its lowest that any point of a sole is which is flat on the ground.
constexpr double kFlatSole = 0.02;

/// One point of a sole: its path, and the height over which it is all but 2 % of the time.
struct SolePoint {
  std::vector<Vector3> path;
  double lowest = 0;
};

/// A foot's sole under its heel, ball and the toe's end, where the foot has these; of a leg without a foot its end
/// alone.
struct SolePath {
  std::vector<Vector3> ankle;  ///< Of its foremost joint, or of the end of a leg without a foot.
  std::vector<SolePoint> points;

  const SolePoint& heel() const { return points[0]; }
  const SolePoint& ball() const { return points[points.size() > 1]; }
};

/// The soles of the feet, of a skeleton that has them: what is under the feet's joints, on the
/// ground, when each foot stands flattest. The ground is at height 0, or, where that is not under the joints or more
/// than 10 cm (of a character of 1.8 m), as high as the lowest of them.
std::vector<SolePath> find_soles(const Kinematics& kinematics, const Clip& clip);

}  // namespace fragmotion
