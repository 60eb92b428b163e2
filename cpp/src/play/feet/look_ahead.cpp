// SPDX-License-Identifier: MIT
#include "feet/look_ahead.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

// What a body's feet do next.
class LookAhead {
 public:
  LookAhead(FootLock::Body& body, const Floors& floors, const FootLock* lock, const Course& course, WorldPose& later)
      : body_(body), floors_(floors), lock_(lock), course_(course), later_(later) {}

  FootAhead foot(int side, const WorldPose& shown) const {
    FootAhead foot;
    foot.floor = floors_[side];
    foot.now = sole(shown, side);
    const bool low = foot.now.height() * body_.scale < kLanding;
    foot.stands = course_.stands[side] && (lock_ != nullptr || low);
    if (foot.stands) {
      foot.way.back() = foot.now.moved(lock_ != nullptr ? lock_->coming_to_rest(side) : Vector2::Zero());
    } else {
      look(side, foot);
    }
    return foot;
  }

 private:
  Sole sole(const WorldPose& pose, int side) const {
    PosedBones& posed = body_.posed;
    body_.kinematics.world_below(pose.root, pose.rotations.data(), body_.leg_bones[side], posed.heads.data(),
                                 posed.rotations.data());
    const Skeleton& skeleton = body_.kinematics.skeleton();
    const Leg& leg = body_.legs[side];
    const FootHeights& floor = floors_[side];
    const Vector3 front = ball(skeleton, leg, posed), heel = ankle_of(leg, posed);
    const Vector3 tip = leg.toe < 0 ? front : posed.heads[leg.toe] + posed.rotations[leg.toe] * skeleton.tips[leg.toe];
    const double height = front.z() - floor.ball;
    return {{heel.x(), heel.y(), heel.z() - floor.heel}, {front.x(), front.y(), height}, {tip.x(), tip.y(), height}};
  }

  void look(int side, FootAhead& foot) const {
    const double stepping = lock_ != nullptr ? lock_->stepping(side) : 0;
    foot.due = std::clamp(course_.until_standing[side], std::max(stepping, kSettles), kLookedAhead);
    const Vector2 held = (foot.now.ball - later(side, 0).ball).head<2>();
    for (std::size_t i = 0; i < FootAhead::kPoints; ++i) {
      const double seconds = foot.due * static_cast<double>(i + 1) / FootAhead::kPoints;
      const double returned = body_.constants.returns() * seconds;
      foot.way[i] = later(side, seconds).moved((1 + returned) * std::exp(-returned) * held);
    }
    const PosedBones& posed = body_.posed;
    const Leg& leg = body_.legs[side];
    foot.hips = in_time(later_.root, foot.due);
    foot.hip = in_time(posed.heads[leg.thigh], foot.due);
    foot.ankle = ankle_of(leg, posed);
    foot.ankle.head<2>() = foot.way.back().heel.head<2>();
  }

  // The sole in so many seconds, with steps edited, and moved as the root is adjusted now.
  Sole later(int side, double seconds) const {
    course_.sample(seconds, later_);
    Sole at = sole(later_, side);
    at = at.moved(course_.steps.in_world(later_.heading).moved(at.place() - later_.root.head<2>()));
    for (Vector3* point : {&at.heel, &at.ball, &at.tip}) *point = in_time(*point, seconds);
    return at;
  }

  // Where the root's adjustment takes what plays, in so many seconds.
  Vector3 in_time(const Vector3& point, double seconds) const {
    const CharacterFrame& frame = course_.frame;
    const Eigen::Rotation2Dd turn(course_.turn_rate * seconds), heading(frame.heading);
    const Vector2 moved = frame.position + turn * Vector2{point.head<2>() - frame.position} +
                          heading * Vector2{seconds * course_.velocity};
    return {moved.x(), moved.y(), point.z()};
  }

  FootLock::Body& body_;
  const Floors& floors_;
  const FootLock* lock_;
  const Course& course_;
  WorldPose& later_;
};

}  // namespace

FeetAhead look_ahead(FootLock::Body& body, const Floors& floors, const FootLock* lock, const Course& course,
                     const WorldPose& shown, WorldPose& later) {
  if (!body.legs[0].exists() || !body.legs[1].exists()) return {};
  const LookAhead ahead(body, floors, lock, course, later);
  return {ahead.foot(0, shown), ahead.foot(1, shown)};
}

}  // namespace fragmotion
