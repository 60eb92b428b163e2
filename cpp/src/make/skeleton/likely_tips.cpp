// SPDX-License-Identifier: MIT
#include "skeleton/likely_tips.hpp"

#include <algorithm>
#include <utility>

namespace fragmotion {
namespace {

constexpr double kFoot = 0.33, kLongFoot = 0.6;  // of a shin's length, from the ankle to the ball: usual, and unlikely

struct RestBones {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;

  explicit RestBones(const Skeleton& skeleton) { rest_pose(skeleton, heads, rotations); }

  bool leads_on(const Vector3& tip, int before, int bone) const {
    const Vector3 way = heads[bone] - heads[before];
    return (rotations[bone] * tip).dot(way) >= kSameWay * tip.norm() * way.norm();
  }

  // In the frame of the bone.
  Vector3 straight_on(int before, int bone, double length) const {
    return rotations[bone].conjugate() * ((heads[bone] - heads[before]).normalized() * length);
  }
};

bool is_thumb(const RoleMap& map, int bone) {
  return std::any_of(map.bones.begin(), map.bones.end(), [&](const RoleBone& told) {
    return told.bone == bone && told.role == Role::kFinger && told.finger == 0;
  });
}

// The mean of where the bones begin that hang on a hand, seen from it; zero where there are none.
Vector3 palm(const Skeleton& skeleton, const RoleMap& map, int hand) {
  Vector3 sum = Vector3::Zero();
  int bones = 0;
  for (int b = hand + 1; b < skeleton.size(); ++b) {
    if (skeleton.parents[b] == hand && !is_thumb(map, b)) sum += skeleton.offsets[b], ++bones;
  }
  return bones > 0 ? Vector3{sum / bones} : sum;
}

}  // namespace

bool leads_on(const Skeleton& skeleton, int before, int bone) {
  return RestBones(skeleton).leads_on(skeleton.tips[bone], before, bone);
}

Skeleton with_likely_tips(Skeleton skeleton, const RoleMap& map, const Skin* skin) {
  const RestBones rest(skeleton);
  const auto straighten = [&](int before, int bone) {
    Vector3& tip = skeleton.tips[bone];
    if (before >= 0 && !rest.leads_on(tip, before, bone)) tip = rest.straight_on(before, bone, tip.norm());
  };
  for (const RoleBone& bone : map.bones) {
    if (bone.role == Role::kHand) {
      const Vector3 knuckles = palm(skeleton, map, bone.bone);
      const Vector3 hand = skin && knuckles.squaredNorm() == 0 ? way_of_skin(skeleton, *skin, bone.bone) : knuckles;
      if (hand.squaredNorm() > 0) skeleton.tips[bone.bone] = hand;
      if (knuckles.squaredNorm() > 0 || hand.squaredNorm() == 0)
        straighten(map.bone(Role::kLowerArm, bone.side), bone.bone);
    } else if (bone.role == Role::kFinger && bone.order > 0) {
      straighten(skeleton.parents[bone.bone], bone.bone);
    }
  }
  return skeleton;
}

Skeleton with_short_feet(Skeleton skeleton, const Leg& left, const Leg& right) {
  const RestBones rest(skeleton);
  const Vector3 across = rest.heads[left.thigh] - rest.heads[right.thigh];
  for (const Leg& leg : {left, right}) {
    if (leg.toe >= 0 || !leg.has_foot()) continue;
    const Vector3 up = rest.heads[leg.knee] - rest.heads[leg.foot], ahead = across.cross(up).normalized();
    Vector3& tip = skeleton.tips[leg.foot];
    if ((rest.rotations[leg.foot] * tip).dot(up) > kSameWay * tip.norm() * up.norm())
      tip = rest.rotations[leg.foot].conjugate() * ahead * kFoot * up.norm();
    else if (tip.norm() > kLongFoot * up.norm())
      tip *= kFoot * up.norm() / tip.norm();
  }
  return skeleton;
}

Skeleton with_short_feet(Skeleton skeleton) {
  const Legs legs = resting_legs(skeleton);
  for (int pair = 0; pair < legs.count(); pair += 2)
    skeleton = with_short_feet(std::move(skeleton), legs[pair], legs[pair + 1]);
  return skeleton;
}

}  // namespace fragmotion
