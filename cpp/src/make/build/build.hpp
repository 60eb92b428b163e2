// SPDX-License-Identifier: MIT
#pragma once

#include "base/progress.hpp"
#include "build/find_controls.hpp"
#include "character/character.hpp"
#include "control/trace.hpp"
#include "fragments/cutting.hpp"

namespace fragmotion {

/// All that a build can be told.
struct BuildOptions {
  CutOptions cut;
  ControlOptions controls;
  bool mirror = true;      ///< Add the mirror image of every take.
  bool synthesize = true;  ///< Fill the controls that the takes lack.
  int classes = 97;        ///< 1 .. kMostClasses; fewer where there are fewer distinct fragments.
  /// Clusterings, of which the one that serves Optimal best on the traces is taken: up to kMostRestarts; at least 1 is
  /// made.
  int restarts = 8;
  std::uint64_t seed = 1;
  /// Of policy_names(); the first one drives, the others are there to be compared.
  std::vector<std::string> policies{"anticipate", "iterate", "svm", "greedy"};
  int threads = 0;  ///< 0 or less: as many as the machine has. The result does not depend on it.
};

/// The policies that build() knows.
const std::vector<std::string>& policy_names();

/// Clips to a character: fragments, synthesis, classes, Eq. 2, policy. `traces` teach the policy. A short clip that is
/// a cycle (cycle_of()) is gone through again and again.
/// Deterministic: the same input gives the same bits, whatever the number of threads.
/// Skeleton and clips need not have been through make_skeleton and make_clip, and are refused as by them. Throws
/// std::invalid_argument also where there is nothing to build from, no trace, a trace of one control or with one that
/// is not a number, an option out of its range, a character of no stature (check_stature), or an unknown policy;
/// Cancelled where the progress callback says so.
Character build(const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                const BuildOptions& options = {}, const Progress& progress = {});

/// find_plants() of all clips of a pool; those that are made stand on the usual floors of the takes.
std::vector<Contacts> contacts_of(const FragmentPool& pool, int threads = 0);

}  // namespace fragmotion
