// SPDX-License-Identifier: MIT
#include "retarget/body.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/listed.hpp"
#include "base/rounding.hpp"
#include "base/turn_between.hpp"
#include "motion/soles.hpp"
#include "retarget/added_feet.hpp"
#include "retarget/posture.hpp"
#include "skeleton/likely_tips.hpp"

namespace fragmotion {
namespace {

constexpr double kInstep = 0.4;  // rad: how far most feet point down from the ankle to the ball

void check_complete(const RoleMap& map) {
  if (map.bone(Role::kForeFoot, Side::kLeft) >= 0)
    throw std::invalid_argument(
        "a body on four legs: motion is brought onto bodies with two legs, and from such; an animal learns from takes "
        "of its own bones");
  std::vector<std::string> missing;
  const auto require = [&](Role role, Side side) {
    if (map.bone(role, side) < 0) missing.push_back(role_label(role, side));
  };
  require(Role::kHips, Side::kNone);
  for (const Side side : kSides) {
    for (const Role role : {Role::kThigh, Role::kShin, Role::kFoot}) require(role, side);
  }
  if (missing.empty()) return;
  throw std::invalid_argument("no bone is known to be " + listed(missing) +
                              ": motion is brought onto bodies with hips and two legs; say which bones they are");
}

void check_hangs(const Skeleton& skeleton, const RoleMap& map, Role role, Role above, Side side) {
  const int bone = map.bone(role, side), on = map.bone(above, above == Role::kHips ? Side::kNone : side);
  if (bone != on && skeleton.is_below(bone, on)) return;
  throw std::invalid_argument(role_label(role, side) + " '" + skeleton.names[bone] + "' does not hang on " +
                              role_label(above, above == Role::kHips ? Side::kNone : side) + " '" + skeleton.names[on] +
                              "': choose bones of one chain from the hips to the foot");
}

void check_legs(const Skeleton& skeleton, const RoleMap& map) {
  for (const Side side : kSides) {
    check_hangs(skeleton, map, Role::kThigh, Role::kHips, side);
    check_hangs(skeleton, map, Role::kShin, Role::kThigh, side);
    check_hangs(skeleton, map, Role::kFoot, Role::kShin, side);
  }
}

// The map without what does not hang on the hips, as controls that are far from the body do not.
RoleMap on_body(const Skeleton& skeleton, RoleMap map) {
  const int hips = map.bone(Role::kHips);
  const auto apart = [&](const auto& entry) { return !skeleton.is_below(entry.bone, hips); };
  map.bones.erase(std::remove_if(map.bones.begin(), map.bones.end(), apart), map.bones.end());
  map.twists.erase(std::remove_if(map.twists.begin(), map.twists.end(), apart), map.twists.end());
  return map;
}

// Head and hands are kept that the map does not tell: a skeleton's size depends on them.
Skeleton with_roles(Skeleton skeleton, const RoleMap& map) {
  Roles roles = roles_of(map);
  if (roles.hips != skeleton.roles.hips) {
    throw std::invalid_argument("the hips are '" + skeleton.names[roles.hips] + "' by the roles, but '" +
                                skeleton.names[skeleton.roles.hips] +
                                "' carries the skeleton: make it with the same hips");
  }
  for (int Roles::*kept : {&Roles::head, &Roles::left_hand, &Roles::right_hand}) {
    if (roles.*kept < 0) roles.*kept = skeleton.roles.*kept;
  }
  skeleton.roles = roles;
  return skeleton;
}

Leg leg_of(const Skeleton& skeleton, const RoleMap& map, Side side) {
  Leg leg;
  leg.thigh = map.bone(Role::kThigh, side);
  leg.knee = map.bone(Role::kShin, side);
  leg.foot = map.bone(Role::kFoot, side);
  const int toe = map.bone(Role::kToe, side);
  leg.toe = toe != leg.foot && skeleton.is_below(toe, leg.foot) ? toe : -1;
  leg.above_foot = skeleton.parents[leg.foot];
  return leg;
}

// Where a limb's bones and the fingers point in a posture and are to point; none (zero) for other bones. Where joints
// are known to bend (`hinges`, as bones see them, else empty), the trunk is to be straight, too, and elbows and knees
// to bend forward and backward.
class Directions {
 public:
  Directions(const Skeleton& skeleton, const RoleMap& map, const PosedBones& posture,
             const std::vector<Vector3>& hinges)
      : skeleton_(skeleton),
        map_(map),
        posture_(posture),
        hinges_(hinges),
        from_(skeleton.size(), Vector3::Zero()),
        to_(skeleton.size(), Vector3::Zero()) {
    if (!hinges.empty()) trunk();
    for (const Side side : kSides) {
      limb(side, {Role::kThigh, Role::kShin, Role::kFoot}, -Vector3::UnitZ());
      limb(side, {Role::kUpperArm, Role::kLowerArm, Role::kHand}, outward(side));
      hand(side);
    }
  }

