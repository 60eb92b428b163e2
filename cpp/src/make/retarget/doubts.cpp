// SPDX-License-Identifier: MIT
#include "retarget/doubts.hpp"

#include <algorithm>
#include <limits>

#include "retarget/posture.hpp"
#include "skeleton/body_tree.hpp"
#include "skeleton/likely_tips.hpp"

namespace fragmotion {
namespace {

class Doubts {
 public:
  Doubts(const Skeleton& skeleton, const RoleMap& map, const Skin* skin)
      : skeleton_(skeleton), map_(map), skin_(skin), rest_(rest_posture(skeleton)) {}

  std::vector<RoleDoubt> find() {
    for (const Side side : kSides) look_at_leg(side);
    if (has_legs() && stands(map_, facing_forward())) look_at_ground();
    for (const Side side : kSides) look_at_hand(side);
    for (const RoleBone& bone : map_.bones) {
      if (bone.confidence < kByPlace && bone.role != Role::kRoot)
        add(bone.role, bone.side, bone.bone, "is told by its place alone, not by its name: see whether it is right");
    }
    return std::move(doubts_);
  }

 private:
  bool has_legs() const {
    const auto complete = [&](Side side) {
      return bone(Role::kThigh, side) >= 0 && bone(Role::kShin, side) >= 0 && bone(Role::kFoot, side) >= 0;
    };
    return bone(Role::kHips, Side::kNone) >= 0 && complete(Side::kLeft) && complete(Side::kRight);
  }

  PosedBones facing_forward() const {
    PosedBones posture = rest_;
    face_forward(map_, posture);
    return posture;
  }

  void look_at_leg(Side side) {
    const int thigh = bone(Role::kThigh, side), foot = bone(Role::kFoot, side);
    if (thigh < 0 || foot < 0 || bone(Role::kShin, side) >= 0 || map_.bone(Role::kForeFoot, side) >= 0) return;
    add(Role::kThigh, side, thigh,
        "has a joint more below it than a man's leg, so that no shin is known: motion of men cannot be brought onto "
        "it; takes of its own can be learned");
  }

  void look_at_ground() {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vector3& head : rest_.heads) lowest = std::min(lowest, head.z());
    for (const Side side : kSides) {
      const double foot = height(Role::kFoot, side), thigh = height(Role::kThigh, side);
      if (foot - lowest > (thigh - foot) / 2)
        add(Role::kFoot, side, bone(Role::kFoot, side),
            "is far over the lowest bone: the leg does not end on the ground, and may be an arm");
    }
    const double feet = (height(Role::kFoot, Side::kLeft) + height(Role::kFoot, Side::kRight)) / 2,
                 thighs = (height(Role::kThigh, Side::kLeft) + height(Role::kThigh, Side::kRight)) / 2;
    if (height(Role::kHips, Side::kNone) < (feet + thighs) / 2)
      add(Role::kHips, Side::kNone, bone(Role::kHips, Side::kNone),
          "lies between the feet, and the legs hang on it: to let the body sway about its hips, parent the thighs to "
          "the lowest bone of the spine (Edit Mode)");
  }

  void look_at_hand(Side side) {
    const int hand = bone(Role::kHand, side), arm = bone(Role::kLowerArm, side);
    if (hand < 0 || arm < 0 || leads_on(with_likely_tips(skeleton_, map_), arm, hand) == leads_on(skeleton_, arm, hand))
      return;
    if (std::find(skeleton_.parents.begin(), skeleton_.parents.end(), hand) != skeleton_.parents.end()) return;
    if (skin_ && way_of_skin(skeleton_, *skin_, hand).squaredNorm() > 0) return;
    add(Role::kHand, side, hand,
        "has no fingers and ends aside of the arm: it is taken to be straight at rest; see whether the wrist is right");
  }

  int bone(Role role, Side side) const { return map_.bone(role, side); }
  double height(Role role, Side side) const { return rest_.heads[bone(role, side)].z(); }

  void add(Role role, Side side, int bone, const char* text) {
    const auto same = [&](const RoleDoubt& doubt) { return doubt.bone == bone; };
    if (std::any_of(doubts_.begin(), doubts_.end(), same)) return;
    doubts_.push_back({role_label(role, side), bone, "'" + skeleton_.names[bone] + "' " + text});
  }

  const Skeleton& skeleton_;
  const RoleMap& map_;
  const Skin* skin_;
  PosedBones rest_;
  std::vector<RoleDoubt> doubts_;
};

}  // namespace

std::vector<RoleDoubt> find_doubts(const Skeleton& skeleton, const RoleMap& map, const Skin* skin) {
  return Doubts(skeleton, map, skin).find();
}

}  // namespace fragmotion
