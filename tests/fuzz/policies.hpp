// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "character/policy_bytes.hpp"
#include "character/policy_file.hpp"
#include "fuzzing.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

// Of a policy file's bytes all but a few thousand are the 102 x 102 probabilities of controls. A core is a file's
// payload without them: small enough to keep, and every byte that is changed in it counts.

constexpr std::uint64_t kProbabilities = kPaperPoints * kPaperPoints;
constexpr std::size_t kHeaderBytes = 20, kChecksumBytes = 8;
constexpr int kMostModels = 8;  // that are put into a core: it may be full of what looks like one's size

template <typename T>
std::string bytes_of(const T& value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

// Calls `change` with where each style's probabilities begin or are to begin.
template <typename Change>
void for_each_model(std::string& payload, const Change& change) {
  static const std::string size = bytes_of(kProbabilities);
  std::size_t at = 0;
  for (int models = 0; models < kMostModels && (at = payload.find(size, at)) != std::string::npos; ++models) {
    change(at += size.size());
  }
}

inline std::string core_of(const std::string& file) {
  std::string payload = file.substr(kHeaderBytes, file.size() - kHeaderBytes - kChecksumBytes);
  for_each_model(payload, [&](std::size_t at) { payload.erase(at, sizeof(float) * kProbabilities); });
  return payload;
}

/// The bytes of a model in which a control is followed by itself.
inline const std::string& plain_model() {
  static const std::string model = [] {
    std::string bytes;
    for (std::uint64_t i = 0; i < kProbabilities; ++i) bytes += bytes_of(i % (kPaperPoints + 1) == 0 ? 1.0F : 0.0F);
    return bytes;
  }();
  return model;
}

/// The file with this core, its length and its checksum right.
inline std::string file_with_core(std::string payload) {
  for_each_model(payload, [&](std::size_t& at) {
    payload.insert(at, plain_model());
    at += plain_model().size();
  });
  return "FRAGMOTN" + bytes_of(kPolicyVersion) + bytes_of(std::uint64_t{payload.size()}) + payload +
         bytes_of(policy_checksum(payload));
}

/// Tells at the program's end how often something was done, as libFuzzer tells its figures.
struct Count {
  const char* name;
  long value = 0;

  explicit Count(const char* called) : name(called) {}
  ~Count() { std::fprintf(stderr, "%s: %ld\n", name, value); }
};

/// Grounds that a host may give, by number: level, hills, and such as no ground should be.
inline Ground strange_ground(int number) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  return [number](const Vector3& from) -> std::optional<GroundPoint> {
    const int place = static_cast<int>(std::abs(std::remainder(7 * from.x() + 5 * from.y(), 8.0)));  // 0 .. 4
    switch (number) {
      case 0:
        return GroundPoint{};
      case 1:
        return GroundPoint{0.2 * std::sin(3 * from.x()) + 0.1 * from.y(), {-0.6 * std::cos(3 * from.x()), -0.1, 1}};
      case 2:
        if (place == 0) return std::nullopt;
        return GroundPoint{place == 1 ? std::nan("") : place == 2 ? -kInfinite : 0.3, {0, 0, 1}};
      case 3:
        return GroundPoint{0.1, {place == 1 ? 1.0 : place == 2 ? std::nan("") : 0, 0, place == 3 ? -1.0 : 0}};
      default:
        return GroundPoint{place == 0 ? 1e300 : place == 1 ? -1.7e308 : 1e8 * place, {1e90, -1e-200, 1e-90}};
    }
  };
}

/// Two seconds of play on all kinds of ground, while styles change and moves are held, whose poses must be numbers.
inline void play(Character character) {
  const auto shared = std::make_shared<const Character>(std::move(character));
  const int moves = static_cast<int>(shared->moves.size());
  Player player(shared);
  int part = 0;
  for (const Control& control :
       {Control{}, Control{0, 1.2}, Control{-2, 3, 1}, Control{0, -1.2, -1, 1}, Control{0, 9}}) {
    player.stand_on(strange_ground(part));
    player.change_style((part + 1) / 2 % shared->style_count());
    if (moves > 0 && part % 2 == 0) player.start_move((part / 2) % moves);
    if (moves > 0 && part % 2 == 1) player.release_move((part / 2) % moves);
    for (int frame = 0; frame < 12; ++frame) {
      player.step(control, 1.0 / 30);
      require(player.root_position().allFinite() && all_finite(player.rotations()), "poses are numbers");
      for (const auto& foot : player.standing_feet()) require(!foot || foot->allFinite(), "feet are somewhere");
    }
    ++part;
  }
}

}  // namespace fragmotion
