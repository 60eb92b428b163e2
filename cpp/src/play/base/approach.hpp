// SPDX-License-Identifier: MIT
#pragma once

namespace fragmotion {

/// A value that gets to another at a given time, smoothly and at rest. Told the same time again and again, it gets
/// there in about that time, ever more slowly.
struct Approach {
  /// Times as fast as on the mean it is half way, from rest to rest.
  static constexpr double kPeak = 1.5;

  double value = 0, speed = 0;

  /// Goes on for `seconds` on its way to `target`, where it is to be in `due` seconds.
  void advance(double target, double due, double seconds) {
    if (due <= seconds) {
      *this = {target, 0};
      return;
    }
    const double u = seconds / due, way = target - value, start = speed * due;
    value += u * (start + u * (3 * way - 2 * start + u * (start - 2 * way)));
    speed = (start + u * (2 * (3 * way - 2 * start) + 3 * u * (start - 2 * way))) / due;
  }

  bool rests() const { return value == 0 && speed == 0; }
};

}  // namespace fragmotion
