// SPDX-License-Identifier: MIT
#pragma once

#include "classes/classes.hpp"
#include "control/control.hpp"
#include "fragments/distance.hpp"

namespace fragmotion {

/// Transitions further apart than this get a stand-in-place fragment between, m a metre of tip_reach(). Inertialization
/// makes what is nearer than that clean.
constexpr double kBridgeDistance = 15 / kTunedReach;

/// The stand-in-place rule (Sec. 3.3: "we insert a stand-in-place motion fragment between the two motion fragments when
/// they are inappropriate to connect directly"): for every pair of classes the standing class that goes between, or -1.
/// One does where the direct Dis is over `threshold` times the reach and both ways by the standing class are shorter;
/// the one with the shortest sum is taken. `allowed` [classes] says which classes may go between; empty: all.
std::vector<int> stand_bridges(const std::vector<Fragment>& fragments, const Trajectories& t, const Classes& classes,
                               const ControlSpace& space, double threshold = kBridgeDistance,
                               const std::vector<bool>& allowed = {});

}  // namespace fragmotion
