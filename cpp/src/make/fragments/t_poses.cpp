// SPDX-License-Identifier: MIT
#include "fragments/t_poses.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "base/quantile.hpp"
#include "motion/arms_out.hpp"
#include "skeleton/kinematics.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

class TPoses {
 public:
  TPoses(const FragmentPool& pool, const ControlSpace& space)
      : pool_(pool), kinematics_(pool.skeleton), arms_(resting_arms(pool.skeleton)), posed_(kinematics_.bones()) {
    if (!arms_[0].exists() || !arms_[1].exists()) return;
    for (int i = 0; i < size(); ++i) {
      if (space.point(space.nearest(pool.fragments[i].evident)).speed() == 0) stands_.push_back(i);
    }
  }

  /// Which fragments are of a T pose: 1 each; none at all where most hold the arms so.
  std::vector<char> found() {
    std::vector<char> is_of(size(), 0);
    for (const int i : stands_) is_of[i] = out_at_least(i, kArmsOut);
    if (std::count(is_of.begin(), is_of.end(), 1) == 0 || usual() > kArmsHalfOut) return std::vector<char>(size(), 0);
    for (std::size_t s = 1; s < stands_.size(); ++s) spread(stands_[s - 1], stands_[s], is_of);
    for (std::size_t s = stands_.size() - 1; s > 0; --s) spread(stands_[s], stands_[s - 1], is_of);
    return is_of;
  }

 private:
  int size() const { return static_cast<int>(pool_.fragments.size()); }

  double out(const Clip& clip, int frame) {
    world(kinematics_, clip, frame, posed_.heads.data(), posed_.rotations.data());
    const auto head = [&](int bone) { return posed_.heads[bone]; };
    return arms_out(head(arms_[0].upper), head(arms_[0].hand), head(arms_[1].upper), head(arms_[1].hand));
  }

  bool out_at_least(int fragment, double least) {
    const Fragment& f = pool_.fragments[fragment];
    return out(pool_.clips[f.clip], f.begin) > least && out(pool_.clips[f.clip], f.end) > least;
  }

  double usual() {
    std::vector<double> all;
    for (const Fragment& f : pool_.fragments) all.push_back(out(pool_.clips[f.clip], f.begin));
    return median(std::move(all));
  }

  // From a fragment to the one beside it, of which an end at least is half as far out.
  void spread(int from, int to, std::vector<char>& is_of) {
    const Fragment &a = pool_.fragments[from], &b = pool_.fragments[to];
    if (!is_of[from] || is_of[to] || a.clip != b.clip || (a.end != b.begin && b.end != a.begin)) return;
    const Clip& clip = pool_.clips[b.clip];
    is_of[to] = out(clip, b.begin) > kArmsHalfOut || out(clip, b.end) > kArmsHalfOut;
  }

  const FragmentPool& pool_;
  Kinematics kinematics_;
  std::array<Arm, 2> arms_;
  PosedBones posed_;
  std::vector<int> stands_;
};

}  // namespace

void drop_t_poses(FragmentPool& pool, const ControlSpace& space) {
  const std::vector<char> is_of = TPoses(pool, space).found();
  std::vector<Fragment> others;
  for (std::size_t i = 0; i < is_of.size(); ++i) {
    if (!is_of[i]) others.push_back(pool.fragments[i]);
  }
  if (!others.empty()) pool.fragments = std::move(others);
}

}  // namespace fragmotion
