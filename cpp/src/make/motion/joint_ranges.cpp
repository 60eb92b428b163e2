// SPDX-License-Identifier: MIT
#include "motion/joint_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/decompositions.hpp"
#include "base/parallel.hpp"
#include "base/rates.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

Vector3 rotation_vector(const Quaternion& q) {
  const Eigen::AngleAxisd turn(q);
  return turn.angle() * turn.axis();
}

void find_means(const EachPose& each_pose, std::vector<JointAxes>& joints) {
  std::vector<Eigen::Vector4d> sums(joints.size(), Eigen::Vector4d::Zero());
  each_pose([&](const double* rotations) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      add_rotation(rotations + std::ptrdiff_t{4} * joints[j].bone, sums[j].data());
    }
  });
  for (std::size_t j = 0; j < joints.size(); ++j) joints[j].mean = load_quaternion(sums[j].data()).normalized();
}

void find_axes(const EachPose& each_pose, std::vector<JointAxes>& joints) {
  std::vector<Eigen::Matrix3d> spreads(joints.size(), Eigen::Matrix3d::Zero());
  each_pose([&](const double* rotations) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Vector3 turn = joints[j].turn(rotations);
      spreads[j] += turn * turn.transpose();
    }
  });
  for (std::size_t j = 0; j < joints.size(); ++j) joints[j].axes = principal_axes(spreads[j]);
}

}  // namespace

Vector3 JointAxes::turn(const double* rotations) const {
  const Quaternion now = load_quaternion(rotations + std::ptrdiff_t{4} * bone);
  return axes.transpose() * rotation_vector(mean.conjugate() * now);
}

TurnRange::TurnRange() {
  least.setConstant(std::numeric_limits<double>::infinity());
  greatest = -least;
}

void TurnRange::add(const Vector3& turn) {
  least = least.cwiseMin(turn);
  greatest = greatest.cwiseMax(turn);
}

void TurnRange::add(const TurnRange& other) {
  least = least.cwiseMin(other.least);
  greatest = greatest.cwiseMax(other.greatest);
}

double TurnRange::excess(const Vector3& turn) const {
  return (least - turn).cwiseMax(turn - greatest).cwiseMax(Vector3::Zero()).norm();
}

std::vector<JointAxes> joint_axes(const std::vector<int>& bones, const EachPose& each_pose) {
  std::vector<JointAxes> joints(bones.size());
  for (std::size_t j = 0; j < bones.size(); ++j) joints[j].bone = bones[j];
  find_means(each_pose, joints);
  find_axes(each_pose, joints);
  return joints;
}

TurnRanges together(const std::vector<TurnRanges>& by_take, std::size_t joints, std::size_t but) {
  TurnRanges all(joints);
  for (std::size_t take = 0; take < by_take.size(); ++take) {
    for (std::size_t j = 0; take != but && j < all.size(); ++j) all[j].add(by_take[take][j]);
  }
  return all;
}

JointRanges::JointRanges(const std::vector<int>& bones, const std::vector<Clip>& clips, int threads)
    : joints_(bones.size()), ranges_(bones.size()) {
  const auto each_pose = [&](const std::function<void(const double*)>& visit) {
    for (const Clip& clip : clips) {
      const std::size_t width = clip.rotations.size() / clip.frames;
      const int step = std::max(1, static_cast<int>(std::lround(clip.rate / kPostureRate)));
      for (int f = 0; f < clip.frames; f += step) visit(&clip.rotations[width * f]);
    }
  };
  parallel_for(static_cast<int>(bones.size()), threads, [&](int begin, int end) {
    const std::vector<JointAxes> found = joint_axes({bones.begin() + begin, bones.begin() + end}, each_pose);
    std::copy(found.begin(), found.end(), joints_.begin() + begin);
    each_pose([&](const double* rotations) {
      for (int j = begin; j < end; ++j) ranges_[j].add(joints_[j].turn(rotations));
    });
  });
}

double JointRanges::excess(const double* rotations) const {
  double most = 0;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    most = std::max(most, ranges_[j].excess(joints_[j].turn(rotations)));
  }
  return most;
}

}  // namespace fragmotion
