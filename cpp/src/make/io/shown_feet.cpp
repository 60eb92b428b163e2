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

PosedBones ShownFeet::posed(const Clip& clip, int frame) const {
  PosedBones posed(kinematics_.bones());
  world(kinematics_, clip, frame, chains_, posed.heads.data(), posed.rotations.data());
  return posed;
}

bool ShownFeet::are_kept(const Clip& clip) const {
  const double least = kFileRounding / standard_scale(kinematics_.skeleton());
  for (int f = 0; f < clip.frames; ++f) {
    const PosedBones bones = posed(clip, f);
    for (int leg = 0; leg < legs_.count(); ++leg) {
      if ((ankle_of(legs_[leg], bones) - ankles_[at(f, leg)]).norm() > least) return false;
    }
  }
  return true;
}

Legs ShownFeet::bent_in(const Clip& clip) const {
  Legs bent = legs_;
  for (Leg& leg : bent) leg.hinge = Vector3::Zero();
  for (int f = 0; f < clip.frames; ++f) {
    const PosedBones bones = posed(clip, f);
    for (Leg& leg : bent) leg.hinge += bend_axis(leg, bones);
  }
  for (int leg = 0; leg < bent.count(); ++leg) {
    Vector3& hinge = bent[leg].hinge;
    hinge = hinge.norm() > kRounding ? hinge.normalized() : legs_[leg].hinge;
  }
  return bent;
}

void ShownFeet::keep(Clip& clip) const {
  if (are_kept(clip)) return;
  const Legs bent = bent_in(clip);
  for (int f = 0; f < clip.frames; ++f) {
    const PosedBones bones = posed(clip, f);
    for (int leg = 0; leg < bent.count(); ++leg) {
      reach(kinematics_.skeleton(), bent[leg], bones, ankles_[at(f, leg)], {0, leg_length(bent[leg], bones)},
            &clip.rotations[4 * static_cast<std::size_t>(f) * kinematics_.bones()]);
    }
  }
}

}  // namespace fragmotion
