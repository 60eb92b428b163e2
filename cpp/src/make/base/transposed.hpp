// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace fragmotion {

/// The rows of an array [rows, columns] as columns: [columns, rows].
template <typename T>
std::vector<T> transposed(const std::vector<T>& values, int rows, int columns) {
  std::vector<T> result;
  result.reserve(values.size());
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) result.push_back(values[static_cast<std::size_t>(row) * columns + column]);
  }
  return result;
}

}  // namespace fragmotion
