// SPDX-License-Identifier: MIT
#include "motion/pack_clip.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/pose.hpp"

namespace fragmotion {
namespace {

// Lengths are those of a character of 1.8 m.
constexpr double kMostOff = 0.045 * kPi / 180;  // rad that a turn may be off
constexpr double kReach = 0.08e-3;              // m that a bone's end may be off because of its own turn
constexpr double kLever = 0.1;                  // m: at the end of longer bones places count for more than rotations
constexpr double kPlace = 0.015e-3;             // m that the hips may be off
constexpr double kHeading = 1e-3;               // rad
constexpr double kFinest = 2e-7;                // step of a turn that single precision still tells apart
const double kOff = 2 * std::sqrt(3.0);         // rad that a rotation may be off for a step of 1

using Matrix3 = Eigen::Matrix3d;

// A bone's tip, and the heads of the bones that hang on it, in its own frame.
std::vector<std::vector<Vector3>> bone_ends(const Skeleton& skeleton) {
  std::vector<std::vector<Vector3>> ends;
  for (const Vector3& tip : skeleton.tips) ends.push_back({tip});
  for (int b = 1; b < skeleton.size(); ++b) ends[skeleton.parents[b]].push_back(skeleton.offsets[b]);
  return ends;
}

// How far a bone that ends so carries what hangs on it.
double longest(const std::vector<Vector3>& ends) {
  double length = 0;
  for (const Vector3& end : ends) length = std::max(length, end.norm());
  return length;
}

Matrix3 cross_matrix(const Vector3& v) {
  Matrix3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// What turns a bone by the vector that brings its ends nearest to where they should be when its head is off by another
// vector: the least squares of what is left of each end, and of the lever times the turn.
Matrix3 aim_of(const std::vector<Vector3>& ends, double lever) {
  Matrix3 squares = lever * lever * Matrix3::Identity();
  Vector3 sum = Vector3::Zero();
  for (const Vector3& end : ends) {
    squares += end.squaredNorm() * Matrix3::Identity() - end * end.transpose();
    sum += end;
  }
  return squares.inverse() * cross_matrix(sum);
}

// The mean of a bone's rotations; none where they have no mean.
Quaternion mean_rotation(const std::vector<Clip>& clips, int bone, int bones) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (const Clip& clip : clips) {
    for (int f = 0; f < clip.frames; ++f) {
      add_rotation(&clip.rotations[4 * (static_cast<std::size_t>(f) * bones + bone)], sum.data());
    }
  }
  return sum.norm() < 0.5 ? Quaternion::Identity() : load_quaternion(sum.data()).normalized();
}

std::vector<float> no_rotations(const PoseGrid& grid) {
  std::vector<float> lanes(std::size_t{4} * kBoneBlock * grid.blocks(), 0);
  for (int b = 0; b < kBoneBlock * grid.blocks(); ++b) lanes[place_of(b, 0, 4)] = 1;
  return lanes;
}

void set_rotation(const Quaternion& q, int bone, std::vector<float>& lanes) {
  const double values[] = {q.w(), q.x(), q.y(), q.z()};
  for (int axis = 0; axis < 4; ++axis) lanes[place_of(bone, axis, 4)] = static_cast<float>(values[axis]);
}

// An image is on the same side as the usual rotation of the bone that it is of.
PoseMirror pose_mirror(const PoseGrid& grid, const MirrorTurns& turns) {
  PoseMirror mirror{turns.counterparts, no_rotations(grid), no_rotations(grid)};
  for (int b = 0; b < grid.bones; ++b) {
    const int image = turns.counterparts[b];
    Quaternion before = turns.before[image] * quaternion_of(grid.usual, b);
    if ((before * turns.after[image]).dot(quaternion_of(grid.usual, image)) < 0) before.coeffs() *= -1;
    set_rotation(before, b, mirror.before);
    set_rotation(turns.after[image], b, mirror.after);
  }
  return mirror;
}

// axis * tan(angle / 4), where the angle is at most half a turn.
Vector3 turn_of(const Quaternion& q) { return q.w() < 0 ? Vector3{-q.vec() / (1 - q.w())} : q.vec() / (1 + q.w()); }

Quaternion rotation_of(const Vector3& turn) {
  const double square = turn.squaredNorm(), scale = 1 / (1 + square);
  Quaternion q;
  q.w() = (1 - square) * scale;
  q.vec() = 2 * scale * turn;
  return q;
}

// The turns of a clip's poses in whole steps.
class Quantizer {
 public:
  Quantizer(const Skeleton& skeleton, const PoseGrid& grid)
      : skeleton_(skeleton), grid_(grid), bones_(skeleton.size()) {
    const double lever = kLever / standard_scale(skeleton);
    const auto ends = bone_ends(skeleton);
    for (int b = 0; b < skeleton.size(); ++b) {
      bones_[b].follows = skeleton.is_below(b, skeleton.roles.hips) && b != skeleton.roles.hips;
      bones_[b].usual = quaternion_of(grid.usual, b);
      bones_[b].aim = aim_of(ends[b], lever);
    }
  }

