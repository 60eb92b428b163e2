// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "fragments/body_tips.hpp"

namespace fragmotion {

/// Bone tips as Dis sees them, x, y and z each in a row, of many fragments, in 16 bits: each coordinate is a whole
/// number of its fragment's unit, the least power of two by which they fit, and so at most half a unit off: .06 mm
/// where a fragment goes up to 4 m. How far one goes does not blur another, and what was rounded is a float without
/// rounding.
class TipRows {
 public:
  static constexpr int kBlock = 16;  ///< Rows are padded with zeros to whole blocks.

  TipRows() = default;
  /// So many fragments of so many points, all 0.
  TipRows(int count, int points);

  int count() const { return static_cast<int>(units_.size()); }
  int stride() const { return stride_; }                          ///< Coordinates in a row.
  std::size_t width() const { return std::size_t{3} * stride_; }  ///< Coordinates of a fragment.

  /// Drops the last fragments, or adds such of which all coordinates are 0.
  void resize(int count);

  /// Takes a fragment's coordinates [3, stride], in m. Throws std::invalid_argument on one that is not a number, or is
  /// more than a million kilometres.
  void set(int i, const float* from);
  /// The coordinates [count, 3, stride] of all fragments, in m, and those of one.
  std::vector<float> values() const;
  std::vector<float> read(int i) const;
  /// The same, in units of the fragment.
  const std::int16_t* row(int i) const { return &values_[i * width()]; }
  float unit(int i) const { return units_[i]; }  ///< m
  /// Rows of some of the fragments.
  TipRows some(const std::vector<int>& fragments) const;

  /// tip_distance() of a fragment to coordinates [3, stride].
  float distance(int i, const float* to) const;
  /// What being off may add to the distance of any fragment to a mean of some.
  float rounding() const;

  bool operator==(const TipRows& other) const { return units_ == other.units_ && values_ == other.values_; }

 private:
  int stride_ = 0;
  std::vector<float> units_;          // [count]
  std::vector<std::int16_t> values_;  // [count, 3, stride]
};

}  // namespace fragmotion
