// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/contacts.hpp"

namespace fragmotion {

/// How low feet go that are fast: at a speed along the ground, the height over its floor under which a foot's ball is
/// in no more than kUnderFloor of the moments in which one goes so fast or faster; at least 0.
class FootClearance {
 public:
  /// A ball at a moment: m/s along the ground, and m over its floor.
  struct Moment {
    double speed = 0, height = 0;
  };

  /// Every foot goes as it does.
  FootClearance() = default;
  explicit FootClearance(std::vector<Moment> moments);

  /// m, which goes linearly from each speed that is known to the next.
  double at(double speed) const;

 private:
  std::vector<Moment> known_;  // by speed
};

}  // namespace fragmotion
