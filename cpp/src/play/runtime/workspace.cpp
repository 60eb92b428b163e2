// SPDX-License-Identifier: MIT
#include "runtime/workspace.hpp"

#include <algorithm>
#include <utility>

#include "fragments/entry_poses.hpp"
#include "fragments/look.hpp"
#include "fragments/successors.hpp"
#include "runtime/held_gaits.hpp"

namespace fragmotion {
Workspace::Workspace(const Character& character, const PlayerConstants& constants)
    : constants(constants),
      settles(constants.root.settles),
      follows(constants.lean.follows),
      release(constants.feet.release),
      kinematics(character.pool.skeleton),
      body(std::make_shared<FootLock::Body>(kinematics, character.legs, constants.feet)),
      floors(usual_floors(character.contacts)),
      look(look_bones(kinematics.skeleton())),
      fastest_looks(character.looks.fastest),
      gaze(character.looks.gaze),
      trunk(kinematics.skeleton()),
      arms(character.arms),
      move_entries(entry_poses(character.pool, character.move_parts)),
      tips{BodyTips(character.pool.skeleton), BodyTips(character.pool.skeleton), BodyTips(character.pool.skeleton)},
      onward(character.entry_poses.size() / character.pool.fragments.size()),
      unpacked(character.pool.skeleton.size()) {
  std::size_t most = 0;
  std::vector<FragmentLists> lists;
  for (int style = 0; style < character.style_count(); ++style) {
    const Character& c = character.in_style(style);
    TransitionCost cost(c, constants.transition);
    std::vector<int> next = successors(c.pool.fragments);
    std::vector<EntrySteps> steps = entry_steps(c, next);
    const auto variety = static_cast<float>(constants.transition.variety);
    const std::vector<std::vector<int>> gaits = held_gaits(c, cost, next, steps, variety),
                                        classes = c.classes.members();
    std::vector<Entrants> members(classes.size() + gaits.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
      const bool is_gait = k >= classes.size();
      const std::vector<int>& each = is_gait ? gaits[k - classes.size()] : classes[k];
      if (!each.empty()) members[k] = cost.entrants(each, is_gait ? each.front() : c.classes.representatives[k]);
    }
    lists.push_back({&c, std::move(members), std::move(steps), std::move(cost), step_seconds(c), std::move(next)});
    most = std::max(most, c.pool.fragments.size());
  }
  styles = std::make_shared<const std::vector<FragmentLists>>(std::move(lists));
  std::vector<int> hands;
  for (const ArmRange& range : arms) {
    if (range.arm.exists()) hands.push_back(range.arm.hand);
  }
  arm_chains = kinematics.chains(hands);
  if (!look.empty()) head_chain = kinematics.chains({look.back()});
  if (trunk.head >= 0) {
    for (const int b : head_chain) {
      if (kinematics.skeleton().is_below(b, trunk.base) && !kinematics.skeleton().is_below(b, look.front()))
        spine.push_back(b);
    }
  }
  for (Candidates& each : candidates) each.costs.resize(most + kLanes);
  entering.resize(most + kLanes);
  drawn.reserve(most);
  shown.rotations.resize(std::size_t{4} * kinematics.bones());
  poses.fill(shown);
  plain = shown.rotations;
  for (WorldPose& pose : looks) pose.rotations.resize(4 * look.size());
}

Workspace Workspace::another() const {
  Workspace made(*this);
  made.body = std::make_shared<FootLock::Body>(*body);
  made.drawn.reserve(drawn.capacity());
  return made;
}

}  // namespace fragmotion
