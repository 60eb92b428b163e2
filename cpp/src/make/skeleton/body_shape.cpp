// SPDX-License-Identifier: MIT
#include "skeleton/body_shape.hpp"

#include <algorithm>

namespace fragmotion {
namespace {

constexpr int kFingers = 3;  // at least on a hand

}  // namespace

BodyShape::BodyShape(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion)
    : skeleton_(&skeleton) {
  rest_pose(skeleton, rest_, rotations_);
  observe(motion);
  grow(tree);
}

void BodyShape::observe(const ObservedPoses* motion) {
  if (!motion || motion->poses < 1) {
    poses_.push_back(rest_.data());
    return;
  }
  moves_ = true;
  const int step = frames_between_looks(motion->poses);
  for (int p = 0; p < motion->poses; p += step) {
    poses_.push_back(&motion->heads[static_cast<std::size_t>(p) * skeleton_->size()]);
  }
}

void BodyShape::grow(const BodyTree& tree) {
  const int bones = skeleton_->size();
  const auto taken = [&](int bone) { return tree.in_body[bone] && !tree.twist[bone]; };
  parents_.assign(bones, -1);
  children_.assign(bones, {});
  reach_.assign(bones, 0);
  for (const BoneName& name : tree.names) sides_.push_back(name.side);
  for (int b = 0; b < bones; ++b) {
    int above = tree.parents[b];
    while (above >= 0 && !taken(above)) above = tree.parents[above];
    if (!taken(b)) continue;
    parents_[b] = above;
    if (above >= 0) children_[above].push_back(b);
  }
  for (int b = bones - 1; b >= 0; --b) {
    if (parents_[b] >= 0) reach_[parents_[b]] = std::max(reach_[parents_[b]], branch(b));
  }
  for (int b = 0; b < bones; ++b) size_ = std::max(size_, across_at(b));
}

// The two longest branches of a bone together. One alone may be as long as the way from the origin to a body.
double BodyShape::across_at(int bone) const {
  double first = 0, second = 0;
  for (const int child : children_[bone]) {
    const double far = branch(child);
    second = std::max(second, std::min(first, far));
    first = std::max(first, far);
  }
  return second > 0 ? first + second : 0;
}

Chain BodyShape::chain_from(int bone) const {
  Chain chain{bone};
  while (!children_[chain.back()].empty()) {
    const std::vector<int>& next = children_[chain.back()];
    chain.push_back(*std::max_element(next.begin(), next.end(), [&](int a, int b) { return branch(a) < branch(b); }));
  }
  return chain;
}

int BodyShape::leaves(int bone) const {
  if (children_[bone].empty()) return 1;
  int count = 0;
  for (const int child : children_[bone]) count += leaves(child);
  return count;
}

bool BodyShape::is_below(int bone, int ancestor) const {
  while (bone > ancestor) bone = parents_[bone];
  return bone == ancestor;
}

bool BodyShape::has_fingers(int bone) const {
  const std::vector<int>& next = children_[bone];
  return std::count_if(next.begin(), next.end(), [&](int child) { return branch(child) > reach_[bone] / 2; }) >=
         kFingers;
}

double BodyShape::descent(const Poses& poses, int from, int to) {
  double down = 0;
  for (const Vector3* heads : poses) {
    down -= (heads[to] - heads[from]).normalized().z();
  }
  return down / static_cast<double>(poses.size());
}

}  // namespace fragmotion
