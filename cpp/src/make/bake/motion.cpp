// SPDX-License-Identifier: MIT
#include "bake/motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/ranges.hpp"
#include "base/rounding.hpp"

namespace fragmotion {
namespace {

bool are_rotations(const std::vector<double>& rotations) {
  for (std::size_t i = 0; i < rotations.size(); i += 4) {
    if (!(std::abs(load_quaternion(&rotations[i]).norm() - 1) <= kFileRounding)) return false;
  }
  return true;
}

}  // namespace

void check_motion(const Skeleton& skeleton, const Motion& motion, const char* name) {
  const auto fail = [&](const char* what) { throw std::invalid_argument(std::string(name) + " " + what); };
  const auto frames = static_cast<std::size_t>(motion.frames());
  if (frames < 1) fail("has no frame");
  if (!(motion.rate > 0 && motion.rate <= 1000)) fail("needs a frame rate over 0 and at most 1000");
  if (motion.root_positions.size() != 3 * frames || motion.path.size() != 3 * frames ||
      motion.rotations.size() != 4 * frames * skeleton.size()) {
    fail("has not a place, a character frame and a rotation of every bone for each frame");
  }
  const auto is_near = [](double value) { return std::abs(value) <= kFarthestPlace; };
  for (const auto* values : {&motion.root_positions, &motion.path, &motion.rotations}) {
    if (!std::all_of(values->begin(), values->end(), is_near)) fail("holds what is not a number or too far away");
  }
  if (!are_rotations(motion.rotations)) fail("holds a quaternion that is no rotation");
}

WorldPose pose_at(const Motion& motion, int at) {
  const std::size_t width = motion.rotations.size() / motion.frames();
  const auto first = motion.rotations.begin() + static_cast<std::ptrdiff_t>(width * at);
  return {load_vector(&motion.root_positions[std::size_t{3} * at]),
          motion.path[std::size_t{3} * at + 2],
          {first, first + static_cast<std::ptrdiff_t>(width)}};
}

void set_pose(Motion& motion, int at, const WorldPose& pose, const Vector2& place) {
  store_vector(pose.root, &motion.root_positions[std::size_t{3} * at]);
  std::copy(pose.rotations.begin(), pose.rotations.end(),
            motion.rotations.begin() + static_cast<std::ptrdiff_t>(pose.rotations.size() * at));
  store_vector({place.x(), place.y(), pose.heading}, &motion.path[std::size_t{3} * at]);
}

Vector2 carried(const CharacterFrame& from, const CharacterFrame& to, const Vector2& place) {
  return to.position + Eigen::Rotation2Dd(to.heading - from.heading) * (place - from.position);
}

void carry(int hips, const CharacterFrame& from, const CharacterFrame& to, WorldPose& pose) {
  const double turn = to.heading - from.heading;
  pose.root.head<2>() = carried(from, to, pose.root.head<2>());
  pose.heading += turn;
  double* rotation = &pose.rotations[std::size_t{4} * hips];
  store_quaternion(Quaternion(Eigen::AngleAxisd(turn, Vector3::UnitZ())) * load_quaternion(rotation), rotation);
}

Motion carried(const Motion& motion, int hips, const std::vector<double>& path) {
  Motion result = motion;
  for (int f = 0; f < motion.frames(); ++f) {
    const double* at = &path[std::size_t{3} * f];
    const CharacterFrame to{{at[0], at[1]}, at[2]};
    WorldPose pose = pose_at(motion, f);
    carry(hips, motion.frame(f), to, pose);
    set_pose(result, f, pose, to.position);
  }
  result.path = path;
  return result;
}

}  // namespace fragmotion
