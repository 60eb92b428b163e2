// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "api/calls.hpp"
#include "base/fnv.hpp"
#include "base/types.hpp"

namespace fragmotion {

// Archives of a player's state. They share their spelling, so that one function says what a state holds and in which
// order, and what each number may be: told() passes a number on that others depend on, number() one that is kept. All
// are words of 8 bytes, little-endian; a stranger's bytes are read by StateChecker at first, which keeps nothing.

/// Counts, hashes, and writes where there is somewhere to write to.
class StateWriter {
 public:
  static constexpr bool kKeeps = false;

  explicit StateWriter(unsigned char* to = nullptr) : to_(to) {}

  template <typename T>
  T told(T value, double /*least*/, double /*most*/) {
    put(value);
    return value;
  }
  template <typename T>
  void number(const T& value, double /*least*/, double /*most*/) {
    put(value);
  }
  void floats(const float* values, std::size_t count) {
    for (std::size_t i = 0; i < count; i += 2) word(values + i);
  }
  template <typename T>
  void bits(const T& value) {
    static_assert(sizeof(T) == 8);
    word(&value);
  }
  /// What must be the same in a player that reads it; `what`: what the state is of, else.
  void same(std::uint64_t value, const char* /*what*/) { word(&value); }

  std::size_t size() const { return size_; }
  std::uint64_t hash() const { return hash_; }

 private:
  template <typename T>
  void put(const T& value) {
    const auto wide = static_cast<std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>>(value);
    word(&wide);
  }
  void word(const void* bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, 8);
    if (to_ != nullptr) std::memcpy(to_ + size_, &word, 8);
    hash_ = (hash_ ^ word) * 0x9e3779b97f4a7c15ULL;
    hash_ ^= hash_ >> 32;
    size_ += 8;
  }

  unsigned char* to_;
  std::size_t size_ = 0;
  std::uint64_t hash_ = kFnvSeed;
};

/// Reads what a StateWriter wrote. Throws CallError where it ends too early or a number is out of its range.
template <bool Keeps>
class StateReaderThat {
 public:
  static constexpr bool kKeeps = Keeps;

  StateReaderThat(const unsigned char* bytes, std::size_t size) : bytes_(bytes), left_(size) {}

  template <typename T>
  T told(T /*value*/, double least, double most) {
    std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t> wide;
    take(&wide);
    const auto number = static_cast<double>(wide);
    demand(number >= least && number <= most, FRAGMOTION_ERROR_REFUSED,
           "the state holds a number that cannot be: %g, where %g to %g can", number, least, most);
    return static_cast<T>(wide);
  }
  template <typename T>
  void number(T& value, double least, double most) {
    const T found = told(value, least, most);
    if constexpr (Keeps) value = found;
  }
  void floats(float* values, std::size_t count) {
    for (std::size_t i = 0; i < count; i += 2) {
      float pair[2];
      take(pair);
      for (const float value : pair) {
        demand(std::abs(value) <= 1e6F, FRAGMOTION_ERROR_REFUSED, "the state holds what is not a number");
      }
      if constexpr (Keeps) std::memcpy(values + i, pair, 8);
    }
  }
  template <typename T>
  void bits(T& value) {
    static_assert(sizeof(T) == 8 && std::is_trivially_copyable_v<T>);
    std::uint64_t word = 0;
    take(&word);
    if constexpr (Keeps) std::memcpy(static_cast<void*>(&value), &word, 8);
  }
  void same(std::uint64_t value, const char* what) {
    std::uint64_t found = 0;
    take(&found);
    demand(found == value, FRAGMOTION_ERROR_REFUSED, "the state is %s", what);
  }

  bool done() const { return left_ == 0; }

 private:
  void take(void* word) {
    demand(left_ >= 8, FRAGMOTION_ERROR_REFUSED, "the state ends too early");
    std::memcpy(word, bytes_, 8);
    bytes_ += 8;
    left_ -= 8;
  }

  const unsigned char* bytes_;
  std::size_t left_;
};

using StateChecker = StateReaderThat<false>;
using StateReader = StateReaderThat<true>;

}  // namespace fragmotion
