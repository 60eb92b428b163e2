// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace fragmotion {

constexpr std::uint64_t kFnvSeed = 0xcbf29ce484222325ULL, kFnvPrime = 0x100000001b3ULL;

/// FNV-1a (Fowler, Noll, Vo) of bytes after those that gave `hash`.
inline std::uint64_t fnv1a(const void* bytes, std::size_t size, std::uint64_t hash = kFnvSeed) {
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * kFnvPrime;
  return hash;
}

}  // namespace fragmotion
