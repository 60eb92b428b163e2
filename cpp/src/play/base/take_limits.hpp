// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace fragmotion {

// What a skeleton and a motion capture file may hold at most: no real one comes near, and a small one cannot take all
// memory.
constexpr std::size_t kMostBones = 4096;   ///< The largest rigs, with every control, have some 2,000.
constexpr std::size_t kLongestName = 255;  ///< Bytes of a bone's name: Blender allows 63.
constexpr double kLargestNumber = 1e12;    ///< Of file units or degrees: a million km in millimetres.
constexpr double kFarthestBody = 1e6;      ///< Metres that it is from the origin: no stage is so large.
constexpr double kFastestBody = 1000;      ///< m/s: three times as fast as sound.
constexpr double kShortestFrame = 1e-4;    ///< Seconds: motion capture is made at up to some 2,000 frames a second.
constexpr double kLongestFrame = 1000;     ///< Seconds.

/// Poses of a bone (56 bytes each) that a file of so many bytes may make: 28 MB of them whatever it holds, and 14 times
/// its size. A joint of three numbers takes six bytes at the least and some twenty in real files, so that only joints
/// that never move, which frames do not tell, can make more.
constexpr std::size_t most_poses(std::size_t file_bytes) { return 500000 + file_bytes / 4; }

}  // namespace fragmotion