  // Writes a pose's numbers [blocks, 3, kBoneBlock].
  void operator()(const double* rotations, std::int32_t* numbers) {
    for (int b = 0; b < skeleton_.size(); ++b) {
      Bone& bone = bones_[b];
      const Quaternion local = load_quaternion(rotations + std::ptrdiff_t{4} * b);
      if (!bone.follows) {
        bone.exact = local;
        bone.kept = keep(b, local, numbers);
        continue;
      }
      const Bone& parent = bones_[skeleton_.parents[b]];
      bone.exact = parent.exact * local;
      bone.off = parent.off + parent.exact * skeleton_.offsets[b] - parent.kept * skeleton_.offsets[b];
      bone.kept = parent.kept * keep(b, parent.kept.conjugate() * aimed(bone), numbers);
    }
  }

 private:
  struct Bone {
    bool follows = false;  // its parent
    Quaternion usual;
    Matrix3 aim;
    Quaternion exact, kept;         // in the world, of this pose
    Vector3 off = Vector3::Zero();  // from its head as it is kept to where it is
  };

  // The rotation in the world at which a bone's ends are where they should be.
  static Quaternion aimed(const Bone& bone) {
    const Vector3 turn = bone.aim * (bone.exact.conjugate() * bone.off);
    return bone.exact * rotation_of(turn / 4);
  }

  // Writes a bone's numbers; returns the rotation that they stand for.
  Quaternion keep(int bone, const Quaternion& wanted, std::int32_t* numbers) const {
    const Quaternion& usual = bones_[bone].usual;
    const double step = grid_.steps[bone];
    const Vector3 steps = (turn_of(usual.conjugate() * wanted) / step).array().round();
    for (int axis = 0; axis < 3; ++axis) numbers[place_of(bone, axis, 3)] = static_cast<std::int32_t>(steps[axis]);
    return usual * rotation_of(step * steps);
  }

  const Skeleton& skeleton_;
  const PoseGrid& grid_;
  std::vector<Bone> bones_;
};

int bits_for(std::uint32_t largest) {
  int bits = 0;
  for (; largest > 0; largest >>= 1) ++bits;
  return bits;
}

// Numbers of any few bits behind one another, lowest bits first.
class BitWriter {
 public:
  explicit BitWriter(std::uint8_t* bytes) : bytes_(bytes) {}

  void operator()(std::uint32_t number, int bits) {
    std::uint64_t shifted = std::uint64_t{number} << (at_ & 7);
    for (std::uint8_t* byte = bytes_ + (at_ >> 3); shifted > 0; shifted >>= 8) *byte++ |= shifted & 0xff;
    at_ += bits;
  }

