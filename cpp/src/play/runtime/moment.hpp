// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "control/control.hpp"

namespace fragmotion {

/// The moment, within a time to wait, at which something begins that joins best then: planned for a control, and anew
/// where that changes.
class Moment {
 public:
  /// Waits for at most so many seconds from now on.
  void await(double patience) { *this = Moment(patience); }

  Moment() = default;

  /// Whether the moment is to be found (again): none is known, or it was for another control.
  bool needs_plan(const Control& control, const ControlSpace& space) const {
    return !planned_ || (begins_in_ > 0 && space.distance(control, planned_for_) > kChange);
  }
  /// The moment is in `seconds`, under this control.
  void plan(double seconds, const Control& control) {
    begins_in_ = seconds;
    planned_for_ = control;
    planned_ = true;
  }
  /// s that the moment may be away.
  double patience() const { return patience_; }
  /// s until the moment; at least 0.
  double until() const { return begins_in_; }
  /// A time goes by.
  void wait(double seconds) {
    begins_in_ = std::max(0.0, begins_in_ - seconds);
    patience_ = std::max(0.0, patience_ - seconds);
  }

 private:
  friend struct PlayerState;

  explicit Moment(double patience) : patience_(patience) {}

  double begins_in_ = 0, patience_ = 0;  // s
  bool planned_ = false;
  Control planned_for_;
};

}  // namespace fragmotion
