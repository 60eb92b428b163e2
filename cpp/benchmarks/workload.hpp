// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "character/character.hpp"
#include "classes/clustering.hpp"
#include "control/trace.hpp"

namespace fragmotion::benchmarks {

constexpr int kFragments = 1784;  ///< The paper's number (Sec. 4).
constexpr int kSamples = 600;     ///< Controls of the trace that teaches: a minute.

/// What the benchmarks work on: the paper's numbers of fragments, classes, controls and samples.
struct Workload {
  std::vector<Clip> takes;  ///< So many that a build of them has at least kFragments fragments.
  Trace trace;
  std::vector<int> controls;               ///< The trace in the character's control space.
  std::shared_ptr<const Character> built;  ///< From all of the takes.

  PackedPool pool;  ///< The first kFragments of `built`; the stages are measured on these.
  Trajectories trajectories;
  std::vector<float> weights;
  Classes classes;
  Quality quality;
  std::vector<double> features;
};

/// How a build clusters by default.
ClusterOptions clustering();

/// The workload, made when first asked for.
const Workload& workload();

/// The workload as NumPy arrays, one NAME.npy each, in a folder that exists.
void dump(const Workload& workload, const std::filesystem::path& folder);

}  // namespace fragmotion::benchmarks
