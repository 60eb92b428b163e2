// SPDX-License-Identifier: MIT
#include "skeleton/other_feet.hpp"

#include <algorithm>
#include <limits>

#include "skeleton/body_shape.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

double highest_end(const BodyShape& shape, const LimbPair& pair) {
  return std::max(shape.rest()[pair.chains[0].back()].z(), shape.rest()[pair.chains[1].back()].z());
}

// A rest pose in which all bones lie along one axis, as that of many labs' BVH files, has hands on the ground.
bool ends_in_a_foot_or_hand(const Skeleton& skeleton, const Chain& chain) {
  std::vector<int> ends = {skeleton.roles.left_hand, skeleton.roles.right_hand};
  for (const LegRoles& leg : legs_with_feet(skeleton.roles)) ends.push_back(leg.foot);
  return std::any_of(ends.begin(), ends.end(),
                     [&](int end) { return std::find(chain.begin(), chain.end(), end) != chain.end(); });
}

}  // namespace

std::vector<int> other_feet(const Skeleton& skeleton) {
  const BodyTree tree(skeleton);
  const BodyShape shape(skeleton, tree, nullptr);
  const std::vector<LimbPair> pairs = find_limb_pairs(shape);
  double ground = std::numeric_limits<double>::infinity();
  for (const LimbPair& pair : pairs) ground = std::min(ground, highest_end(shape, pair));
  std::vector<int> feet;
  for (const LimbPair& pair : pairs) {
    if (highest_end(shape, pair) - ground > kStands * pair.length) continue;
    for (const Chain& chain : pair.chains) {
      if (!ends_in_a_foot_or_hand(skeleton, chain)) feet.push_back(chain.back());
    }
  }
  return feet;
}

}  // namespace fragmotion
