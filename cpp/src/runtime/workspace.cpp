// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/workspace.hpp"

#include "fragmotion/fragments/entry_poses.hpp"

namespace fragmotion {

Workspace::Workspace(const Character& character)
    : kinematics(character.pool.skeleton),
      body(std::make_shared<FootLock::Body>(kinematics, character.legs)),
      members(character.classes.members()),
      entry_steps(fragmotion::entry_steps(character)),
      move_entries(entry_poses(character.pool, character.move_parts)),
      tips{BodyTips(character.pool.skeleton), BodyTips(character.pool.skeleton), BodyTips(character.pool.skeleton)},
      onward(character.entry_poses.size() / character.pool.fragments.size()) {
  candidates.reserve(character.pool.fragments.size());
  shown.rotations.resize(std::size_t{4} * kinematics.bones());
  poses.fill(shown);
}

}  // namespace fragmotion
