// SPDX-License-Identifier: MIT
#include "character/character.hpp"

#include <stdexcept>

#include "base/listed.hpp"
#include "fragments/successors.hpp"
#include "policy/answer.hpp"
#include "policy/repair.hpp"

namespace fragmotion {
namespace {

constexpr int kRounds = 16;  // of repairs: classes that an answer leads to may repair what lacked them; two are usual

}  // namespace

const Policy& Character::policy(const std::string& name) const {
  std::vector<std::string> names;
  for (const Policy& policy : policies) {
    if (name.empty() || policy.name == name) return policy;
    names.push_back(policy.name);
  }
  throw std::invalid_argument("this character has no policy \"" + name + "\"; it has " + listed(names));
}

void check_style(const Character& character, int style) {
  if (style >= 0 && style < character.style_count()) return;
  throw std::invalid_argument("style " + std::to_string(style) + " does not exist; the character has " +
                              std::to_string(character.style_count()));
}

std::vector<Control> evident_of_classes(const Character& character) {
  std::vector<Control> evident;
  for (const int fragment : character.classes.representatives)
    evident.push_back(character.pool.fragments[fragment].evident);
  return evident;
}

// The feet that come down in each class' representative, a bit each; -1 of one that follows itself, which is a cycle.
std::vector<int> strikes_of_classes(const Character& character) {
  const std::vector<Fragment>& fragments = character.pool.fragments;
  const std::vector<int> next = successors(fragments);
  std::vector<int> before;  // the frame that each goes on from, which is another one where a cycle begins anew
  for (const Fragment& f : fragments) before.push_back(f.begin);
  for (std::size_t f = 0; f < next.size(); ++f) {
    if (next[f] >= 0) before[next[f]] = fragments[f].end;
  }
  std::vector<int> strikes;
  for (const int representative : character.classes.representatives) {
    const Fragment& fragment = fragments[representative];
    const Contacts& contacts = character.contacts[fragment.clip];
    strikes.push_back(next[representative] == representative ? -1 : 0);
    for (int foot = 0; foot < kMostLegs; ++foot) {
      bool stands = contacts.stands(foot, before[representative]);
      for (int f = fragment.begin; f <= fragment.end; ++f) {
        strikes.back() |= !stands && contacts.stands(foot, f) ? 1 << foot : 0;
        stands = contacts.stands(foot, f);
      }
    }
  }
  return strikes;
}

void measure_looks_and_arms(Character& character) {
  std::vector<const PackedPool*> pools;
  for (int style = 0; style < character.style_count(); ++style) pools.push_back(&character.in_style(style).pool);
  character.looks = looks_in(pools);
  character.arms = arm_ranges(pools);
}

void repair_policies(Character& character) {
  const std::vector<Control> evident = evident_of_classes(character);
  const std::vector<int> strikes = strikes_of_classes(character);
  for (Policy& policy : character.policies) {
    std::vector<int> before;
    for (int round = 0; round < kRounds && policy.next != before; ++round) {
      before = policy.next;
      repair_policy(policy, character.quality, character.space, evident);
      answer_motion(policy, character.quality, character.space, evident, character.bridges, strikes);
    }
  }
}

}  // namespace fragmotion
