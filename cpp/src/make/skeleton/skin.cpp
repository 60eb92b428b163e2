// SPDX-License-Identifier: MIT
#include "skeleton/skin.hpp"

#include <algorithm>

namespace fragmotion {

std::vector<bool> bare_bones(const Skeleton& skeleton, const Skin& skin) {
  std::vector<double> carried(skeleton.size(), 0);
  for (const Skin::Weight& weight : skin.weights) carried[weight.bone] += weight.weight;
  for (int b = skeleton.size() - 1; b > 0; --b) carried[skeleton.parents[b]] += carried[b];
  std::vector<bool> bare(skeleton.size(), false);
  for (int b = 0; b < skeleton.size(); ++b) bare[b] = carried[0] > 0 && carried[b] == 0;
  return bare;
}

Vector3 way_of_skin(const Skeleton& skeleton, const Skin& skin, int bone) {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  std::vector<Vector3> ways;
  Vector3 sum = Vector3::Zero();
  for (const Skin::Weight& weight : skin.weights) {
    if (weight.bone != bone || weight.weight <= 0.5) continue;
    ways.emplace_back(skin.points[weight.point] - heads[bone]);
    sum += ways.back();
  }
  if (sum.squaredNorm() == 0) return sum;
  const Vector3 along = sum.normalized();
  double reach = 0;
  for (const Vector3& way : ways) reach = std::max(reach, along.dot(way));
  return rotations[bone].conjugate() * along * reach;
}

}  // namespace fragmotion
