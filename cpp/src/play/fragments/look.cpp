// SPDX-License-Identifier: MIT
#include "fragments/look.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rates.hpp"
#include "motion/pose.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

// Reads takes for how bones that hang on each other and on the hips are turned in them.
class Reader {
 public:
  Reader(const Skeleton& skeleton, const std::vector<int>& bones)
      : kinematics_(skeleton),
        bones_(bones),
        chain_(kinematics_.chains({bones.back()})),
        rotations_(std::size_t{4} * skeleton.size()),
        heads_(skeleton.size()),
        now_(skeleton.size()),
        before_(skeleton.size()),
        gaze_(skeleton),
        fastest_(bones.size()) {}

  void read(const PackedClip& clip) {
    const double apart = std::max(1.0, std::round(clip.rate / kPoseRate));
    const int every = static_cast<int>(std::max(1.0, std::round(clip.rate / kPostureRate / apart)));
    std::vector<double> most(bones_.size(), 0);  // tangents of half an angle
    int pose = 0;
    for (double frame = 0; frame < clip.frames; frame += apart, ++pose) {
      const RootPose root = sample_pose(clip, frame, chain_.back() + 1, rotations_.data());
      kinematics_.world_below(root.place, rotations_.data(), chain_, heads_.data(), now_.data());
      for (std::size_t i = 0; frame > 0 && i < bones_.size(); ++i) {
        const Quaternion turn = product(now_[bones_[i]], before_[bones_[i]].conjugate());
        most[i] = std::max(most[i], turn.vec().norm() / std::abs(turn.w()));
      }
      if (pose % every == 0) gaze_.add(root.heading, now_);
      std::swap(now_, before_);
    }
    for (std::size_t i = 0; i < most.size(); ++i)
      fastest_[i] = std::max(fastest_[i], static_cast<float>(2 * std::atan(most[i]) * clip.rate / apart));
  }

  Looks looks() const { return {fastest_, gaze_.range()}; }

 private:
  Kinematics kinematics_;
  const std::vector<int>& bones_;
  std::vector<int> chain_;
  std::vector<double> rotations_;
  std::vector<Vector3> heads_;
  std::vector<Quaternion> now_, before_;
  GazeRanges gaze_;
  std::vector<float> fastest_;
};

}  // namespace

std::vector<int> look_bones(const Skeleton& skeleton) {
  const int head = skeleton.roles.head;
  if (head < 0 || head == skeleton.roles.hips || !skeleton.is_below(head, skeleton.roles.hips)) return {};
  const Trunk trunk(skeleton);
  std::vector<int> bones{head};
  if (trunk.chest < 0 || trunk.head < 0 || head == trunk.chest) return bones;
  while (skeleton.parents[bones.back()] != trunk.chest) bones.push_back(skeleton.parents[bones.back()]);
  std::reverse(bones.begin(), bones.end());
  return bones;
}

Looks looks_in(const std::vector<const PackedPool*>& pools) {
  const Skeleton& skeleton = pools.front()->skeleton;
  const std::vector<int> bones = look_bones(skeleton);
  if (bones.empty()) return {};
  Reader reader(skeleton, bones);
  for (const PackedPool* pool : pools) {
    int last = -1;
    for (const Fragment& f : pool->fragments) {
      if (f.origin == Origin::captured && std::exchange(last, f.clip) != f.clip) reader.read(pool->clips[f.clip]);
    }
  }
  return reader.looks();
}

}  // namespace fragmotion