  // What is left to turn a bone that has been turned by `turn` already.
  Quaternion rest_of(int bone, const Quaternion& turn) const {
    if (std::find(level_.begin(), level_.end(), bone) != level_.end()) return turn.conjugate();
    if (from_[bone].squaredNorm() == 0) return Quaternion::Identity();
    const Quaternion there = turn_between(turn * from_[bone], to_[bone]);
    if (hinges_.empty() || hinges_[bone].squaredNorm() == 0) return there;
    const Vector3 &along = to_[bone], now = there * turn * posture_.rotations[bone] * hinges_[bone],
                  wanted = std::abs(along.z()) > std::abs(along.x()) ? Vector3{-Vector3::UnitX()}
                                                                     : Vector3{along.x() * Vector3::UnitZ()};
    const double angle = std::atan2(along.dot(now.cross(wanted)), now.dot(wanted));
    return Eigen::AngleAxisd(angle, along) * there;
  }

 private:
  static Vector3 outward(Side side) { return (side == Side::kLeft ? -1 : 1) * Vector3::UnitX(); }

  void set(int bone, const Vector3& from, const Vector3& to) {
    if (bone < 0 || from.norm() < kFileRounding / standard_scale(skeleton_)) return;
    from_[bone] = from.normalized();
    to_[bone] = to;
  }

  void limb(Side side, const std::vector<Role>& roles, const Vector3& to) {
    for (std::size_t i = 0; i + 1 < roles.size(); ++i) {
      const int bone = map_.bone(roles[i], side), next = map_.bone(roles[i + 1], side);
      if (bone >= 0 && next >= 0) set(bone, posture_.heads[next] - posture_.heads[bone], to);
    }
  }

  // The trunk as a whole; its joints stand over each other as the actor's do. On the mean a head looks straight ahead.
  void trunk() {
    const std::vector<int> neck = above_trunk();
    const int hips = map_.bone(Role::kHips), top = neck.empty() ? top_of(map_) : neck[0];
    set(hips, posture_.heads[top] - posture_.heads[hips], Vector3::UnitZ());
    level_ = neck;
  }

  std::vector<int> above_trunk() const {
    std::vector<int> bones = map_.chain(Role::kNeck);
    for (const int head : map_.chain(Role::kHead)) bones.push_back(head);
    return bones;
  }

  Vector3 tip(int bone) const { return posture_.rotations[bone] * skeleton_.tips[bone]; }

  // The four fingers of a hand, and the hand towards their mean, or its tip where it has none. A thumb stays.
  void hand(Side side) {
    const int hand = map_.bone(Role::kHand, side);
    if (hand < 0) return;
    Vector3 knuckles = Vector3::Zero();
    for (int finger = 1; finger <= 4; ++finger) {
      const std::vector<int> bones = finger_bones(side, finger);
      if (!bones.empty()) knuckles += posture_.heads[bones[0]] - posture_.heads[hand];
      for (std::size_t i = 0; i < bones.size(); ++i) {
        const bool last = i + 1 == bones.size();
        set(bones[i], last ? tip(bones[i]) : Vector3{posture_.heads[bones[i + 1]] - posture_.heads[bones[i]]},
            outward(side));
      }
    }
    set(hand, knuckles.squaredNorm() > 0 ? knuckles : tip(hand), outward(side));
  }

