// SPDX-License-Identifier: MIT
#include "fragments/body_tips.hpp"

#include <cmath>

#include "base/vectorised.hpp"

namespace fragmotion {
namespace {

constexpr int kPoses = TipWriter::kPoses;

using Lanes = TipWriter::Lanes;
using LanePoint = std::array<Lanes, 3>;
using LaneTurn = std::array<Lanes, 4>;

// What hangs on a bone's head, or its tip. The sums are in the order of Kinematics', and of Eigen's.
[[gnu::always_inline]] inline void attach_lanes(const LanePoint& __restrict head, const LaneTurn& __restrict turn,
                                                const Vector3& offset, LanePoint& __restrict to) {
  const double ox = offset.x(), oy = offset.y(), oz = offset.z();
  for (int i = 0; i < kPoses; ++i) {
    const double w = turn[0][i], x = turn[1][i], y = turn[2][i], z = turn[3][i];
    const double u = 2 * (y * oz - z * oy), v = 2 * (z * ox - x * oz), t = 2 * (x * oy - y * ox);
    to[0][i] = head[0][i] + ox + w * u + y * t - z * v;
    to[1][i] = head[1][i] + oy + w * v + z * u - x * t;
    to[2][i] = head[2][i] + oz + w * t + x * v - y * u;
  }
}

[[gnu::always_inline]] inline void tip_lanes(const LanePoint& __restrict head, const LaneTurn& __restrict turn,
                                             const Vector3& tip, LanePoint& __restrict to) {
  const double tx = tip.x(), ty = tip.y(), tz = tip.z();
  for (int i = 0; i < kPoses; ++i) {
    const double w = turn[0][i], x = turn[1][i], y = turn[2][i], z = turn[3][i];
    const double u = 2 * (y * tz - z * ty), v = 2 * (z * tx - x * tz), t = 2 * (x * ty - y * tx);
    to[0][i] = head[0][i] + (tx + w * u + (y * t - z * v));
    to[1][i] = head[1][i] + (ty + w * v + (z * u - x * t));
    to[2][i] = head[2][i] + (tz + w * t + (x * v - y * u));
  }
}

// A turn after its parent's.
[[gnu::always_inline]] inline void turn_lanes(const LaneTurn& __restrict parent, LaneTurn& __restrict turn) {
  for (int i = 0; i < kPoses; ++i) {
    const double w = parent[0][i], x = parent[1][i], y = parent[2][i], z = parent[3][i];
    const double a = turn[0][i], b = turn[1][i], c = turn[2][i], d = turn[3][i];
    turn[0][i] = w * a - x * b - y * c - z * d;
    turn[1][i] = w * b + x * a + y * d - z * c;
    turn[2][i] = w * c - x * d + y * a + z * b;
    turn[3][i] = w * d + x * c - y * b + z * a;
  }
}

// Poses the hips, which have their places already, and bones that hang on each other and on these; and the tips of
// some.
FRAGMOTION_VECTORISED void pose_lanes(const Skeleton& skeleton, const std::vector<int>& bones,
                                      const std::vector<int>& with_tips,
                                      const std::array<const double*, kPoses>& rotations, TipWriter::Posed* posed) {
  for (int n = -1; n < static_cast<int>(bones.size()); ++n) {
    const int b = n < 0 ? skeleton.roles.hips : bones[n];
    TipWriter::Posed& to = posed[b];
    for (int i = 0; i < kPoses; ++i) {
      for (int part = 0; part < 4; ++part) to.turn[part][i] = rotations[i][4 * b + part];
    }
    if (n >= 0) {
      const TipWriter::Posed& parent = posed[skeleton.parents[b]];
      attach_lanes(parent.head, parent.turn, skeleton.offsets[b], to.head);
      turn_lanes(parent.turn, to.turn);
    }
  }
  for (const int b : with_tips) tip_lanes(posed[b].head, posed[b].turn, skeleton.tips[b], posed[b].tip);
}

// Writes a tip of so many poses, each as its frame sees it, to their rows.
FRAGMOTION_VECTORISED void see_lanes(const LanePoint& tip, const TipWriter::Frames& frames, double scale, int count,
                                     int number, const std::array<TipWriter::Rows, kPoses>& to) {
  float seen[3][kPoses];
  for (int i = 0; i < kPoses; ++i) {
    const double right = tip[0][i] - frames.x[i], ahead = tip[1][i] - frames.y[i];
    seen[0][i] = static_cast<float>(frames.cosine[i] * right + frames.sine[i] * ahead);
    seen[1][i] = static_cast<float>(frames.cosine[i] * ahead - frames.sine[i] * right);
    seen[2][i] = static_cast<float>(scale * tip[2][i]);
  }
  for (int i = 0; i < count; ++i) {
    float* row = to[i].rows + number;
    for (int axis = 0; axis < 3; ++axis, row += to[i].stride) *row = seen[axis][i];
  }
}

// For each bone, the one of `among` that hangs on it and has its head where the bone has its tip; -1 where there is
// none. Such a tip is known as soon as the heads are.
std::vector<int> joined_at_tips(const Skeleton& skeleton, const std::vector<int>& bones,
                                const std::vector<int>& among) {
  std::vector<int> joined(bones.size(), -1);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    for (const int child : among) {
      if (skeleton.parents[child] == bones[i] && skeleton.offsets[child] == skeleton.tips[bones[i]]) joined[i] = child;
    }
  }
  return joined;
}

}  // namespace

