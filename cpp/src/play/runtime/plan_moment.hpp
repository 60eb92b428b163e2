// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

#include "base/rates.hpp"
#include "base/rounding.hpp"
#include "fragments/entry_poses.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

// Finds the moment at which `cost` of what would be shown is least, of those where it `can` be, as another player shows
// ahead.
template <typename Cost>
void Player::plan(Moment& moment, const Control& control, bool (Player::*can)() const, const Cost& cost) {
  Player& ahead = *extras_->rehearsal;
  ahead.imitate(*this);
  double best = moment.patience(), least = std::numeric_limits<double>::infinity();
  for (double wait = 0;;) {
    ahead.playback_.show();
    const double total = cost(ahead) + wait;  // a second costs a m of Dis of a body of kTunedReach
    if ((ahead.*can)() && total < least) least = total, best = wait;
    const double next = std::min(wait + kMomentsApart, moment.patience());
    if (next - wait < kRounding) break;
    for (double rest = next - wait; rest > kRounding;) {
      rest -= ahead.advance(control, std::min(rest, kGameStep));
      ahead.playback_.find_frame();
    }
    wait = next;
  }
  moment.plan(best, control);
}

}  // namespace fragmotion
