// SPDX-License-Identifier: MIT
#include "io/straying.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace fragmotion {

double Straying::of(int bone, int from) const {
  double sum = 0;
  for (int f = 1; f < frames_; ++f) sum += (seen(f, bone, from) - seen(f - 1, bone, from)).norm();
  return sum;
}

double Straying::span(int bone, int from) const {
  Eigen::AlignedBox3d box;
  for (int f = 0; f < frames_; ++f) box.extend(seen(f, bone, from));
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

double Straying::apart(int bone, int other) const {
  double sum = 0;
  for (int f = 0; f < frames_; ++f) sum += (head(f, bone) - head(f, other)).norm();
  return sum;
}

Vector3 Straying::seen(int frame, int bone, int from) const {
  if (from < 0) return head(frame, bone);
  const RowMajor frame_of = pose(frame, from);
  return frame_of.topLeftCorner<3, 3>().inverse() * (head(frame, bone) - head(frame, from));
}

}  // namespace fragmotion
