// SPDX-License-Identifier: MIT
#include "retarget/limb_angles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "retarget/posture.hpp"
#include "skeleton/role_map.hpp"

namespace fragmotion {
namespace {

struct LimbPart {
  Role role, next;  // the bone's, and that of the next one of the limb: where a hand or a foot hangs, the one before
  bool is_end;
};

constexpr LimbPart kParts[] = {
    {Role::kUpperArm, Role::kLowerArm, false}, {Role::kLowerArm, Role::kHand, false},
    {Role::kHand, Role::kLowerArm, true},      {Role::kThigh, Role::kShin, false},
    {Role::kShin, Role::kFoot, false},         {Role::kFoot, Role::kShin, true},
};

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

// A body in a pose of its clip.
class Actor {
 public:
  Actor(const Body& body, const Clip& clip, bool at_rest)
      : body_(body),
        clip_(clip),
        rest_(rest_posture(body.skeleton())),
        straight_(at_rest ? rest_.rotations : body.reference),
        posed_(body.skeleton().size()) {}

  void pose(int frame) { world(body_.kinematics, clip_, frame, posed_.heads.data(), posed_.rotations.data()); }

  bool has(const LimbPart& part, Side side) const { return bone(part.role, side) >= 0 && bone(part.next, side) >= 0; }

  // Where a bone leads; of a hand or a foot, where the bone before it leads when they are straight.
  Vector3 way(const LimbPart& part, Side side) const {
    const int own = bone(part.role, side), other = bone(part.next, side);
    if (!part.is_end) return posed_.heads[other] - posed_.heads[own];
    const Vector3 along = rest_.rotations[other].conjugate() * (rest_.heads[own] - rest_.heads[other]);
    return posed_.rotations[own] * (straight_[own].conjugate() * (straight_[other] * along));
  }

 private:
  int bone(Role role, Side side) const { return body_.map.bone(role, side); }

  const Body& body_;
  const Clip& clip_;
  PosedBones rest_;
  std::vector<Quaternion> straight_;
  PosedBones posed_;
};

bool rests_standing(const Body& body) {
  PosedBones rest = rest_posture(body.skeleton());
  face_forward(body.map, rest);
  return stands(body.map, rest);
}

}  // namespace

std::map<std::string, double> limb_angles(const Body& source, const Clip& from, const Body& target, const Clip& to) {
  Actor actor(source, from, false), copy(target, to, rests_standing(target));
  const int step = frames_between_looks(from.frames), poses = (from.frames + step - 1) / step;
  std::map<std::string, double> angles;
  for (int f = 0; f < from.frames; f += step) {
    actor.pose(f);
    copy.pose(f);
    for (const LimbPart& part : kParts) {
      for (const Side side : {Side::kLeft, Side::kRight}) {
        if (!actor.has(part, side) || !copy.has(part, side)) continue;
        angles[role_label(part.role, side)] += angle_between(copy.way(part, side), actor.way(part, side)) / poses;
      }
    }
  }
  return angles;
}

}  // namespace fragmotion
