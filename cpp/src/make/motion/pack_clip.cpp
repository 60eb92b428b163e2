// SPDX-License-Identifier: MIT
#include "motion/pack_clip.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/vectorised.hpp"
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

// The mean of each bone's rotations; none where they have no mean.
std::vector<Quaternion> mean_rotations(const std::vector<Clip>& clips, int bones) {
  std::vector<double> sums(std::size_t{4} * bones, 0);
  for (const Clip& clip : clips) {
    for (std::size_t pose = 0; pose < clip.rotations.size(); pose += sums.size()) {
      for (std::size_t b = 0; b < sums.size(); b += 4) add_rotation(&clip.rotations[pose + b], &sums[b]);
    }
  }
  std::vector<Quaternion> means;
  for (std::size_t b = 0; b < sums.size(); b += 4) {
    const Quaternion sum = load_quaternion(&sums[b]);
    means.push_back(sum.norm() < 0.5 ? Quaternion::Identity() : sum.normalized());
  }
  return means;
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
[[gnu::always_inline]] inline Vector3 turn_of(const Quaternion& q) {
  const double side = std::copysign(1.0, q.w()), scale = 1 + side * q.w();
  return {side * q.x() / scale, side * q.y() / scale, side * q.z() / scale};
}

[[gnu::always_inline]] inline Quaternion rotation_of(double x, double y, double z) {
  const double square = x * x + (y * y + z * z), scale = 1 / (1 + square), twice = 2 * scale;
  return {(1 - square) * scale, twice * x, twice * y, twice * z};
}

// The turns of a clip's poses in whole steps; of as many poses at once as elsewhere of bones.
class Quantizer {
 public:
  Quantizer(const Skeleton& skeleton, const PoseGrid& grid)
      : skeleton_(skeleton), width_(std::size_t{3} * kBoneBlock * grid.blocks()), posed_(skeleton.size()) {
    const double lever = kLever / standard_scale(skeleton);
    const auto ends = bone_ends(skeleton);
    for (int b = 0; b < skeleton.size(); ++b)
      bones_.push_back({quaternion_of(grid.usual, b), aim_of(ends[b], lever), skeleton.offsets[b], grid.steps[b]});
  }

  // Writes the numbers [frames, blocks, 3, kBoneBlock] of so many poses [frames, bones, 4], at most kBoneBlock.
  void operator()(const double* rotations, int frames, std::int32_t* numbers) {
    const int hips = skeleton_.roles.hips;
    const std::size_t pose = std::size_t{4} * skeleton_.size();
    for (int b = 0; b < skeleton_.size(); ++b, rotations += 4) {
      Posed& posed = posed_[b];
      for (int i = 0; i < kBoneBlock; ++i) {
        for (int part = 0; part < 4; ++part) posed.exact[part][i] = rotations[pose * std::min(i, frames - 1) + part];
      }
      if (b != hips && skeleton_.is_below(b, hips)) {
        follow(bones_[b], posed_[skeleton_.parents[b]], posed);
      } else {
        begin(bones_[b], posed);
      }
      for (int axis = 0; axis < 3; ++axis) {
        std::int32_t* to = numbers + place_of(b, axis, 3);
        for (int i = 0; i < frames; ++i, to += width_) *to = static_cast<std::int32_t>(posed.steps[axis][i]);
      }
    }
  }

 private:
  template <int kParts>
  using Lanes = std::array<std::array<double, kBoneBlock>, kParts>;

  struct Bone {
    Quaternion usual;
    Matrix3 aim;
    Vector3 offset;
    double step;
  };

  // A bone in these poses.
  struct Posed {
    Lanes<4> exact{}, kept{};  // in the world; at first `exact` is the rotation in the parent
    Lanes<3> off{};            // from its head as it is kept to where it is
    Lanes<3> steps{};
  };

  [[gnu::always_inline]] static Quaternion turn(const Lanes<4>& lanes, int i) {
    return {lanes[0][i], lanes[1][i], lanes[2][i], lanes[3][i]};
  }
  [[gnu::always_inline]] static void set(const Quaternion& turn, int i, Lanes<4>& lanes) {
    lanes[0][i] = turn.w(), lanes[1][i] = turn.x(), lanes[2][i] = turn.y(), lanes[3][i] = turn.z();
  }

  // The nearest whole number: so far from 0 doubles are whole.
  [[gnu::always_inline]] static double rounded(double number) {
    const double far = 3LL << 51;
    return (number + far) - far;
  }

  // Writes the numbers of a bone's turn; returns the rotation that they stand for.
  [[gnu::always_inline]] static Quaternion keep(const Bone& bone, const Quaternion& wanted, int i, Posed& posed) {
    const Vector3 turn = turn_of(product(bone.usual.conjugate(), wanted));
    const double x = rounded(turn.x() / bone.step), y = rounded(turn.y() / bone.step),
                 z = rounded(turn.z() / bone.step);
    posed.steps[0][i] = x, posed.steps[1][i] = y, posed.steps[2][i] = z;
    return product(bone.usual, rotation_of(bone.step * x, bone.step * y, bone.step * z));
  }

  FRAGMOTION_VECTORISED static void begin(Bone bone, Posed& posed) {
    for (int i = 0; i < kBoneBlock; ++i) set(keep(bone, turn(posed.exact, i), i, posed), i, posed.kept);
  }

  // The bone is turned so that its ends are where they should be, from where its head is.
  FRAGMOTION_VECTORISED static void follow(Bone bone, const Posed& __restrict parent, Posed& __restrict posed) {
    const Matrix3& aim = bone.aim;
    for (int i = 0; i < kBoneBlock; ++i) {
      const Quaternion above = turn(parent.exact, i), kept = turn(parent.kept, i),
                       exact = product(above, turn(posed.exact, i));
      const Vector3 there = turned(above, bone.offset), here = turned(kept, bone.offset);
      const double x = parent.off[0][i] + there.x() - here.x(), y = parent.off[1][i] + there.y() - here.y(),
                   z = parent.off[2][i] + there.z() - here.z();
      const Vector3 seen = turned(exact.conjugate(), {x, y, z});
      const auto turned_by = [&](int row) {
        return (aim(row, 0) * seen.x() + (aim(row, 1) * seen.y() + aim(row, 2) * seen.z())) / 4;
      };
      const Quaternion aimed = product(exact, rotation_of(turned_by(0), turned_by(1), turned_by(2)));
      set(exact, i, posed.exact);
      posed.off[0][i] = x, posed.off[1][i] = y, posed.off[2][i] = z;
      set(product(kept, keep(bone, product(kept.conjugate(), aimed), i, posed)), i, posed.kept);
    }
  }

  const Skeleton& skeleton_;
  std::size_t width_;  // numbers of a pose
  std::vector<Bone> bones_;
  std::vector<Posed> posed_;
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
  BitWriter(const BitWriter&) = delete;
  BitWriter& operator=(const BitWriter&) = delete;
  ~BitWriter() {
    for (; count_ > 0; count_ -= 8) write_byte();
  }

  void operator()(std::uint32_t number, int bits) {
    held_ |= std::uint64_t{number} << count_;
    for (count_ += bits; count_ >= 8; count_ -= 8) write_byte();
  }

 private:
  void write_byte() {
    *bytes_++ = held_ & 0xff;
    held_ >>= 8;
  }

  std::uint8_t* bytes_;
  std::uint64_t held_ = 0;
  int count_ = 0;  // bits that are held
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
  for (int f = 0; f < clip.frames; f += kBoneBlock) {
    quantizer(&clip.rotations[std::size_t{4} * skeleton.size() * f], std::min(kBoneBlock, clip.frames - f),
              &steps[width * f]);
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
  const std::vector<Quaternion> means = mean_rotations(clips, grid.bones);
  for (int b = 0; b < grid.bones; ++b) {
    set_rotation(means[b], b, grid.usual);
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
