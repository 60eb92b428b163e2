// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "control/control_layout.hpp"

namespace fragmotion {

/// What a speed is called.
struct Gait {
  const char* name;  ///< "walk"
  const char* jump;  ///< What a jump at that speed is called: "running jump".
  double speed;      ///< As it is usual, m/s of a character of 1.8 m.
};

/// From the slowest.
constexpr Gait kGaits[] = {{"stroll", "strolling jump", 0.7},
                           {"walk", "jump", 1.2},
                           {"jog", "jogging jump", 2.2},
                           {"run", "running jump", 3.3},
                           {"sprint", "sprinting jump", 5}};

/// What the directions are called, counter-clockwise from forward.
constexpr const char* kDirectionNames[kMostDirections] = {
    "forward", "forward slightly left",  "forward left",  "left slightly forward",
    "left",    "left slightly back",     "back left",     "back slightly left",
    "back",    "back slightly right",    "back right",    "right slightly back",
    "right",   "right slightly forward", "forward right", "forward slightly right"};

/// Of kGaits.
constexpr int kWalk = 1, kJog = 2, kRun = 3;

/// One of the ascending `slots` for each of as many or fewer ascending values > 0, in their order: those with which the
/// product of the ratios of value and slot, the greater over the smaller, is least.
std::vector<int> matched(const std::vector<double>& values, const std::vector<double>& slots);

/// The gaits that up to kMostSpeeds ascending speeds are, m/s of a character of 1.8 m: numbers into kGaits. Two are a
/// walk and a run (Sec. 4), others the nearest.
std::vector<int> gaits_of(const std::vector<double>& speeds);

}  // namespace fragmotion
