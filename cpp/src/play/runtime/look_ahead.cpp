// SPDX-License-Identifier: MIT
#include "runtime/look_ahead.hpp"

#include <algorithm>
#include <cmath>

namespace fragmotion {
namespace {

constexpr double kLanding = 0.06;  // m over the floor, of a 1.8 m character, within which a foot stands
constexpr double kSoonest = 0.02;  // s in which a foot that is higher comes down at least
constexpr double kLatest = 0.8;    // s that are looked ahead

// What a body's feet do next.
class LookAhead {
 public:
  LookAhead(const Playback& playback, const RootGovernor& governor, const PoseCorrection& correction,
            Workspace& workspace)
      : playback_(playback), governor_(governor), correction_(correction), workspace_(workspace) {}

  FootAhead foot(int side) const {
    FootAhead foot;
    foot.floor = workspace_.floors[side];
    foot.now = sole(workspace_.shown, side);
    const bool low = foot.now.height() * workspace_.body->scale < kLanding;
    foot.stands = correction_.plants(side, playback_.contacts().feet[side][playback_.frame_of_clip()] && low);
    if (foot.stands) {
      foot.way.back() = foot.now.moved(correction_.coming_to_rest(side));
    } else {
      look(side, foot);
    }
    return foot;
  }

 private:
  Sole sole(const WorldPose& pose, int side) const {
    const FootLock::Body& body = *workspace_.body;
    PosedBones& posed = workspace_.body->posed;
    body.kinematics.world_below(pose.root, pose.rotations.data(), body.bones, posed.heads.data(),
                                posed.rotations.data());
    const Skeleton& skeleton = body.kinematics.skeleton();
    const Leg& leg = body.legs[side];
    const FootHeights& floor = workspace_.floors[side];
    const Vector3 front = ball(skeleton, leg, posed), &heel = posed.heads[leg.foot];
    const Vector3 tip = leg.toe < 0 ? front : posed.heads[leg.toe] + posed.rotations[leg.toe] * skeleton.tips[leg.toe];
    const double height = front.z() - floor.ball;
    return {{heel.x(), heel.y(), heel.z() - floor.heel}, {front.x(), front.y(), height}, {tip.x(), tip.y(), height}};
  }

  void look(int side, FootAhead& foot) const {
    const double stepping = correction_.stepping(side);
    foot.due = std::clamp(playback_.until_standing(side) / governor_.tempo(), std::max(stepping, kSoonest), kLatest);
    const Vector2 held = (foot.now.ball - later(side, 0).ball).head<2>();
    for (std::size_t i = 0; i < FootAhead::kPoints; ++i) {
      const double seconds = foot.due * static_cast<double>(i + 1) / FootAhead::kPoints;
      const double returned = FootLock::kReturns * seconds;
      foot.way[i] = later(side, seconds).moved((1 + returned) * std::exp(-returned) * held);
    }
    const PosedBones& posed = workspace_.body->posed;
    const Leg& leg = workspace_.body->legs[side];
    foot.hips = in_time(workspace_.poses[0].root, foot.due);
    foot.hip = in_time(posed.heads[leg.thigh], foot.due);
    foot.ankle = posed.heads[leg.foot];
    foot.ankle.head<2>() = foot.way.back().heel.head<2>();
  }

  // The sole in so many seconds, with steps edited, and moved as the root is adjusted now.
  Sole later(int side, double seconds) const {
    WorldPose& pose = workspace_.poses[0];
    playback_.sample(playback_.seconds() + governor_.tempo() * seconds, pose);
    Sole at = sole(pose, side);
    at = at.moved(correction_.steps().moved(at.place() - pose.root.head<2>(), pose.heading));
    for (Vector3* point : {&at.heel, &at.ball, &at.tip}) *point = in_time(*point, seconds);
    return at;
  }

  // Where the root's adjustment takes what plays, in so many seconds.
  Vector3 in_time(const Vector3& point, double seconds) const {
    const CharacterFrame& frame = playback_.frame();
    const Eigen::Rotation2Dd turn(governor_.turn_rate() * seconds), heading(frame.heading);
    const Vector2 moved = frame.position + turn * Vector2{point.head<2>() - frame.position} +
                          heading * Vector2{seconds * governor_.velocity()};
    return {moved.x(), moved.y(), point.z()};
  }

  const Playback& playback_;
  const RootGovernor& governor_;
  const PoseCorrection& correction_;
  Workspace& workspace_;
};

}  // namespace

FeetAhead look_ahead(const Playback& playback, const RootGovernor& governor, const PoseCorrection& correction,
                     Workspace& workspace) {
  const Legs& legs = workspace.body->legs;
  if (!legs[0].exists() || !legs[1].exists() || playback.contacts().feet[0].empty()) return {};
  const LookAhead ahead(playback, governor, correction, workspace);
  return {ahead.foot(0), ahead.foot(1)};
}

}  // namespace fragmotion
