// SPDX-License-Identifier: MIT
#include "io/shown_feet.hpp"

#include "base/rounding.hpp"
#include "motion/legs.hpp"

namespace fragmotion {

ShownFeet::ShownFeet(const Kinematics& kinematics, int frames)
    : kinematics_(kinematics), legs_(resting_legs(kinematics.skeleton())), ankles_(at(frames, 0), Vector3::Zero()) {
  std::vector<int> feet;
  for (const Leg& leg : legs_) feet.push_back(leg.foot);
  chains_ = kinematics.chains(feet);
}

void ShownFeet::pose(const Clip& clip, int frame, PosedBones& bones) const {
  world(kinematics_, clip, frame, chains_, bones.heads.data(), bones.rotations.data());
}

bool ShownFeet::are_kept(const Clip& clip) const {
  const double least = kFileRounding / standard_scale(kinematics_.skeleton());
  PosedBones bones(kinematics_.bones());
  for (int f = 0; f < clip.frames; ++f) {
    pose(clip, f, bones);
    for (int leg = 0; leg < legs_.count(); ++leg) {
      if ((ankle_of(legs_[leg], bones) - ankles_[at(f, leg)]).norm() > least) return false;
    }
  }
  return true;
}

Legs ShownFeet::bent_in(const Clip& clip) const {
  Legs bent = legs_;
  for (Leg& leg : bent) leg.hinge = Vector3::Zero();
  add_bends(kinematics_, clip, 1, bent);
  for (int leg = 0; leg < bent.count(); ++leg) {
    Vector3& hinge = bent[leg].hinge;
    hinge = hinge.norm() > kRounding ? hinge.normalized() : legs_[leg].hinge;
  }
  return bent;
}

void ShownFeet::keep(Clip& clip) const {
  if (are_kept(clip)) return;
  const Legs bent = bent_in(clip);
  PosedBones bones(kinematics_.bones());
  for (int f = 0; f < clip.frames; ++f) {
    pose(clip, f, bones);
    for (int leg = 0; leg < bent.count(); ++leg) {
      reach(kinematics_.skeleton(), bent[leg], bones, ankles_[at(f, leg)], {0, leg_length(bent[leg], bones)},
            &clip.rotations[4 * static_cast<std::size_t>(f) * kinematics_.bones()]);
    }
  }
}

}  // namespace fragmotion
