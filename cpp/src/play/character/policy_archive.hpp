// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "base/utf8.hpp"
#include "character/policy_file.hpp"

namespace fragmotion {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "policy files are little-endian");

/// Bits of a packed number at least, so that what it takes of memory has its share of the file.
constexpr int kFewestBits = 2;

/// Of the elements of a list: how many there are is not bounded.
constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

/// Writes the numbers, texts and lists of a policy file in the order in which they are named. Reading is spelled alike
/// (PolicyReader), so that one function, exchange() in policy_content.hpp, says what a file holds.
class PolicyWriter {
 public:
  static constexpr bool kReads = false;
  const std::uint32_t version = kPolicyVersion;
  std::string bytes;

  template <typename T>
  void raw(const T* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  template <typename Stored, typename T>
  void number(const T& value) {
    const auto stored = static_cast<Stored>(value);
    raw(&stored, 1);
  }
  template <typename Stored, typename T>
  void numbers(const std::vector<T>& values) {
    static_assert(std::is_same_v<Stored, T>);
    number<std::uint64_t>(values.size());
    raw(values.data(), values.size());
  }
  // In the fewest bits, but `bits`, that hold the largest of them less the least; lowest bits first.
  template <typename T>
  void packed(const std::vector<T>& values, int bits = kFewestBits) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const std::int64_t low = values.empty() ? 0 : *least, range = values.empty() ? 0 : *most - low;
    while (range >> bits != 0) ++bits;
    number<std::uint64_t>(values.size());
    number<std::int32_t>(low);
    number<std::uint8_t>(bits);
    std::uint64_t word = 0;
    int held = 0;
    for (const T value : values) {
      word |= static_cast<std::uint64_t>(value - low) << held;
      for (held += bits; held >= 8; held -= 8, word >>= 8) number<std::uint8_t>(word & 0xff);
    }
    if (held > 0) number<std::uint8_t>(word);
  }
  void singles(const std::vector<double>& values) {
    number<std::uint64_t>(values.size());
    for (const double value : values) number<float>(value);
  }
  void text(const std::string& value) {
    number<std::uint32_t>(value.size());
    raw(value.data(), value.size());
  }
  // Whether a section follows that only some files have; it begins with its name.
  bool section(const std::string& name, bool wanted) {
    if (wanted) raw(name.data(), name.size());
    return wanted;
  }
  template <typename T, typename Each>
  void list(std::vector<T>& values, std::size_t /*least*/, const Each& each, std::size_t /*most*/ = 0) {
    number<std::uint64_t>(values.size());
    for (T& value : values) each(value);
  }
};

/// Reads a file of `version`. Throws std::invalid_argument where the bytes do not hold what is asked for.
class PolicyReader {
 public:
  static constexpr bool kReads = true;
  const std::uint32_t version;
  PolicyReader(std::uint32_t from_version, const char* data, std::size_t size)
      : version(from_version), data_(data), left_(size) {}

  template <typename Stored, typename T>
  void number(T& value) {
    Stored stored;
    std::memcpy(&stored, take(sizeof(Stored)), sizeof(Stored));
    value = static_cast<T>(stored);
  }
  template <typename Stored, typename T>
  void numbers(std::vector<T>& values) {
    static_assert(std::is_same_v<Stored, T>);
    values.resize(count(sizeof(Stored)));
    if (!values.empty()) std::memcpy(values.data(), take(values.size() * sizeof(T)), values.size() * sizeof(T));
  }
  // Files of before version 5 hold them as they are.
  template <typename T>
  void packed(std::vector<T>& values, int fewest = kFewestBits) {
    if (version < 5) return numbers<T>(values);
    std::uint64_t count = 0;
    std::int64_t low = 0;
    int bits = 0;
    number<std::uint64_t>(count);
    number<std::int32_t>(low);
    number<std::uint8_t>(bits);
    if (bits < fewest || bits > 32) throw std::invalid_argument("its packed numbers have no bits");
    if (count > left_ * 8 / bits) throw std::invalid_argument("it announces more than it holds");
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(take((count * bits + 7) / 8));
    values.resize(count);
    std::uint64_t word = 0;
    int held = 0;
    for (T& value : values) {
      for (; held < bits; held += 8) word |= std::uint64_t{*bytes++} << held;
      const std::int64_t number = low + static_cast<std::int64_t>(word & ((std::uint64_t{1} << bits) - 1));
      if (number > std::numeric_limits<T>::max()) throw std::invalid_argument("its packed numbers are too large");
      value = static_cast<T>(number);
      word >>= bits;
      held -= bits;
    }
  }
  // Doubles in files of before version 5.
  void singles(std::vector<double>& values) {
    values.resize(count(version < 5 ? sizeof(double) : sizeof(float)));
    for (double& value : values) {
      if (version < 5) number<double>(value);
      if (version >= 5) number<float>(value);
      value = static_cast<float>(value);
    }
  }
  void text(std::string& value) {
    std::uint32_t size = 0;
    number<std::uint32_t>(size);
    value = as_utf8(std::string(take(size), size));
  }
  // `least`: bytes that an element takes at the least, and `most`: elements that there may be, so that a count that
  // cannot be is refused before it is believed.
  template <typename T, typename Each>
  void list(std::vector<T>& values, std::size_t least, const Each& each, std::size_t most = kAnyNumber) {
    const std::size_t announced = count(least);
    if (announced > most) throw std::invalid_argument("it announces more than there can be");
    values.resize(announced);
    for (T& value : values) each(value);
  }
  bool section(const std::string& name, bool /*wanted*/) {
    const bool follows = left_ >= name.size() && std::memcmp(data_, name.data(), name.size()) == 0;
    if (follows) take(name.size());
    return follows;
  }
  bool done() const { return left_ == 0; }

 private:
  const char* take(std::size_t size) {
    if (size > left_) throw std::invalid_argument("it ends too early");
    const char* at = data_;
    data_ += size;
    left_ -= size;
    return at;
  }
  std::size_t count(std::size_t least) {
    std::uint64_t count = 0;
    number<std::uint64_t>(count);
    if (count > left_ / least) throw std::invalid_argument("it announces more than it holds");
    return static_cast<std::size_t>(count);
  }

  const char* data_;
  std::size_t left_;
};

}  // namespace fragmotion
