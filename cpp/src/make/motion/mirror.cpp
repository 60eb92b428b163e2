// SPDX-License-Identifier: MIT
#include "motion/mirror.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/decompositions.hpp"
#include "motion/fingers.hpp"
#include "motion/pose.hpp"
#include "skeleton/role_map.hpp"

namespace fragmotion {
namespace {

using Matrix3 = Eigen::Matrix3d;

const Matrix3 kReflection = Vector3{-1, 1, 1}.asDiagonal();
constexpr double kSymmetric = 0.03;          // of the stature
const double kSnap = 1 + 2 * std::cos(0.5);  // trace of a rotation by 0.5 rad (29 degrees)

struct Pose {
  std::vector<Vector3> heads;
  std::vector<Quaternion> orientations;
  explicit Pose(int bones) : heads(bones), orientations(bones) {}
};

// World orientations of the rest pose in its character frame, or nothing where that pose is not symmetric.
std::vector<Matrix3> symmetric_rest(const Kinematics& kinematics, const std::vector<int>& counterpart) {
  const Skeleton& skeleton = kinematics.skeleton();
  Pose pose(kinematics.bones());
  rest_pose(skeleton, pose.heads, pose.orientations);
  const CharacterFrame& frame = kinematics.rest_frame();
  const double tolerance = kSymmetric * stature(skeleton);
  std::vector<Matrix3> result;
  for (int b = 0; b < kinematics.bones(); ++b) {
    if (skeleton.is_below(b, skeleton.roles.hips)) {
      const Vector3 mirrored = kReflection * frame.to_local(pose.heads[counterpart[b]]);
      if ((mirrored - frame.to_local(pose.heads[b])).norm() > tolerance) return {};
    }
    result.push_back((frame.rotation().inverse() * pose.orientations[b]).toRotationMatrix());
  }
  return result;
}

// The mean world orientation of each bone over the frames that are looked at, in the character frame.
std::vector<Matrix3> mean_orientations(const Kinematics& kinematics, const std::vector<Clip>& clips, int apart) {
  std::vector<Matrix3> sums(kinematics.bones(), Matrix3::Zero());
  Pose pose(kinematics.bones());
  for (const Clip& clip : clips) {
    for (int f = 0; f < clip.frames; f += apart) {
      world(kinematics, clip, f, pose.heads.data(), pose.orientations.data());
      const Quaternion to_character = frame_at(clip, f).rotation().inverse();
      for (int b = 0; b < kinematics.bones(); ++b) sums[b] += (to_character * pose.orientations[b]).toRotationMatrix();
    }
  }
  for (Matrix3& sum : sums) sum = nearest_orthogonal(sum);
  return sums;
}

// A mean pose is only nearly symmetric, but rigs mirror axes exactly: the nearest map of axes to axes, where one is
// near.
Matrix3 snapped_to_axes(const Matrix3& turn) {
  std::array<int, 3> axes{0, 1, 2};
  Matrix3 best = turn;
  double nearest = kSnap;
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3 candidate = Matrix3::Zero();
      for (int row = 0; row < 3; ++row) candidate(row, axes[row]) = (signs >> row & 1) != 0 ? -1 : 1;
      if (candidate.determinant() * turn.determinant() < 0) continue;
      const double trace = (candidate.transpose() * turn).trace();
      if (trace > nearest) nearest = trace, best = candidate;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return best;
}

// What makes the reflection of a bone's counterpart, where each is oriented like this, a frame of the bone.
Matrix3 turn_to_image(const std::vector<Matrix3>& orientations, const std::vector<int>& counterpart, int bone) {
  return (kReflection * orientations[counterpart[bone]]).transpose() * orientations[bone];
}

Matrix3 half_roll(const Vector3& tip) { return Eigen::AngleAxisd(EIGEN_PI, tip.normalized()).toRotationMatrix(); }

// Whether a bone is turned by about half a turn about its length. No joint of a body does so: its controls do, as where
// the pole of a leg's IK is on the other side.
bool is_rolled(const Matrix3& turn, const Vector3& tip) {
  return tip.squaredNorm() > 0 && (half_roll(tip).transpose() * turn).trace() > kSnap;
}

// Whether a turn of a bone in its own frame moves a joint that hangs on it.
bool moves_joint(const Skeleton& skeleton, int bone, const Matrix3& turn) {
  const double tolerance = kSymmetric * stature(skeleton);
  for (int b = bone + 1; b < skeleton.size(); ++b) {
    const Vector3& offset = skeleton.offsets[b];
    if (skeleton.parents[b] == bone && (turn * offset - offset).norm() > tolerance) return true;
  }
  return false;
}

// Those whose counterparts are still, too: where one hand alone moves, the other one moves in the mirror image.
std::vector<int> both_still(const std::vector<int>& still, const std::vector<int>& counterpart) {
  std::vector<int> both;
  for (const int bone : still) {
    if (std::binary_search(still.begin(), still.end(), counterpart[bone])) both.push_back(bone);
  }
  return both;
}

}  // namespace

Mirror::Mirror(const Kinematics& kinematics, const std::vector<Clip>& clips)
    : kinematics_(kinematics),
      counterpart_(mirror_bones(kinematics.skeleton())),
      still_(both_still(still_fingers(kinematics.skeleton(), clips), counterpart_)) {
  const Skeleton& skeleton = kinematics.skeleton();
  const std::vector<Matrix3> rest = symmetric_rest(kinematics, counterpart_);
  int frames = 0;
  for (const Clip& clip : clips) frames += clip.frames;
  const int apart = rest.empty() ? 1 : frames_between_looks(frames);
  const std::vector<Matrix3> mean = mean_orientations(kinematics, clips, apart);
  for (int b = 0; b < kinematics.bones(); ++b) {
    const Matrix3 by_mean = turn_to_image(mean, counterpart_, b);
    if (rest.empty()) {
      turn_.push_back(snapped_to_axes(by_mean));
      continue;
    }
    turn_.push_back(turn_to_image(rest, counterpart_, b));
    const bool may_roll = counterpart_[b] != b && frames > 0;
    if (may_roll && is_rolled(turn_[b].transpose() * by_mean, skeleton.tips[b]) &&
        !moves_joint(skeleton, b, half_roll(skeleton.tips[b])))
      turn_[b] = turn_[b] * half_roll(skeleton.tips[b]);
  }
}

Clip Mirror::operator()(const Clip& clip) const {
  Clip result = clip;
  result.name += " mirrored";
  const MirrorTurns turns = this->turns();
  if (turns.counterparts.empty()) {
    mirror_in_world(clip, result);
  } else {
    mirror_in_parents(clip, turns, result);
  }
  for (int f = 0; f < clip.frames; ++f) {
    result.root_positions[3 * f] = -clip.root_positions[3 * f];
    result.headings[f] = -clip.headings[f];
  }
  return make_clip(kinematics_.skeleton(), std::move(result));
}

void Mirror::mirror_in_parents(const Clip& clip, const MirrorTurns& turns, Clip& result) const {
  const std::size_t width = std::size_t{4} * kinematics_.bones();
  for (std::size_t pose = 0; pose < clip.rotations.size(); pose += width) {
    for (int b = 0; b < kinematics_.bones(); ++b) {
      const Quaternion other = load_quaternion(&clip.rotations[pose + std::size_t{4} * turns.counterparts[b]]);
      store_quaternion(product(product(turns.before[b], other), turns.after[b]),
                       &result.rotations[pose + std::size_t{4} * b]);
    }
  }
}

// Of a skeleton whose bones hang otherwise on one side than on the other.
void Mirror::mirror_in_world(const Clip& clip, Clip& result) const {
  const Skeleton& skeleton = kinematics_.skeleton();
  const int bones = kinematics_.bones();
  Pose pose(bones);
  std::vector<Quaternion> mirrored(bones);
  std::vector<int> turned;
  for (int b = 0; b < bones; ++b) {
    const bool still = std::binary_search(still_.begin(), still_.end(), b);
    if (!still && skeleton.is_below(b, skeleton.roles.hips)) turned.push_back(b);
  }
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics_, clip, f, pose.heads.data(), pose.orientations.data());
    for (int b = 0; b < bones; ++b) {
      mirrored[b] = Quaternion{kReflection * pose.orientations[counterpart_[b]].toRotationMatrix() * turn_[b]};
    }
    for (const int b : turned) {
      const bool hips = b == skeleton.roles.hips;
      store_quaternion(hips ? mirrored[b] : mirrored[skeleton.parents[b]].inverse() * mirrored[b],
                       &result.rotations[4 * (static_cast<std::size_t>(f) * bones + b)]);
    }
  }
}

// Two reflections make a rotation: with W' = S W_counterpart turn, and S = -(half a turn about x), a bone's rotation in
// its parent is turn_parent^T q_counterpart turn.
MirrorTurns Mirror::turns() const {
  const Skeleton& skeleton = kinematics_.skeleton();
  const int hips = skeleton.roles.hips;
  MirrorTurns turns{counterpart_, {}, {}};
  if (counterpart_[hips] != hips) return {};
  for (int b = 0; b < kinematics_.bones(); ++b) {
    const int parent = skeleton.parents[b];
    if (!skeleton.is_below(b, hips)) {
      turns.counterparts[b] = b;
      turns.before.push_back(Quaternion::Identity());
      turns.after.push_back(Quaternion::Identity());
      continue;
    }
    if (b != hips && skeleton.parents[counterpart_[b]] != counterpart_[parent]) return {};
    turns.after.emplace_back(Matrix3{-turn_[b]});
    turns.before.push_back(b == hips ? Quaternion{0, 1, 0, 0} : turns.after[parent].conjugate());
  }
  for (const int b : still_) {
    turns.counterparts[b] = b;
    turns.before[b] = turns.after[b] = Quaternion::Identity();
  }
  return turns;
}

}  // namespace fragmotion