double tip_reach(const Skeleton& skeleton) {
  const std::vector<int> bones = measured_bones(skeleton);
  std::vector<double> ways(skeleton.size(), 0);  // from the hips to each bone's head
  double sum = skeleton.tips[bones[0]].norm();
  for (int b = bones[0] + 1; b < skeleton.size(); ++b) ways[b] = ways[skeleton.parents[b]] + skeleton.offsets[b].norm();
  for (std::size_t i = 1; i < bones.size(); ++i) sum += ways[bones[i]] + skeleton.tips[bones[i]].norm();
  return sum * standard_scale(skeleton);
}

[[gnu::cold]] BodyTips::BodyTips(const Skeleton& skeleton)
    : kinematics_(skeleton),
      bones_(measured_bones(skeleton)),
      scale_(standard_scale(skeleton)),
      reach_(tip_reach(skeleton)),
      chains_(kinematics_.chains(bones_)),
      joined_(joined_at_tips(skeleton, bones_, chains_)),
      posed_(skeleton.size()),
      tips_(bones_.size()) {}

void BodyTips::pose(const Vector3& root, const double* rotations) {
  kinematics_.world_below(root, rotations, chains_, posed_.heads.data(), posed_.rotations.data());
  const std::vector<Vector3>& tips = kinematics_.skeleton().tips;
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    const int b = bones_[i], joined = joined_[i];
    tips_[i] = joined >= 0 ? posed_.heads[joined] : posed_.heads[b] + turned(posed_.rotations[b], tips[b]);
  }
}

void BodyTips::write(const Vector2& place, const PlaneTurn& facing, float* rows, int stride, int offset) const {
  const double c = scale_ * facing.cosine, s = scale_ * facing.sine;
  float *to_x = rows + offset, *to_y = to_x + stride, *to_z = to_y + stride;
  for (int i = 0; i < points(); ++i) {
    const Vector3& tip = tips_[i];
    const double x = tip.x() - place.x(), y = tip.y() - place.y();
    to_x[i] = static_cast<float>(c * x + s * y);
    to_y[i] = static_cast<float>(c * y - s * x);
    to_z[i] = static_cast<float>(scale_ * tip.z());
  }
}

[[gnu::cold]] TipWriter::TipWriter(const Skeleton& skeleton)
    : kinematics_(skeleton),
      measured_(measured_bones(skeleton)),
      chains_(kinematics_.chains(measured_)),
      joined_(joined_at_tips(skeleton, measured_, chains_)),
      scale_(standard_scale(skeleton)),
      posed_(skeleton.size()) {
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    if (joined_[i] < 0) loose_.push_back(measured_[i]);
  }
  for (std::vector<double>& rotations : rotations_) rotations.resize(std::size_t{4} * skeleton.size());
}

void TipWriter::add(const Vector3& root, const CharacterFrame& frame, float* rows, int stride, int offset) {
  for (int axis = 0; axis < 3; ++axis) posed_[kinematics_.skeleton().roles.hips].head[axis][count_] = root[axis];
  frames_.x[count_] = frame.position.x();
  frames_.y[count_] = frame.position.y();
  frames_.cosine[count_] = scale_ * std::cos(frame.heading);
  frames_.sine[count_] = scale_ * std::sin(frame.heading);
  to_[count_] = {rows + offset, stride};
  if (++count_ == kPoses) flush();
}

void TipWriter::flush() {
  std::array<const double*, kPoses> rotations{};
  for (int i = 0; i < kPoses; ++i) rotations[i] = rotations_[i].data();
  pose_lanes(kinematics_.skeleton(), chains_, loose_, rotations, posed_.data());
  for (std::size_t n = 0; n < measured_.size(); ++n) {
    const LanePoint& tip = joined_[n] >= 0 ? posed_[joined_[n]].head : posed_[measured_[n]].tip;
    see_lanes(tip, frames_, scale_, count_, static_cast<int>(n), to_);
  }
  count_ = 0;
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
