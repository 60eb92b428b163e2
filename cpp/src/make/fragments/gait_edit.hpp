// SPDX-License-Identifier: MIT
#pragma once

#include "motion/contacts.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// "Simple transforming of the original fragments" (Sec. 4): how the path of a fragment is changed; the body goes
/// along.
struct GaitEdit {
  double direction = 0;  ///< Turns the direction of travel against the body, rad, left is positive.
  double speed = 1;      ///< Scales the path.
  double tempo = 1;      ///< The steps follow each other so much faster.
  double turn = 0;       ///< Turns path and body at this rate, rad/s.
  double hips = 0;       ///< Turns the hips under the chest, rad; of a body on two legs.
};

/// `frames` + 1 frames that go round and round frames begin .. end of a clip, a gait's cycle, with the path
/// transformed; frame 0 is where `begin` was. With `end` before `begin` the cycle is played backward. Where the cycle
/// does not end as it began, its second half leads there. The strides are turned and scaled with the path: to the
/// side with flat feet, which keep apart rather than cross, as far as 0.2 m a foot allow. Feet that `contacts` (of the
/// clip) say are planted stay planted.
Clip transformed(const Kinematics& kinematics, const Legs& legs, const Clip& clip, const Contacts& contacts, int begin,
                 int end, int frames, const GaitEdit& edit);

/// Of a motion that goes round and round frames begin .. end of a clip with these contacts: the last of the `within`
/// frames following number `after` in which the foot comes down whose turn it then is, or has come down and stands
/// alone. A foot that came down less than `touch` frames before `after` has not come down yet. -1: there is none.
int next_foot_down(const Contacts& contacts, int begin, int end, int after, int within, int touch = 0);

/// A clip whose body goes the same way at the same time, but whose gait gets only from its pose at `take_off` to that
/// at `down` until `landing`, all in frames, and goes on from there as before: so that the foot lands whose turn it is.
/// It ends where the poses do.
Clip gait_in_flight(const Kinematics& kinematics, const Clip& clip, double take_off, double landing, double down);

/// How a hop lifts and lowers the body, m over time: it sinks into a crouch, pushes off with a constant force, flies as
/// a body falls, and lands as it took off. Lengths in m of a 1.8 m character, times in s, all above 0.
class Hop {
 public:
  /// `height` of the flight, `dip` of the crouch, and the time to sink into it; `running`: 0 on the spot .. 1.
  Hop(double height, double dip, double sinking, double running = 0);

  double crouch() const { return sinking_ + pushing_; }  ///< s until the take-off, and from the landing on.
  double flight() const;                                 ///< s
  double seconds() const { return 2 * crouch() + flight(); }
  double at(double seconds) const;  ///< The height at a time from the beginning, 0 .. seconds().
  /// rad by which the arms are swung forward then: back as the body begins to sink, forward until it flies, and down to
  /// the landing; further for a jump that takes off faster, not in a run, whose arms swing already.
  double arms(double seconds) const;

 private:
  double dip_, sinking_, speed_, pushing_, swing_;
};

/// Adds a hop to a clip, from its first frame on: the knees bend and the trunk bows as the body goes down over the
/// feet, the arms swing, and in the air the feet are drawn up.
void add_hop(const Kinematics& kinematics, const Legs& legs, Clip& clip, const Hop& hop);

}  // namespace fragmotion
