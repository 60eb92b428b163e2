// SPDX-License-Identifier: MIT
#include "skeleton/same_skeleton.hpp"

#include <algorithm>

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

bool same_tree(const Skeleton& a, const Skeleton& b) {
  return a.names == b.names && a.parents == b.parents && a.roles.hips == b.roles.hips;
}

bool same_rest(const Skeleton& a, const Skeleton& b) {
  std::vector<Vector3> heads;
  std::vector<Quaternion> of_a, of_b;
  rest_pose(a, heads, of_a);
  rest_pose(b, heads, of_b);
  for (int bone = 0; bone < a.size(); ++bone) {
    if (a.is_below(bone, a.roles.hips) && of_a[bone].angularDistance(of_b[bone]) > kFloatRounding) return false;
  }
  return true;
}

bool same_lengths(const Skeleton& a, const Skeleton& b) {
  const double most = kFileRounding * std::max(stature(a), stature(b));
  for (int bone = 0; bone < a.size(); ++bone) {
    const bool hangs = bone != a.roles.hips && a.is_below(bone, a.roles.hips);
    if (hangs && (a.offsets[bone] - b.offsets[bone]).norm() > most) return false;
  }
  return true;
}

}  // namespace

bool same_skeleton(const Skeleton& a, const Skeleton& b) {
  return same_tree(a, b) && same_rest(a, b) && same_lengths(a, b);
}

std::vector<std::vector<int>> group_skeletons(const std::vector<Skeleton>& skeletons) {
  std::vector<std::vector<int>> groups;
  for (int i = 0; i < static_cast<int>(skeletons.size()); ++i) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<int>& members) {
      return same_skeleton(skeletons[members.front()], skeletons[i]);
    });
    if (group == groups.end()) {
      groups.push_back({i});
    } else {
      group->push_back(i);
    }
  }
  return groups;
}

}  // namespace fragmotion
