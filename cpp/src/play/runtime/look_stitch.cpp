// SPDX-License-Identifier: MIT
#include "runtime/look_stitch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/filtered.hpp"

namespace fragmotion {
namespace {

// From the world to how a pose is headed.
Quaternion to_frame_of(const WorldPose& pose) { return CharacterFrame{{}, -pose.heading}.rotation(); }

}  // namespace

// How the bone that the neck is on is turned in the world.
Quaternion LookStitch::turn_below(const std::vector<double>& rotations) const {
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  return world_turn(skeleton, skeleton.parents[workspace_->look.front()], rotations.data());
}

// Writes how neck and head are turned, which is seen after a rotation, as the pose of a body that is these bones.
void LookStitch::see(const std::vector<double>& rotations, const Quaternion& after, WorldPose& look) const {
  Quaternion seen = product(after, turn_below(rotations));
  double* out = look.rotations.data();
  for (const int bone : workspace_->look) {
    seen = product(seen, load_quaternion(&rotations[std::size_t{4} * bone]));
    store_quaternion(seen, out);
    out += 4;
  }
}

// An offset fades exp(-1) times its damping as fast at its fastest.
[[gnu::cold]] void LookStitch::begin(const WorldPose& old, const WorldPose& old_later, const WorldPose& fresh,
                                     const WorldPose& fresh_later, double apart, double seconds, double turning,
                                     const PackedClip& clip, Inertialization& body) {
  if (workspace_->look.empty()) return;
  auto& looks = workspace_->looks;
  const std::array poses{&old, &old_later, &fresh, &fresh_later};
  const Quaternion to_frame = to_frame_of(fresh);
  for (std::size_t i = 0; i < looks.size(); ++i) see(poses[i]->rotations, to_frame, looks[i]);
  const auto offset = [&](std::size_t i) {
    const auto rotation = [&](int pose) { return &looks[pose].rotations[4 * i]; };
    return turn_offset(rotation(0), rotation(1), rotation(2), rotation(3), apart);
  };
  const double fades = body.constants().fades, usual = fades / seconds;
  damping_ = usual;
  for (std::size_t i = 0; i < workspace_->look.size(); ++i) {
    const double most = std::max(0.0, (kTurnsAtMost - 1) * workspace_->fastest_looks[i] - std::abs(turning));
    damping_ = std::min(damping_, most / (std::exp(-1.0) * 4 * std::atan(offset(i).turn.norm())));
  }
  if (damping_ == usual) return clear();
  damping_ = std::max(damping_, fades / std::max(kSlowestStitch, seconds));
  for (std::size_t i = 0; i < workspace_->look.size(); ++i) body.keep(clip.lane_of(workspace_->look[i]), offset(i));
}

bool LookStitch::active(double time, const Inertialization& body) const {
  return damping_ > 0 && time < kUnseen * body.constants().fades / damping_;
}

void LookStitch::apply(double time, const Inertialization& body, const PackedClip& clip, WorldPose& pose) const {
  if (!active(time, body)) return;
  WorldPose& look = workspace_->looks[0];
  const Quaternion to_frame = to_frame_of(pose);
  std::vector<double>& plain = workspace_->plain;
  workspace_->unpacked.plain(clip, workspace_->kinematics.skeleton().roles.hips, plain.data());
  for (const int bone : workspace_->head_chain) workspace_->unpacked.plain(clip, bone, plain.data());
  see(plain, to_frame, look);
  const Fade fade = body.fade(damping_, time);
  Quaternion from = product(to_frame, turn_below(pose.rotations));
  const double* seen = look.rotations.data();
  for (const int bone : workspace_->look) {
    const Quaternion turned = product(body.turn(clip.lane_of(bone), fade), load_quaternion(seen));
    store_quaternion(rounded_off(product(from.conjugate(), turned)), &pose.rotations[std::size_t{4} * bone]);
    from = turned;
    seen += 4;
  }
}

}  // namespace fragmotion
