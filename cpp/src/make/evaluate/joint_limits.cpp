// SPDX-License-Identifier: MIT
#include "evaluate/joint_limits.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "motion/pose.hpp"

namespace fragmotion {
namespace {

// The takes and their mirror images, which come in the order of the takes.
class Seen {
 public:
  explicit Seen(const PackedPool& pool) : rotations_(std::size_t{4} * pool.skeleton.size()) {
    for (const Origin origin : {Origin::captured, Origin::mirrored}) {
      std::size_t take = 0;
      int last = -1;
      for (const Fragment& f : pool.fragments) {
        if (f.origin != origin || f.clip == last) continue;
        clips_.emplace_back(take++, &pool.clips[last = f.clip]);
      }
      takes_ = std::max(takes_, take);
    }
  }

  std::size_t takes() const { return takes_; }

  // Calls visit(take, rotations) for each pose.
  template <typename Visit>
  void each_pose(const Visit& visit) {
    for (const auto& [take, clip] : clips_) {
      for (int f = 0; f < clip->frames; ++f) {
        sample_pose(*clip, f, rotations_.data());
        visit(take, rotations_.data());
      }
    }
  }

 private:
  std::vector<std::pair<std::size_t, const PackedClip*>> clips_;
  std::size_t takes_ = 0;
  std::vector<double> rotations_;
};

std::vector<int> bones_of(const Skeleton& skeleton) {
  std::vector<int> bones = measured_bones(skeleton);
  bones.erase(std::remove(bones.begin(), bones.end(), skeleton.roles.hips), bones.end());
  return bones;
}

std::vector<TurnRanges> ranges_by_take(Seen& seen, const std::vector<JointAxes>& joints) {
  std::vector<TurnRanges> ranges(seen.takes(), TurnRanges(joints.size()));
  seen.each_pose([&](std::size_t take, const double* rotations) {
    for (std::size_t j = 0; j < joints.size(); ++j) ranges[take][j].add(joints[j].turn(rotations));
  });
  return ranges;
}

class Tally {
 public:
  void add(double excess) {
    ++count_;
    if (excess > kSeenExcess) ++beyond_;
    worst_ = std::max(worst_, excess);
  }
  Excess result() const { return {count_ > 0 ? beyond_ / count_ : 0, worst_}; }

 private:
  double count_ = 0, beyond_ = 0, worst_ = 0;
};

Excess beyond_the_others(Seen& seen, const std::vector<JointAxes>& joints, const std::vector<TurnRanges>& by_take) {
  if (seen.takes() < 2) return {};
  std::vector<TurnRanges> others;
  for (std::size_t take = 0; take < seen.takes(); ++take) others.push_back(together(by_take, joints.size(), take));
  Tally tally;
  seen.each_pose([&](std::size_t take, const double* rotations) {
    for (std::size_t j = 0; j < joints.size(); ++j) tally.add(others[take][j].excess(joints[j].turn(rotations)));
  });
  return tally.result();
}

}  // namespace

JointLimits::JointLimits(const PackedPool& pool) : width_(std::size_t{4} * pool.skeleton.size()) {
  Seen seen(pool);
  joints_ = joint_axes(bones_of(pool.skeleton), [&](const auto& visit) {
    seen.each_pose([&](std::size_t, const double* rotations) { visit(rotations); });
  });
  const std::vector<TurnRanges> by_take = ranges_by_take(seen, joints_);
  ranges_ = together(by_take, joints_.size(), by_take.size());
  takes_ = beyond_the_others(seen, joints_, by_take);
}

Excess JointLimits::of(const std::vector<double>& rotations) const {
  if (rotations.size() % width_ != 0) throw std::invalid_argument("the rotations are not of this skeleton's bones");
  Tally tally;
  for (std::size_t pose = 0; pose < rotations.size(); pose += width_) {
    for (std::size_t j = 0; j < joints_.size(); ++j) tally.add(ranges_[j].excess(joints_[j].turn(&rotations[pose])));
  }
  return tally.result();
}

}  // namespace fragmotion
