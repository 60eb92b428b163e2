// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "character/move.hpp"
#include "classes/classes.hpp"
#include "control/control.hpp"
#include "fragments/arm_range.hpp"
#include "fragments/fragment.hpp"
#include "fragments/look.hpp"
#include "fragments/speed_range.hpp"
#include "motion/contacts.hpp"
#include "policy/policy.hpp"
#include "policy/quality.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {

/// What a policy file holds and a player plays: fragments, their classes and the control policy table.
struct Character {
  PackedPool pool;
  ControlSpace space;
  Classes classes;
  Quality quality;
  std::vector<Policy> policies;  ///< The first one drives.
  std::vector<int> bridges;      ///< [classes, classes]: stand_bridges().
  /// [controls, controls]: control_model() of the traces that taught the policies, with kGenericPrior.
  std::vector<double> control_model;
  std::vector<Contacts> contacts;  ///< Of each clip of the pool: contacts_of(); of a move, find_plants().
  Legs legs;                       ///< As they bend in the clips.
  Looks looks;                     ///< looks_in() all its styles.
  std::array<ArmRange, 2> arms;    ///< arm_ranges(), likewise.
  std::vector<Move> moves;         ///< Their clips are the pool's last ones.
  std::string style;               ///< What its takes have in common; empty where there is one style alone.
  /// In its other styles, on the same skeleton: each a character without moves and further styles.
  std::vector<std::shared_ptr<const Character>> styles;
  std::vector<float> entry_poses;        ///< entry_poses() of the fragments. Not saved.
  std::vector<Fragment> move_parts;      ///< move_parts() of the moves. Not saved.
  SpeedRange speeds;                     ///< Of the fragments. Not saved.
  std::map<std::string, double> report;  ///< Figures of the build: counts, and seconds of each stage. Not saved.

  /// The policy of that name, or the one that drives where the name is empty. Throws std::invalid_argument listing
  /// those that there are.
  const Policy& policy(const std::string& name = {}) const;

  /// What it does of a control: without a turn or a jump where none can be asked for, and no faster than its takes.
  Control admitted(const Control& control) const { return speeds.within(space.admitted(control)); }

  /// What is played by a number: a fragment, or after the last of them a part of a move.
  const Fragment& played(int number) const {
    const int part = number - static_cast<int>(pool.fragments.size());
    return part < 0 ? pool.fragments[number] : move_parts[part];
  }
  /// The number of a move's part.
  int number_of(int move, MovePart part) const {
    return static_cast<int>(pool.fragments.size()) + kMoveParts * move + static_cast<int>(part);
  }
  /// Its styles, of which the first is its own.
  int style_count() const { return 1 + static_cast<int>(styles.size()); }
  const Character& in_style(int style) const { return style == 0 ? *this : *styles[style - 1]; }
  /// The clips that are not of moves.
  int takes() const { return static_cast<int>(pool.clips.size() - moves.size()); }
};

/// The most styles of a character.
constexpr int kMostStyles = 64;

/// Throws std::invalid_argument on a style that the character does not have.
void check_style(const Character& character, int style);

/// What the representative of each class is evident of.
std::vector<Control> evident_of_classes(const Character& character);

/// Finds what heads and arms do in all its styles.
void measure_looks_and_arms(Character& character);

/// repair_policy() and answer_motion() of all its policies; what is repaired stays as it is.
void repair_policies(Character& character);

}  // namespace fragmotion
