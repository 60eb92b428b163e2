// SPDX-License-Identifier: MIT
#include "skeleton/skeleton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <unordered_set>

#include "base/rounding.hpp"
#include "base/take_limits.hpp"
#include "skeleton/role_names.hpp"

namespace fragmotion {
namespace {

void check_sizes(const Skeleton& skeleton) {
  const std::size_t bones = skeleton.names.size();
  if (bones == 0) throw std::invalid_argument("a skeleton needs at least one bone");
  if (bones > kMostBones) {
    throw std::invalid_argument("a skeleton of " + std::to_string(bones) + " bones: at most " +
                                std::to_string(kMostBones) + " are allowed");
  }
  const std::array sizes = {skeleton.parents.size(), skeleton.rest_rotations.size(), skeleton.offsets.size(),
                            skeleton.tips.size()};
  const std::array fields = {"parents", "rest rotations", "offsets", "tips"};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] != bones) {
      throw std::invalid_argument("skeleton of " + std::to_string(bones) + " bones (first '" + skeleton.names[0] +
                                  "') has " + std::to_string(sizes[i]) + " " + fields[i]);
    }
  }
}

void check_name(const Skeleton& skeleton, int bone) {
  const std::string& name = skeleton.names[bone];
  if (name.size() <= kLongestName) return;
  throw std::invalid_argument("bone '" + name.substr(0, 30) + "...' has a name of " + std::to_string(name.size()) +
                              " bytes: at most " + std::to_string(kLongestName) + " are allowed");
}

void check_parent(const Skeleton& skeleton, int bone) {
  const int parent = skeleton.parents[bone];
  const std::string label = "bone '" + skeleton.names[bone] + "'";
  if (bone == 0 && parent != -1) throw std::invalid_argument(label + " is the first and must have no parent (-1)");
  if (bone > 0 && parent == -1)
    throw std::invalid_argument(label + " has no parent: only the first bone may have none");
  if (parent < -1 || parent >= bone) {
    throw std::invalid_argument(label + " has parent " + std::to_string(parent) +
                                ": parents must come before children");
  }
}

void check_numbers(const Skeleton& skeleton, int bone) {
  const std::string label = "bone '" + skeleton.names[bone] + "'";
  const auto check = [&](const Vector3& place, const char* what) {
    if (!place.allFinite()) throw std::invalid_argument(label + " has " + what + " that is not finite");
    if (place.cwiseAbs().maxCoeff() > kFarthestBody)
      throw std::invalid_argument(label + " has " + what + " of more than 1000 km");
  };
  check(skeleton.offsets[bone], "an offset");
  check(skeleton.tips[bone], "a tip");
  const double norm = skeleton.rest_rotations[bone].norm();
  if (!(std::abs(norm - 1) < kFileRounding)) {
    throw std::invalid_argument(label + " has a rest rotation that is not a unit quaternion");
  }
}

void check_roles(const Skeleton& skeleton) {
  for (const auto& [name, member] : role_names()) {
    const int bone = skeleton.roles.*member;
    if (bone < -1 || bone >= skeleton.size()) {
      throw std::invalid_argument("skeleton with first bone '" + skeleton.names[0] + "' has a role for bone " +
                                  std::to_string(bone) + " of " + std::to_string(skeleton.size()));
    }
  }
}

}  // namespace

std::array<LegRoles, kMostLegs> leg_roles(const Roles& r) {
  return {{{r.left_thigh, r.left_foot, r.left_toe},
           {r.right_thigh, r.right_foot, r.right_toe},
           {r.left_fore_leg, r.left_fore_foot, r.left_fore_toe},
           {r.right_fore_leg, r.right_fore_foot, r.right_fore_toe}}};
}

std::vector<LegRoles> legs_with_feet(const Roles& roles) {
  std::vector<LegRoles> legs;
  const std::array<LegRoles, kMostLegs> all = leg_roles(roles);
  for (int left = 0; left < kMostLegs && all[left].foot >= 0 && all[left + 1].foot >= 0; left += 2)
    legs.insert(legs.end(), {all[left], all[left + 1]});
  return legs;
}

bool has_knee(const Skeleton& skeleton, const LegRoles& leg) {
  return leg.thigh < 0 || leg.foot < 0 || (leg.foot != leg.thigh && skeleton.parents[leg.foot] != leg.thigh);
}

bool ends_without_foot(const Skeleton& skeleton, const LegRoles& leg) {
  if (has_knee(skeleton, leg) || (leg.toe >= 0 && leg.toe != leg.foot)) return false;
  Vector3 way = skeleton.tips[leg.foot];
  for (int bone = leg.foot; bone >= 0; bone = skeleton.parents[bone]) way = skeleton.rest_rotations[bone] * way;
  return leads_down(way);
}

int Skeleton::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool Skeleton::is_below(int bone, int ancestor) const {
  while (bone > ancestor) bone = parents[bone];
  return bone >= 0 && bone == ancestor;  // Nothing is below a bone that is missing (-1).
}

Skeleton checked_skeleton(Skeleton skeleton) {
  check_sizes(skeleton);
  std::unordered_set<std::string> seen;
  for (int bone = 0; bone < skeleton.size(); ++bone) {
    check_name(skeleton, bone);
    if (!seen.insert(skeleton.names[bone]).second) {
      throw std::invalid_argument("bone '" + skeleton.names[bone] + "' appears twice: names must be unique");
    }
    check_parent(skeleton, bone);
    check_numbers(skeleton, bone);
    skeleton.rest_rotations[bone].normalize();
  }
  check_roles(skeleton);
  return skeleton;
}

void rest_pose(const Skeleton& skeleton, std::vector<Vector3>& heads, std::vector<Quaternion>& rotations) {
  heads.assign(skeleton.offsets.begin(), skeleton.offsets.end());
  rotations.assign(skeleton.rest_rotations.begin(), skeleton.rest_rotations.end());
  for (int bone = 1; bone < skeleton.size(); ++bone) {
    const int parent = skeleton.parents[bone];
    heads[bone] = heads[parent] + rotations[parent] * skeleton.offsets[bone];
    rotations[bone] = (rotations[parent] * skeleton.rest_rotations[bone]).normalized();
  }
}

}  // namespace fragmotion