 private:
  std::uint8_t* bytes_;
  unsigned at_ = 0;
};

// Place and heading of each frame: root x, y, z, heading.
double root_value(const Clip& clip, int frame, int number) {
  return number < 3 ? clip.root_positions[std::size_t{3} * frame + number] : clip.headings[frame];
}

void measure_root(const Clip& clip, double scale, PackedPoses& poses) {
  constexpr double kMost = (1 << PackedPoses::kMostBits) - 1;
  for (int number = 0; number < PackedPoses::kRootNumbers; ++number) {
    double low = root_value(clip, 0, number), high = low;
    for (int f = 1; f < clip.frames; ++f) {
      low = std::min(low, root_value(clip, f, number));
      high = std::max(high, root_value(clip, f, number));
    }
    const double wanted = number < 3 ? 2 * kPlace / std::sqrt(3.0) / scale : kHeading;
    poses.origin[number] = low;
    poses.steps[number] = std::max(wanted, (high - low) / kMost);
    poses.bits.push_back(static_cast<std::uint8_t>(
        bits_for(static_cast<std::uint32_t>(std::round((high - low) / poses.steps[number])))));
  }
}

double root_steps(const Clip& clip, int frame, int number, const PackedPoses& poses) {
  return std::round((root_value(clip, frame, number) - poses.origin[number]) / poses.steps[number]);
}

// All turns of a clip in steps, [frames, numbers].
std::vector<std::int32_t> steps_of(const Skeleton& skeleton, const PoseGrid& grid, const Clip& clip) {
  const std::size_t width = std::size_t{3} * kBoneBlock * grid.blocks();
  std::vector<std::int32_t> steps(width * clip.frames, 0);
  Quantizer quantizer(skeleton, grid);
  for (int f = 0; f < clip.frames; ++f) {
    quantizer(&clip.rotations[std::size_t{4} * skeleton.size() * f], &steps[width * f]);
  }
  return steps;
}

void measure_turns(const std::vector<std::int32_t>& steps, std::size_t width, PackedPoses& poses) {
  std::vector<std::int32_t> most(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(width));
  poses.least = most;
  for (std::size_t pose = 0; pose < steps.size(); pose += width) {
    for (std::size_t i = 0; i < width; ++i) {
      poses.least[i] = std::min(poses.least[i], steps[pose + i]);
      most[i] = std::max(most[i], steps[pose + i]);
    }
  }
  for (std::size_t i = 0; i < width; ++i) {
    poses.bits.push_back(static_cast<std::uint8_t>(bits_for(most[i] - poses.least[i])));
  }
}

void write_poses(const Clip& clip, const std::vector<std::int32_t>& steps, PackedPoses& poses) {
  const std::size_t bytes = poses.pose_bytes = bytes_for(poses.bits), width = poses.least.size();
  poses.bytes.assign(bytes * clip.frames + PackedPoses::kSpare, 0);
  for (int f = 0; f < clip.frames; ++f) {
    BitWriter write(&poses.bytes[bytes * f]);
    for (int i = 0; i < PackedPoses::kRootNumbers; ++i) {
      write(static_cast<std::uint32_t>(root_steps(clip, f, i, poses)), poses.bits[i]);
    }
    for (std::size_t i = 0; i < width; ++i) {
      write(steps[width * f + i] - poses.least[i], poses.bits[PackedPoses::kRootNumbers + i]);
    }
  }
}

}  // namespace

PoseGrid pose_grid(const Skeleton& skeleton, const std::vector<Clip>& clips, const MirrorTurns& turns) {
  PoseGrid grid;
  grid.bones = skeleton.size();
  grid.usual = no_rotations(grid);
  grid.steps.assign(static_cast<std::size_t>(kBoneBlock) * grid.blocks(), 1);
  const double scale = standard_scale(skeleton);
  const auto ends = bone_ends(skeleton);
  for (int b = 0; b < grid.bones; ++b) {
    set_rotation(mean_rotation(clips, b, grid.bones), b, grid.usual);
    const double off = std::min(kMostOff, kReach / (longest(ends[b]) * scale));
    grid.steps[b] = static_cast<float>(std::max(kFinest, off / kOff));
  }
  if (!turns.counterparts.empty()) grid.mirror = pose_mirror(grid, turns);
  return grid;
}

PackedClip pack(const Skeleton& skeleton, std::shared_ptr<const PoseGrid> grid, const Clip& clip) {
  PackedPoses poses;
  measure_root(clip, standard_scale(skeleton), poses);
  const std::vector<std::int32_t> steps = steps_of(skeleton, *grid, clip);
  measure_turns(steps, steps.size() / clip.frames, poses);
  write_poses(clip, steps, poses);
  return {clip.name,   clip.rate, clip.frames, std::move(grid), std::make_shared<const PackedPoses>(std::move(poses)),
          clip.markers};
}

}  // namespace fragmotion
