// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace fragmotion {

/// The rows of an array [rows, columns] as columns: [columns, rows].
inline std::vector<double> transposed(const std::vector<double>& values, int rows, int columns) {
  std::vector<double> result;
  result.reserve(values.size());
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) result.push_back(values[static_cast<std::size_t>(row) * columns + column]);
  }
  return result;
}

}  // namespace fragmotion