  std::vector<int> finger_bones(Side side, int finger) const {
    std::vector<int> bones;
    for (const RoleBone& bone : map_.bones) {
      if (bone.role == Role::kFinger && bone.side == side && bone.finger == finger) bones.push_back(bone.bone);
    }
    return bones;
  }

  const Skeleton& skeleton_;
  const RoleMap& map_;
  const PosedBones& posture_;
  const std::vector<Vector3>& hinges_;
  std::vector<Vector3> from_, to_;
  std::vector<int> level_;  // bones that are as in the posture
};

// Turns a foot straight ahead about the vertical. One that points up, down or backward is `turned` already, with the
// shin, and is put where most feet are.
Quaternion ahead(const Vector3& foot, const Quaternion& turned) {
  const Vector2 way = foot.head<2>();
  if (foot.norm() == 0) return turned;
  if (way.y() < kNoDirection * foot.norm()) {
    return turn_between(turned * foot, Vector3{0, std::cos(kInstep), -std::sin(kInstep)}) * turned;
  }
  return Quaternion{Eigen::AngleAxisd(std::atan2(way.x(), way.y()), Vector3::UnitZ())};
}

// How much each bone of a posture is turned to the pose that bodies are compared in.
std::vector<Quaternion> turns_to_reference(const Body& body, const PosedBones& posture,
                                           const std::vector<Vector3>& hinges) {
  const Skeleton& skeleton = body.skeleton();
  const Directions directions(skeleton, body.map, posture, hinges);
  std::vector<Quaternion> turns(skeleton.size(), Quaternion::Identity());
  for (int b = 0; b < skeleton.size(); ++b) {
    if (b > 0) turns[b] = turns[skeleton.parents[b]];
    turns[b] = directions.rest_of(b, turns[b]) * turns[b];
    for (const Leg& leg : body.legs) {
      if (b == leg.foot) turns[b] = ahead(ball(skeleton, leg, posture) - posture.heads[b], turns[b]);
    }
  }
  return turns;
}

// Puts a flat foot in a posture.
void put(const Skeleton& skeleton, const Leg& leg, const FlatFoot& flat, PosedBones& posture) {
  for (int b = 0; b < skeleton.size(); ++b) {
    if (!skeleton.is_below(b, leg.foot) || b == leg.foot) continue;
    const Quaternion turn = flat.foot * posture.rotations[leg.foot].conjugate();
    posture.heads[b] = posture.heads[leg.foot] + turn * (posture.heads[b] - posture.heads[leg.foot]);
    posture.rotations[b] = turn * posture.rotations[b];
  }
  posture.rotations[leg.foot] = flat.foot;
  if (leg.toe >= 0) posture.rotations[leg.toe] = flat.toe;
}

FootHeights heights_in(const Body& body, int side, const PosedBones& posture) {
  const Leg& leg = body.legs[side];
  return {ball(body.skeleton(), leg, posture).z(), posture.heads[leg.foot].z()};
}

// Over the ground, which is where the feet are, but z = 0 where they are right above it.
Floors over_ground(Floors soles, double scale) {
  const double lowest = std::min({soles[0].ball, soles[0].heel, soles[1].ball, soles[1].heel});
  const bool on_ground = is_on_ground(lowest * scale);
  for (FootHeights& sole : soles) sole = {sole.ball - (on_ground ? 0 : lowest), sole.heel - (on_ground ? 0 : lowest)};
  return soles;
}

double length_of(const Leg& leg, const PosedBones& posture) {
  return (posture.heads[leg.knee] - posture.heads[leg.thigh]).norm() +
         (posture.heads[leg.foot] - posture.heads[leg.knee]).norm();
}

double shortest_of(const Leg& leg, const PosedBones& posture) {
  return std::min((posture.heads[leg.knee] - posture.heads[leg.thigh]).norm(),
                  (posture.heads[leg.foot] - posture.heads[leg.knee]).norm());
}

void measure(const PosedBones& rest, Body& body) {
  body.leg = (length_of(body.legs[0], rest) + length_of(body.legs[1], rest)) / 2;
  body.hip_width = (rest.heads[body.legs[0].thigh] - rest.heads[body.legs[1].thigh]).norm();
  const double least = kFileRounding / standard_scale(body.skeleton());
  for (int side = 0; side < 2; ++side) {
    if (std::min(shortest_of(body.legs[side], rest), body.hip_width) > least) continue;
    throw std::invalid_argument("the " + std::string(side == 0 ? "left" : "right") +
                                " leg has bones of no length: choose thigh, shin and foot at hip, knee and ankle");
  }
}

// What tells how a body stands: its rest pose, or where that does not, its clips.
struct Told {
  PosedBones posture;
  std::vector<Vector3> hinges;  // of each bone; empty where it is the rest pose
};

Told told_posture(const std::vector<Clip>& clips, Body& body) {
  Told told{rest_posture(body.skeleton()), {}};
  face_forward(body.map, told.posture);
  const std::vector<Vector3> hinges = mean_hinges(body.kinematics, body.map, clips);
  body.stands = stands(body.map, told.posture);
  if (body.stands && bends_back(body.map, told.posture, hinges)) return told;
  const std::optional<PosedBones> mean = mean_posture(body.kinematics, body.map, clips);
  body.stands = body.stands || mean;
  return mean ? Told{*mean, hinges} : told;
}

// How the feet stand flat: in the clips where they do, else as in the posture.
void set_feet(const std::vector<Clip>& clips, PosedBones& posture, Body& body) {
  const std::array<FlatFoot, 2> flat = flat_feet(body.kinematics, body.legs, clips);
  const bool known = flat[0].known && flat[1].known;
  for (int side = 0; side < 2; ++side) {
    body.soles[side] = known ? flat[side].heights : heights_in(body, side, posture);
    if (known) put(body.skeleton(), body.legs[side], flat[side], posture);
  }
  body.soles = over_ground(body.soles, standard_scale(body.skeleton()));
}

void set_reference(const Told& told, Body& body) {
  const PosedBones& posture = told.posture;
  const std::vector<Quaternion> turns = turns_to_reference(body, posture, told.hinges);
  for (std::size_t b = 0; b < turns.size(); ++b) body.reference.push_back(turns[b] * posture.rotations[b]);
  for (int side = 0; side < 2; ++side) {
    Leg& leg = body.legs[side];
    body.feet[side] = turns[leg.foot] * (ball(body.skeleton(), leg, posture) - posture.heads[leg.foot]);
    leg.hinge = body.reference[leg.thigh].conjugate() * -Vector3::UnitX();
  }
}

}  // namespace

Body make_body(const Skeleton& given, const RoleMap& told_map, const std::vector<Clip>& clips, const Skin* skin) {
  const auto [skeleton, map] = with_feet(given, with_feet_ahead(given, told_map));
  check_complete(map);
  check_legs(skeleton, map);
  const std::array<Leg, 2> legs = {leg_of(skeleton, map, Side::kLeft), leg_of(skeleton, map, Side::kRight)};
  const Skeleton likely = with_likely_tips(with_short_feet(with_roles(skeleton, map), legs[0], legs[1]), map, skin);
  Body body(Kinematics(likely), on_body(skeleton, map));
  body.given = given;
  body.legs = {legs[0], legs[1]};
  measure(rest_posture(skeleton), body);
  Told told = told_posture(body.has_added_feet() ? std::vector<Clip>() : clips, body);
  set_feet(body.has_added_feet() ? std::vector<Clip>() : clips, told.posture, body);
  set_reference(told, body);
  return body;
}

}  // namespace fragmotion
