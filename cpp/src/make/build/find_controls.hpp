// SPDX-License-Identifier: MIT
#pragma once

#include "control/control.hpp"

namespace fragmotion {

/// Which controls a character is to have (Sec. 4): by default the paper's.
struct ControlOptions {
  bool find = false;     ///< As many speeds and directions as the takes hold, turns and jumps where they do.
  ControlLayout layout;  ///< Where they are not to be found.
};

/// The control space of a set of evident controls (in the default space). Of two speeds, which the paper has, they are
/// the means of what goes straight ahead of the two gaits that the fragments fall into; of others the means of as many
/// groups, whose speeds differ by a fifth at least, or of one the gait of most. What the fragments lack is as people
/// go. The turn rate is the upper quartile of those that turn. Throws as check(ControlLayout).
ControlSpace control_space_of(const std::vector<Control>& evident, double scale, const ControlOptions& options = {});

/// What simulated players ask for who teach before the takes are known: as many speeds as are told, as fast as people
/// go; the paper's where they are to be found.
ControlSpace usual_space(const ControlOptions& options);

/// What of a control space fragments show by themselves; each is shown by three of them at least, and by one in 200 of
/// those that go.
struct HeldControls {
  int speeds = 0;
  int directions = 0;
  bool turn = false, jump = false;
};

/// Of a set of evident controls, in that space.
HeldControls held_controls(const std::vector<Control>& evident, const ControlSpace& space);

}  // namespace fragmotion
