// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace fragmotion {

/// Bones are kept in blocks of so many, x, y and z apart, for the sake of vector instructions.
constexpr int kBoneBlock = 8;

/// Lets the memory of objects that are needed soon be on its way to the processor.
template <typename T>
void prefetch(const T* objects, std::size_t count) {
#ifdef __GNUC__
  constexpr std::size_t kLine = 64;
  const auto* bytes = reinterpret_cast<const char*>(objects);
  for (std::size_t at = 0; at < count * sizeof(T); at += kLine) __builtin_prefetch(bytes + at, 1);
#else
  static_cast<void>(objects), static_cast<void>(count);
#endif
}

}  // namespace fragmotion
