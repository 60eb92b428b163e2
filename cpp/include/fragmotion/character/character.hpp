// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fragmotion/base/progress.hpp"
#include "fragmotion/control/trace.hpp"
#include "fragmotion/fragments/coverage.hpp"
#include "fragmotion/motion/contacts.hpp"
#include "fragmotion/motion/packed_clip.hpp"
#include "fragmotion/policy/policy.hpp"
#include "fragmotion/skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// What a policy file holds and a player plays: fragments, their classes and the control policy table.
struct Character {
  PackedPool pool;
  ControlSpace space;
  Classes classes;
  Quality quality;
  std::vector<Policy> policies;  ///< The first one drives.
  std::vector<int> bridges;      ///< [classes, classes]: stand_bridges().
  /// [102, 102]: control_model() of the traces that taught the policies, with kAnyPlayer.
  std::vector<double> control_model;
  Coverage coverage;
  std::vector<Contacts> contacts;        ///< Of each clip of the pool.
  Legs legs;                             ///< As they bend in the clips.
  std::vector<float> openings;           ///< openings() of the fragments.
  std::map<std::string, double> report;  ///< Figures of the build: counts, and seconds of each stage. Not saved.

  /// The policy of that name, or the one that drives where the name is empty. Throws std::invalid_argument listing
  /// those that there are.
  const Policy& policy(const std::string& name = {}) const;
};

/// All that a build can be told.
struct BuildOptions {
  CutOptions cut;
  bool mirror = true;      ///< Add the mirror image of every take.
  bool synthesize = true;  ///< Fill the controls that the takes lack.
  int classes = 97;        ///< 1 .. kMostClasses
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

/// The control space of a set of evident controls (in the default space): the speeds are the means of the two gaits
/// that the fragments fall into, the turn rate the upper quartile of those that turn; the defaults where the fragments
/// show none.
ControlSpace control_space_of(const std::vector<Control>& evident, double scale);

/// Clips to a character: fragments, synthesis, classes, Eq. 2, policy. `traces` teach the policy.
/// Deterministic: the same input gives the same bits, whatever the number of threads.
/// Skeleton and clips need not have been through make_skeleton and make_clip, and are refused as by them. Throws
/// std::invalid_argument also where there is nothing to build from, fewer distinct fragments than classes, no trace, a
/// trace of one control or with one that is not a number, an option out of its range, a character of no stature
/// (check_stature), or an unknown policy; Cancelled where the progress callback says so.
Character build(const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                const BuildOptions& options = {}, const Progress& progress = {});

/// The contacts of all clips of a pool.
std::vector<Contacts> contacts_of(const FragmentPool& pool, int threads = 0);

/// The indices of the points of the space nearest to a trace's controls.
std::vector<int> snap(const ControlSpace& space, const Trace& trace);

}  // namespace fragmotion
