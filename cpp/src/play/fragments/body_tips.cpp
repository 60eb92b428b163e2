// SPDX-License-Identifier: MIT
#include "fragments/body_tips.hpp"

#include <cmath>

#include "base/vectorised.hpp"

namespace fragmotion {

double tip_reach(const Skeleton& skeleton) {
  const std::vector<int> bones = measured_bones(skeleton);
  std::vector<double> ways(skeleton.size(), 0);  // from the hips to each bone's head
  double sum = skeleton.tips[bones[0]].norm();
  for (int b = bones[0] + 1; b < skeleton.size(); ++b) ways[b] = ways[skeleton.parents[b]] + skeleton.offsets[b].norm();
  for (std::size_t i = 1; i < bones.size(); ++i) sum += ways[bones[i]] + skeleton.tips[bones[i]].norm();
  return sum * standard_scale(skeleton);
}

BodyTips::BodyTips(const Skeleton& skeleton)
    : kinematics_(skeleton),
      bones_(measured_bones(skeleton)),
      scale_(standard_scale(skeleton)),
      reach_(tip_reach(skeleton)),
      chains_(kinematics_.chains(bones_)),
      posed_(skeleton.size()),
      tips_(bones_.size()) {}

void BodyTips::pose(const Vector3& root, const double* rotations) {
  kinematics_.world_below(root, rotations, chains_, posed_.heads.data(), posed_.rotations.data());
  const std::vector<Vector3>& tips = kinematics_.skeleton().tips;
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    const int b = bones_[i];
    tips_[i] = posed_.heads[b] + posed_.rotations[b] * tips[b];
  }
}

void BodyTips::write(const CharacterFrame& frame, float* rows, int stride, int offset) const {
  const double c = scale_ * std::cos(frame.heading), s = scale_ * std::sin(frame.heading);
  float *to_x = rows + offset, *to_y = to_x + stride, *to_z = to_y + stride;
  for (int i = 0; i < points(); ++i) {
    const Vector3& tip = tips_[i];
    const double x = tip.x() - frame.position.x(), y = tip.y() - frame.position.y();
    to_x[i] = static_cast<float>(c * x + s * y);
    to_y[i] = static_cast<float>(c * y - s * x);
    to_z[i] = static_cast<float>(scale_ * tip.z());
  }
}

// Eight partial sums make the order of additions, and so the bits, the same with any instructions.
FRAGMOTION_VECTORISED float tip_distance(const float* a, const float* b, int stride) {
  float sums[kLanes] = {};
  for (int i = 0; i < stride; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const int x = i + lane, y = x + stride, z = y + stride;
      const float dx = a[x] - b[x], dy = a[y] - b[y], dz = a[z] - b[z];
      sums[lane] += std::sqrt(dx * dx + dy * dy + dz * dz);
    }
  }
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace fragmotion
