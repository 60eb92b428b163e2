// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "skeleton/skeleton.hpp"

namespace fragmotion {

/// What of a mesh follows which bones of a skeleton.
struct Skin {
  struct Weight {
    int point = -1;
    int bone = -1;
    double weight = 0;  ///< 0 to 1; those of a point are 1 together.
  };

  std::vector<Vector3> points;  ///< In the world where the skeleton rests, m.
  std::vector<Weight> weights;
};

/// Which bones carry nothing of a skin, nor does any that hangs on them; none of a skin without weights.
std::vector<bool> bare_bones(const Skeleton& skeleton, const Skin& skin);

/// Where that of a skin leads from a bone's head which follows the bone more than all others together: towards its
/// mean, as far as it reaches, m, as the bone sees it. Zero where nothing does.
Vector3 way_of_skin(const Skeleton& skeleton, const Skin& skin, int bone);

}  // namespace fragmotion
