// SPDX-License-Identifier: MIT
#pragma once

#include "workload.hpp"

namespace fragmotion::benchmarks {

/// Any number of made fragments: the workload's, each in variations.
struct LargePool {
  LargePool(const Workload& w, int count);

  std::vector<Fragment> fragments;
  Trajectories trajectories;
};

/// What a build does once its fragments are measured: classes (the restart that serves Optimal best), Eq. 2, policy.
Policy built_policy(const LargePool& large, const Workload& w);

}  // namespace fragmotion::benchmarks
