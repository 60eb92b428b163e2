// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace fragmotion {

/// Bones are kept in blocks of so many, x, y and z apart, for the sake of vector instructions.
constexpr int kBoneBlock = 8;

/// Lets the memory from one address up to another, which is needed soon, be on its way to the processor.
inline void prefetch_between(const void* first, const void* end) {
#ifdef __GNUC__
  constexpr std::size_t kLine = 64;
  for (const auto* at = static_cast<const char*>(first); at < end; at += kLine) __builtin_prefetch(at, 1);
#else
  static_cast<void>(first), static_cast<void>(end);
#endif
}

/// Likewise that of objects.
template <typename T>
void prefetch(const T* objects, std::size_t count) {
  prefetch_between(objects, objects + count);
}

}  // namespace fragmotion
