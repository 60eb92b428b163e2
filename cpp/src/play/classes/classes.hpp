// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace fragmotion {

/// The fragments in n classes Q_1 .. Q_n (Sec. 3.1).
struct Classes {
  int count = 0;
  std::vector<int> labels;           ///< [fragments] class of each
  std::vector<int> representatives;  ///< [count] the medoid: the member nearest to the mean
  double inertia = 0;                ///< Sum over fragments of weight times Dis(f, mean of its class) squared.

  /// The fragments of each class, in order.
  std::vector<std::vector<int>> members() const;
};

}  // namespace fragmotion
