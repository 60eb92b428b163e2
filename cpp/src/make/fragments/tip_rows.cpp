// SPDX-License-Identifier: MIT
#include "fragments/tip_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "base/ranges.hpp"
#include "base/vectorised.hpp"

namespace fragmotion {
namespace {

constexpr float kMost = 32767;  // units

// The largest absolute value, by the floats' bits, among which what is no number is above all others.
FRAGMOTION_VECTORISED float largest_of(const float* values, std::size_t count) {
  std::int32_t largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::int32_t bits = 0;
    std::memcpy(&bits, values + i, sizeof bits);
    largest = std::max(largest, bits & 0x7fffffff);
  }
  float value = 0;
  std::memcpy(&value, &largest, sizeof value);
  return value;
}

// To the nearest.
FRAGMOTION_VECTORISED void in_units(const float* from, std::size_t count, float unit, std::int16_t* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const float value = from[i] / unit;
    to[i] = static_cast<std::int16_t>(static_cast<int>(value + std::copysign(0.5F, value)));
  }
}

// Sums over so many lanes are of the same bits with any instructions.
FRAGMOTION_VECTORISED float distance_of(const std::int16_t* a, float unit, const float* b, int stride) {
  float sums[TipRows::kBlock] = {};
  for (int i = 0; i < stride; i += TipRows::kBlock) {
    for (int lane = 0; lane < TipRows::kBlock; ++lane) {
      const int x = i + lane, y = x + stride, z = y + stride;
      const float dx = unit * a[x] - b[x], dy = unit * a[y] - b[y], dz = unit * a[z] - b[z];
      sums[lane] += std::sqrt(dx * dx + dy * dy + dz * dz);
    }
  }
  for (int lane = 0; lane < TipRows::kBlock / 2; ++lane) sums[lane] += sums[lane + TipRows::kBlock / 2];
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace

TipRows::TipRows(int count, int points)
    : stride_((points + kBlock - 1) / kBlock * kBlock), units_(count, 0), values_(count * width(), 0) {}

void TipRows::resize(int count) {
  units_.resize(count, 0);
  values_.resize(count * width(), 0);
}

void TipRows::set(int i, const float* from) {
  const float largest = largest_of(from, width());
  if (!(largest <= kFarthestPlace)) {
    throw std::invalid_argument("fragment " + std::to_string(i) +
                                ": a coordinate is not a number, or more than a million kilometres");
  }
  int exponent = 0;
  std::frexp(largest / kMost, &exponent);
  units_[i] = std::ldexp(1.0F, exponent);
  in_units(from, width(), units_[i], &values_[i * width()]);
}

std::vector<float> TipRows::values() const {
  std::vector<float> values;
  values.reserve(values_.size());
  for (int i = 0; i < count(); ++i) {
    const std::vector<float> row = read(i);
    values.insert(values.end(), row.begin(), row.end());
  }
  return values;
}

std::vector<float> TipRows::read(int i) const {
  std::vector<float> values(row(i), row(i) + width());
  for (float& value : values) value *= units_[i];
  return values;
}

TipRows TipRows::some(const std::vector<int>& fragments) const {
  TipRows chosen(static_cast<int>(fragments.size()), stride_);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    chosen.units_[i] = units_[fragments[i]];
    std::copy_n(row(fragments[i]), width(), &chosen.values_[i * width()]);
  }
  return chosen;
}

float TipRows::distance(int i, const float* to) const { return distance_of(row(i), units_[i], to, stride_); }

float TipRows::rounding() const {
  return units_.empty() ? 0 : 2 * static_cast<float>(stride_) * *std::max_element(units_.begin(), units_.end());
}

}  // namespace fragmotion
