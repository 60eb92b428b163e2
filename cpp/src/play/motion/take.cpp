// SPDX-License-Identifier: MIT
#include "motion/take.hpp"

#include <cstddef>
#include <stdexcept>
#include <utility>

#include "base/ranges.hpp"

namespace fragmotion {
namespace {

constexpr double kLeastUnit = 1e-6, kMostUnit = 1e3;  // m, as of files

void check_sizes(const Take& take) {
  const std::size_t poses = static_cast<std::size_t>(take.frames) * take.skeleton.names.size();
  if (take.frames < 1) throw std::invalid_argument("take '" + take.name + "' has no frames");
  if (take.translations.size() != 3 * poses || take.rotations.size() != 4 * poses)
    throw std::invalid_argument("take '" + take.name + "' has not 3 and 4 numbers for each frame and bone");
}

}  // namespace

Take make_take(Take take) {
  check_sizes(take);
  require_range("rate", take.rate, kLowestRate, kHighestRate);
  require_range("unit", take.unit, kLeastUnit, kMostUnit);
  for (std::size_t i = 0; i < take.rotations.size(); i += 4) {
    Quaternion q = load_quaternion(&take.rotations[i]);
    q.coeffs() /= q.coeffs().stableNorm();
    store_quaternion(q, &take.rotations[i]);
  }
  return take;
}

void world_transforms(const Take& take, std::vector<double>& positions, std::vector<double>& rotations) {
  const std::size_t bones = take.skeleton.names.size();
  positions.resize(take.frames * bones * 3);
  rotations.resize(take.frames * bones * 4);
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(take.frames); ++frame) {
    const std::size_t at = frame * bones;
    world_transforms(take.skeleton, &take.translations[at * 3], &take.rotations[at * 4], &positions[at * 3],
                     &rotations[at * 4]);
  }
}

void world_transforms(const Skeleton& skeleton, const double* local_positions, const double* local_rotations,
                      double* positions, double* rotations) {
  for (std::size_t bone = 0; bone < skeleton.names.size(); ++bone) {
    Vector3 position = load_vector(local_positions + bone * 3);
    Quaternion rotation = load_quaternion(local_rotations + bone * 4);
    if (bone > 0) {
      const std::size_t parent = skeleton.parents[bone];
      const Quaternion parent_rotation = load_quaternion(rotations + parent * 4);
      position = load_vector(positions + parent * 3) + parent_rotation * position;
      // Renormalised so that long chains do not drift from unit length.
      rotation = (parent_rotation * rotation).normalized();
    }
    store_vector(position, positions + bone * 3);
    store_quaternion(rotation, rotations + bone * 4);
  }
}

}  // namespace fragmotion
