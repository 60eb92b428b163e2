// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "character/character.hpp"
#include "fragments/distance.hpp"

namespace fragmotion {

/// A class that might be played next, and what speaks for it.
struct Alternative {
  int next = 0;
  double smoothness = 0;    ///< First factor of Eq. 2.
  double match = 0;         ///< Second factor of Eq. 2.
  double future_value = 0;  ///< Eq. 2 expected of all later steps, discounted, if the policy goes on from there.
  std::vector<int>
      fragments;  ///< Up to kNearest of its fragments: those of the greatest Eq. 2 of their own, best first.

  double value() const { return smoothness * match + future_value; }
};

constexpr int kNearest = 3;

/// Why a policy plays what it plays: its choices among all classes, by their value under the character's control model.
/// Evaluates the policy once, when it is made; a table that looks ahead well chooses the first alternative or one near.
class Explainer {
 public:
  /// `policy` as Character::policy's.
  explicit Explainer(std::shared_ptr<const Character> character, const std::string& policy = {});

  /// All classes after `from` under a control index, the greatest value first; ties by number. Throws
  /// std::invalid_argument on a class or control that does not exist.
  std::vector<Alternative> operator()(int from, int control) const;

  const Policy& policy() const { return policy_; }

 private:
  std::vector<int> nearest(int from, int next, int control) const;

  std::shared_ptr<const Character> character_;
  const Policy& policy_;
  Trajectories poses_;
  std::vector<std::vector<int>> members_;
  std::vector<double> future_value_;  // [controls, classes]
};

}  // namespace fragmotion
