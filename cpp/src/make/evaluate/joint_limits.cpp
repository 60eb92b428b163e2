// SPDX-License-Identifier: MIT
#include "evaluate/joint_limits.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kSeen = kPi / 180;  // rad

using Ranges = std::vector<TurnRange>;  // [joints]

Vector3 rotation_vector(const Quaternion& q) {
  const Eigen::AngleAxisd turn(q);
  return turn.angle() * turn.axis();
}

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

std::vector<JointAxes> joints_of(const Skeleton& skeleton) {
  std::vector<JointAxes> joints;
  for (const int bone : measured_bones(skeleton)) {
    if (bone == skeleton.roles.hips) continue;
    joints.emplace_back();
    joints.back().bone = bone;
  }
  return joints;
}

void find_means(Seen& seen, std::vector<JointAxes>& joints) {
  std::vector<Eigen::Vector4d> sums(joints.size(), Eigen::Vector4d::Zero());
  seen.each_pose([&](std::size_t, const double* rotations) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      add_rotation(rotations + std::ptrdiff_t{4} * joints[j].bone, sums[j].data());
    }
  });
  for (std::size_t j = 0; j < joints.size(); ++j) joints[j].mean = load_quaternion(sums[j].data()).normalized();
}

void find_axes(Seen& seen, std::vector<JointAxes>& joints) {
  std::vector<Eigen::Matrix3d> spreads(joints.size(), Eigen::Matrix3d::Zero());
  seen.each_pose([&](std::size_t, const double* rotations) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Vector3 turn = joints[j].turn(rotations);
      spreads[j] += turn * turn.transpose();
    }
  });
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints[j].axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spreads[j]).eigenvectors().rowwise().reverse();
  }
}

std::vector<Ranges> ranges_by_take(Seen& seen, const std::vector<JointAxes>& joints) {
  std::vector<Ranges> ranges(seen.takes(), Ranges(joints.size()));
  seen.each_pose([&](std::size_t take, const double* rotations) {
    for (std::size_t j = 0; j < joints.size(); ++j) ranges[take][j].add(joints[j].turn(rotations));
  });
  return ranges;
}

// The ranges of all takes but one.
Ranges together(const std::vector<Ranges>& by_take, std::size_t joints, std::size_t but) {
  Ranges all(joints);
  for (std::size_t take = 0; take < by_take.size(); ++take) {
    for (std::size_t j = 0; take != but && j < joints; ++j) all[j].add(by_take[take][j]);
  }
  return all;
}

class Tally {
 public:
  void add(double excess) {
    ++count_;
    if (excess > kSeen) ++beyond_;
    worst_ = std::max(worst_, excess);
  }
  Excess result() const { return {count_ > 0 ? beyond_ / count_ : 0, worst_}; }

 private:
  double count_ = 0, beyond_ = 0, worst_ = 0;
};

Excess beyond_the_others(Seen& seen, const std::vector<JointAxes>& joints, const std::vector<Ranges>& by_take) {
  if (seen.takes() < 2) return {};
  std::vector<Ranges> others;
  for (std::size_t take = 0; take < seen.takes(); ++take) others.push_back(together(by_take, joints.size(), take));
  Tally tally;
  seen.each_pose([&](std::size_t take, const double* rotations) {
    for (std::size_t j = 0; j < joints.size(); ++j) tally.add(others[take][j].excess(joints[j].turn(rotations)));
  });
  return tally.result();
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

JointLimits::JointLimits(const PackedPool& pool)
    : width_(std::size_t{4} * pool.skeleton.size()), joints_(joints_of(pool.skeleton)) {
  Seen seen(pool);
  find_means(seen, joints_);
  find_axes(seen, joints_);
  const std::vector<Ranges> by_take = ranges_by_take(seen, joints_);
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
