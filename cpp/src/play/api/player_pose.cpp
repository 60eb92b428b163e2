// SPDX-License-Identifier: MIT
#include <algorithm>

#include "api/handles.hpp"
#include "api/transforms.hpp"

using namespace fragmotion;

void FragmotionPlayer::world(const Shown& pose) const {
  PosedBones& posed = scratch->posed;
  hero->kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
}

// Of all bones of the character.
const std::vector<FragmotionTransform>& FragmotionPlayer::bones(FragmotionSpace space) const {
  const Shown& pose = shown();
  const Skeleton& skeleton = hero->skeleton();
  const Axes& axes = hero->axes;
  const std::vector<Vector3>& heads = scratch->posed.heads;
  const std::vector<Quaternion>& rotations = scratch->posed.rotations;
  std::vector<FragmotionTransform>& all = scratch->bones;
  world(pose);
  const Quaternion back = pose.frame.rotation().conjugate(), turn = CharacterFrame{{0, 0}, shift.heading}.rotation();
  const auto model = [&](int b) {
    const Vector3 from = heads[b] - Vector3{pose.frame.position.x(), pose.frame.position.y(), pose.level};
    return axes.global(back * from, back * rotations[b]);
  };
  for (int b = 0; b < hero->bones(); ++b) {
    const int parent = skeleton.parents[b];
    if (space == FRAGMOTION_SPACE_WORLD) {
      all[b] = axes.global(shift.place(heads[b]), shift.none ? rotations[b] : turn * rotations[b]);
    } else if (space == FRAGMOTION_SPACE_MODEL || parent < 0) {
      all[b] = model(b);
    } else if (hero->carried[b]) {
      const Quaternion above = rotations[parent].conjugate();
      all[b] = axes.local(above * (heads[b] - heads[parent]), above * rotations[b]);
    } else {
      all[b] = axes.local(skeleton.offsets[b], load_quaternion(&pose.rotations[std::size_t{4} * b]));
    }
  }
  return all;
}

void FragmotionPlayer::pose(const FragmotionRig* rig, FragmotionSpace space, FragmotionTransform* out) const {
  const bool fills = rig != nullptr && !rig->rest.empty() && !rig->parents.empty(),
             relates = fills && space == FRAGMOTION_SPACE_LOCAL && !rig->same_parents;
  const std::vector<FragmotionTransform>& all = bones(relates ? FRAGMOTION_SPACE_MODEL : space);
  if (rig == nullptr) {
    std::copy(all.begin(), all.end(), out);
    return;
  }
  for (std::size_t i = 0; i < rig->bones.size(); ++i) {
    const int bone = rig->bones[i];
    if (bone >= 0) {
      out[i] = all[bone];
    } else if (fills) {
      const bool alone = rig->parents[i] < 0 || (space == FRAGMOTION_SPACE_LOCAL && !relates);
      out[i] = alone ? rig->rest[i] : compose(out[rig->parents[i]], rig->rest[i]);
    }
  }
  if (!relates) return;
  for (std::size_t i = rig->bones.size(); i-- > 0;) {
    if (rig->parents[i] >= 0) out[i] = compose(inverse(out[rig->parents[i]]), out[i]);
  }
}

void FragmotionPlayer::skinning(const FragmotionRig& rig, FragmotionSpace space, float* matrices) const {
  const std::vector<FragmotionTransform>& all = bones(space);
  const bool fills = !rig.rest.empty() && !rig.parents.empty();
  // What of the rig is posed is kept as matrices at first, so that nothing more is needed for bones that rest.
  for (std::size_t i = 0; i < rig.bones.size(); ++i) {
    float* out = matrices + 16 * i;
    if (rig.bones[i] >= 0) {
      const Matrix16 posed = matrix_of(all[rig.bones[i]]);
      std::copy(posed.begin(), posed.end(), out);
    } else if (fills) {
      Matrix16 above{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
      if (rig.parents[i] >= 0) std::copy_n(matrices + 16 * rig.parents[i], 16, above.begin());
      multiply(above, matrix_of(rig.rest[i]), out);
    }
  }
  for (std::size_t i = 0; i < rig.bones.size(); ++i) {
    if (rig.bones[i] < 0 && !fills) continue;
    Matrix16 posed;
    std::copy_n(matrices + 16 * i, 16, posed.begin());
    multiply(posed, rig.inverse[i], matrices + 16 * i);
  }
}
