// SPDX-License-Identifier: MIT
#include "fragments/look.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/pose.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

constexpr double kRate = 30;  // times a second at which poses are compared

// The fastest turns so far of bones that hang on each other and on the hips.
class Turns {
 public:
  Turns(const Skeleton& skeleton, const std::vector<int>& bones)
      : kinematics_(skeleton),
        bones_(bones),
        chain_(kinematics_.chains({bones.back()})),
        rotations_(std::size_t{4} * skeleton.size()),
        heads_(skeleton.size()),
        now_(skeleton.size()),
        before_(skeleton.size()),
        fastest_(bones.size()) {}

  void add(const PackedClip& clip) {
    const double apart = std::max(1.0, std::round(clip.rate / kRate));
    for (double frame = 0; frame < clip.frames; frame += apart) {
      const Vector3 root = sample_pose(clip, frame, rotations_.data());
      kinematics_.world(root, rotations_.data(), chain_, heads_.data(), now_.data());
      for (std::size_t i = 0; frame > 0 && i < bones_.size(); ++i) {
        const double angle = before_[bones_[i]].angularDistance(now_[bones_[i]]);
        fastest_[i] = std::max(fastest_[i], static_cast<float>(angle * clip.rate / apart));
      }
      std::swap(now_, before_);
    }
  }

  const std::vector<float>& fastest() const { return fastest_; }

 private:
  Kinematics kinematics_;
  const std::vector<int>& bones_;
  std::vector<int> chain_;
  std::vector<double> rotations_;
  std::vector<Vector3> heads_;
  std::vector<Quaternion> now_, before_;
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

std::vector<float> fastest_looks(const PackedPool& pool) {
  const std::vector<int> bones = look_bones(pool.skeleton);
  if (bones.empty()) return {};
  Turns turns(pool.skeleton, bones);
  int last = -1;
  for (const Fragment& f : pool.fragments) {
    if (f.origin == Origin::captured && std::exchange(last, f.clip) != f.clip) turns.add(pool.clips[f.clip]);
  }
  return turns.fastest();
}

}  // namespace fragmotion
