// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "base/filtered.hpp"
#include "character/character.hpp"
#include "feet/foot_lock.hpp"
#include "fragments/arm_range.hpp"
#include "fragments/body_tips.hpp"
#include "fragments/gaze_range.hpp"
#include "motion/trunk.hpp"
#include "runtime/transition_cost.hpp"

namespace fragmotion {

/// What is looked up of the fragments of one style.
struct FragmentLists {
  const Character* character;           ///< In that style.
  std::vector<Entrants> members;        ///< Of each class, and then of the gait of each control: held_gaits().
  std::vector<EntrySteps> entry_steps;  ///< entry_steps()
  TransitionCost cost;                  ///< Of playing each.
  std::vector<double> step_seconds;     ///< step_seconds()
  std::vector<int> successors;          ///< successors()
};

/// What is known of the costs of a class's Entrants, and which of them is hoped to cost least.
struct Candidates {
  std::vector<float> costs;
  int best = 0;
};

/// What players of one character that step in turn share: what never changes, and room to work in.
struct Workspace {
  /// The character must outlive it.
  explicit Workspace(const Character& character, const PlayerConstants& constants = {});
  /// Room for other players of the character, which may step at the same time: the lists of fragments, which never
  /// change, are shared.
  Workspace another() const;

  PlayerConstants constants;
  Filter settles, follows, release;  ///< Of the constants of these names.

  Kinematics kinematics;
  std::shared_ptr<FootLock::Body> body;
  Floors floors;  ///< The medians of those of the takes.
  std::shared_ptr<const std::vector<FragmentLists>> styles;
  std::vector<int> look;             ///< look_bones()
  std::vector<float> fastest_looks;  ///< Looks::fastest
  GazeRange gaze;
  std::vector<int> head_chain;  ///< From the hips to the head,
  std::vector<int> spine;       ///< and what of it is above the legs and below the look's.
  Trunk trunk;
  std::array<ArmRange, 2> arms;
  std::vector<int> arm_chains;      ///< From the hips to the hands of these.
  std::vector<float> move_entries;  ///< entry_poses() of the moves' parts

  // Of the FragmentSelector's: rows as those of Character::entry_poses.
  std::array<BodyTips, 3> tips;
  std::vector<float> onward;                 ///< Tips of what is shown, and of how it would go on.
  std::array<Candidates, 2> candidates;      ///< Of one class, or of the two that are compared.
  std::vector<double> entering;              ///< Room for TransitionCost::of_entering().
  std::vector<std::pair<float, int>> drawn;  ///< Costs and fragments of those that one is drawn of.

  UnpackedPoses unpacked;          ///< Of all that plays.
  std::vector<double> plain;       ///< Rotations of the head_chain without a stitch.
  WorldPose shown;                 ///< By the player that stepped last.
  std::array<WorldPose, 4> poses;  ///< Of a stitch.
  std::array<WorldPose, 4> looks;  ///< Neck and head in them, as bodies of their own.
};

}  // namespace fragmotion
