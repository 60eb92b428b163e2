// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "retarget/body.hpp"

namespace fragmotion {

/// Gives the twist bones of a body their share: along an upper limb from none to the limb's own turn about its length,
/// along a lower one from that to the hand's or foot's.
class Twists {
 public:
  explicit Twists(const Body& body);

  /// Sets the world rotations of the twist bones by those of the bones that have roles.
  void apply(std::vector<Quaternion>& rotations) const;

  /// The twist bones that have a share.
  std::vector<int> bones() const;

 private:
  struct Twist {
    int bone = -1, limb = -1;
    int above = -1, below = -1;  // the bones whose turn against each other is shared
    double share = 0;            // of that turn, from the limb on
    Vector3 axis;                // of the limb
    Quaternion rest;             // of the bone in the limb
    Quaternion joint;            // of `below` in `above`, in the pose that bodies are compared in
  };

  void add(const Body& body, const TwistBone& bone, const RoleBone& limb);

  std::vector<Twist> twists_;
};

}  // namespace fragmotion
