// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>

#include "add_bone.hpp"
#include "character/character.hpp"
#include "fragments/distance.hpp"
#include "fragments/entry_poses.hpp"
#include "fragments/packed_pool.hpp"
#include "policy/bridge.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {

/// A skeleton each of whose bones is two, one behind the other, but head, hands and feet, which are what they were: the
/// same body with other bones.
struct SplitBones {
  Skeleton skeleton;
  std::vector<int> first, second;  // of each bone that there was; the same where it is one

  explicit SplitBones(const Skeleton& s) {
    const Roles& r = s.roles;
    for (int b = 0; b < s.size(); ++b) {
      const int ends[] = {r.head, r.left_hand, r.right_hand, r.left_foot, r.right_foot, r.left_toe, r.right_toe};
      const bool splits = std::find(std::begin(ends), std::end(ends), b) == std::end(ends);
      const int parent = s.parents[b];
      const bool at_tip = parent >= 0 && s.offsets[b].isApprox(s.tips[parent]);
      const int above = parent < 0 ? -1 : at_tip ? second[parent] : first[parent];
      const Vector3 offset = at_tip && second[parent] != first[parent] ? Vector3(s.offsets[b] / 2) : s.offsets[b];
      const Vector3 tip = splits ? Vector3(s.tips[b] / 2) : s.tips[b];
      first.push_back(add(s.names[b], above, s.rest_rotations[b], offset, tip));
      second.push_back(splits ? add("half " + s.names[b], first[b], Quaternion::Identity(), tip, tip) : first[b]);
    }
    for (auto role : {&Roles::hips, &Roles::head, &Roles::left_hand, &Roles::right_hand, &Roles::left_foot,
                      &Roles::right_foot, &Roles::left_thigh, &Roles::right_thigh}) {
      skeleton.roles.*role = r.*role < 0 ? -1 : first[r.*role];
    }
    skeleton = make_skeleton(std::move(skeleton));
  }

  Clip operator()(const Clip& clip) const {
    Clip result{clip.name, clip.rate, clip.frames, clip.root_positions, {}, {}};
    for (const double* q = clip.rotations.data(); q < clip.rotations.data() + clip.rotations.size();) {
      for (std::size_t b = 0; b < first.size(); ++b, q += 4) {
        result.rotations.insert(result.rotations.end(), q, q + 4);
        if (second[b] != first[b]) result.rotations.insert(result.rotations.end(), {1, 0, 0, 0});
      }
    }
    return make_clip(skeleton, std::move(result));
  }

 private:
  int add(const std::string& name, int parent, const Quaternion& rest, const Vector3& offset, const Vector3& tip) {
    return add_bone(skeleton, name, parent, offset, tip, rest);
  }
};

/// The same character, with the same fragments in the same classes, on the skeleton of its SplitBones.
inline std::shared_ptr<const Character> with_split_bones(const Character& character) {
  const SplitBones split(character.pool.skeleton);
  FragmentPool pool{split.skeleton, {}, character.pool.fragments};
  for (const PackedClip& clip : character.pool.clips) pool.clips.push_back(split(unpack(clip)));
  auto result = std::make_shared<Character>(character);
  result->pool = pack(pool);
  result->legs = resting_legs(split.skeleton);
  result->entry_poses = entry_poses(result->pool);
  measure_looks_and_arms(*result);
  result->bridges = stand_bridges(pool.fragments, trajectories(result->pool, 2), character.classes, character.space);
  return result;
}

}  // namespace fragmotion
