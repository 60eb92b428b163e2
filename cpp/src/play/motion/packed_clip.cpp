// SPDX-License-Identifier: MIT
#include "motion/packed_clip.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/vectorised.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

// Lengths are those of a character of 1.8 m.
constexpr double kMostOff = 0.045 * kPi / 180;  // rad that a bone's rotation in the world may be off
constexpr double kReach = 0.75e-3;              // m that a tip may be off because of the turns of its chain
constexpr double kPlace = 0.15e-3;              // m that the hips may be off
constexpr double kHeading = 1e-3;               // rad
constexpr double kFinest = 2e-7;                // step of a turn that single precision still tells apart
const double kOff = 2 * std::sqrt(3.0);         // rad that a rotation may be off for a step of 1
constexpr int kRootNumbers = 4;
constexpr double kUnit = 1e-6;  // that a usual rotation may be off
constexpr double kMostSteps = 1 << PackedClip::kMostBits;
constexpr double kFarthest = 1e12;  // m, and rad: where places are still told apart

// Bones of each chain of bones from the hips on that is the longest through a bone.
std::vector<int> chain_lengths(const Skeleton& skeleton, int hips) {
  std::vector<int> lengths(skeleton.size(), 1);
  for (int b = hips + 1; b < skeleton.size(); ++b) {
    if (skeleton.is_below(b, hips)) lengths[b] = lengths[skeleton.parents[b]] + 1;
  }
  for (int b = skeleton.size() - 1; b > hips; --b) {
    int& above = lengths[skeleton.parents[b]];
    above = std::max(above, lengths[b]);
  }
  return lengths;
}

// How far each bone carries its tip or a bone that hangs on it.
std::vector<double> bone_lengths(const Skeleton& skeleton) {
  std::vector<double> lengths;
  for (const Vector3& tip : skeleton.tips) lengths.push_back(tip.norm());
  for (int b = 1; b < skeleton.size(); ++b) {
    double& above = lengths[skeleton.parents[b]];
    above = std::max(above, skeleton.offsets[b].norm());
  }
  return lengths;
}

std::size_t number_of(int bone, int axis, int axes) {
  return static_cast<std::size_t>(bone / kBoneBlock * axes + axis) * kBoneBlock + bone % kBoneBlock;
}

Quaternion usual_rotation(const PoseGrid& grid, int bone) {
  const auto at = [&](int axis) { return static_cast<double>(grid.usual[number_of(bone, axis, 4)]); };
  return {at(0), at(1), at(2), at(3)};
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

// axis * tan(angle / 4), where the angle is at most half a turn.
Vector3 turn_of(const Quaternion& q) { return q.w() < 0 ? Vector3{-q.vec() / (1 - q.w())} : q.vec() / (1 + q.w()); }

Quaternion rotation_of(const Vector3& turn) {
  const double square = turn.squaredNorm(), scale = 1 / (1 + square);
  Quaternion q;
  q.w() = (1 - square) * scale;
  q.vec() = 2 * scale * turn;
  return q;
}

// The turns of a clip's poses in whole steps. Each bone's turn makes good what its parent's leaves.
class Quantizer {
 public:
  Quantizer(const Skeleton& skeleton, const PoseGrid& grid)
      : skeleton_(skeleton), grid_(grid), follows_(skeleton.size()), exact_(skeleton.size()), kept_(skeleton.size()) {
    const int hips = skeleton.roles.hips;
    for (int b = 0; b < skeleton.size(); ++b) {
      follows_[b] = b != hips && skeleton.is_below(b, hips);
      usual_.push_back(usual_rotation(grid, b));
    }
  }

  // Writes a pose's numbers [blocks, 3, kBoneBlock].
  void operator()(const double* rotations, std::int32_t* numbers) {
    for (int b = 0; b < skeleton_.size(); ++b) {
      const int parent = skeleton_.parents[b];
      const Quaternion local = load_quaternion(rotations + std::ptrdiff_t{4} * b);
      exact_[b] = follows_[b] ? exact_[parent] * local : local;
      const Quaternion wanted = follows_[b] ? kept_[parent].conjugate() * exact_[b] : local;
      const double step = grid_.steps[b];
      const Vector3 steps = (turn_of(usual_[b].conjugate() * wanted) / step).array().round();
      for (int axis = 0; axis < 3; ++axis) numbers[number_of(b, axis, 3)] = static_cast<std::int32_t>(steps[axis]);
      const Quaternion kept = usual_[b] * rotation_of(step * steps);
      kept_[b] = follows_[b] ? kept_[parent] * kept : kept;
    }
  }

 private:
  const Skeleton& skeleton_;
  const PoseGrid& grid_;
  std::vector<bool> follows_;
  std::vector<Quaternion> usual_, exact_, kept_;
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

inline std::uint32_t read_bits(const std::uint8_t* bytes, unsigned at, std::uint32_t mask) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes + (at >> 3), sizeof word);
  return (word >> (at & 7)) & mask;
}

constexpr std::uint32_t mask_of(int bits) { return (std::uint32_t{1} << bits) - 1; }

// Place and heading of each frame: root x, y, z, heading.
double root_value(const Clip& clip, int frame, int number) {
  return number < 3 ? clip.root_positions[std::size_t{3} * frame + number] : clip.headings[frame];
}

void measure_root(const Clip& clip, double scale, PackedClip& packed) {
  constexpr double kMost = mask_of(PackedClip::kMostBits);
  for (int number = 0; number < kRootNumbers; ++number) {
    double low = root_value(clip, 0, number), high = low;
    for (int f = 1; f < clip.frames; ++f) {
      low = std::min(low, root_value(clip, f, number));
      high = std::max(high, root_value(clip, f, number));
    }
    const double wanted = number < 3 ? 2 * kPlace / std::sqrt(3.0) / scale : kHeading;
    packed.origin[number] = low;
    packed.steps[number] = std::max(wanted, (high - low) / kMost);
    packed.bits.push_back(static_cast<std::uint8_t>(
        bits_for(static_cast<std::uint32_t>(std::round((high - low) / packed.steps[number])))));
  }
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

void measure_turns(const std::vector<std::int32_t>& steps, PackedClip& packed) {
  const std::size_t width = packed.least.size();
  std::vector<std::int32_t> most(steps.begin(), steps.begin() + width);
  std::copy_n(steps.begin(), width, packed.least.begin());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    std::int32_t &low = packed.least[i % width], &high = most[i % width];
    low = std::min(low, steps[i]);
    high = std::max(high, steps[i]);
  }
  for (std::size_t i = 0; i < width; ++i) {
    packed.bits.push_back(static_cast<std::uint8_t>(bits_for(most[i] - packed.least[i])));
  }
}

std::size_t bytes_for(const std::vector<std::uint8_t>& bits) {
  std::size_t sum = 0;
  for (const int each : bits) sum += each;
  return std::max<std::size_t>(1, (sum + 7) / 8);
}

void write_poses(const Clip& clip, const std::vector<std::int32_t>& steps, PackedClip& packed) {
  const std::size_t bytes = bytes_for(packed.bits), width = packed.least.size();
  packed.poses.assign(bytes * clip.frames + PackedClip::kSpare, 0);
  for (int f = 0; f < clip.frames; ++f) {
    BitWriter write(&packed.poses[bytes * f]);
    for (int i = 0; i < kRootNumbers; ++i) {
      const double number = (root_value(clip, f, i) - packed.origin[i]) / packed.steps[i];
      write(static_cast<std::uint32_t>(std::round(number)), packed.bits[i]);
    }
    for (std::size_t i = 0; i < width; ++i) {
      write(steps[width * f + i] - packed.least[i], packed.bits[kRootNumbers + i]);
    }
  }
}

// The poses on both sides of a time, and how near it is to the second.
struct PackedBetween {
  const std::uint8_t *pose, *next;
  double weight;

  PackedBetween(const PackedClip& clip, double at) {
    const int frame = std::clamp(static_cast<int>(std::floor(at)), 0, clip.frames - 1);
    const std::size_t bytes = clip.pose_bytes();
    pose = &clip.poses[bytes * frame];
    next = pose + (frame + 1 < clip.frames ? bytes : 0);
    weight = std::clamp(at - frame, 0.0, 1.0);
  }

  // Writes place and heading, as far as asked for; returns where the turns begin.
  unsigned root(const PackedClip& clip, double* values) const {
    unsigned at = 0;
    for (int i = 0; i < kRootNumbers; ++i) {
      const std::uint32_t mask = mask_of(clip.bits[i]);
      const double a = read_bits(pose, at, mask), b = read_bits(next, at, mask);
      values[i] = clip.origin[i] + clip.steps[i] * (a + weight * (b - a));
      at += clip.bits[i];
    }
    return at;
  }
};

void require(bool holds) {
  if (!holds) throw std::invalid_argument("its packed poses do not fit together");
}

void check_grid(const PoseGrid& grid, int bones) {
  require(grid.bones == bones && grid.usual.size() == std::size_t{4} * kBoneBlock * grid.blocks() &&
          grid.steps.size() == static_cast<std::size_t>(kBoneBlock) * grid.blocks());
  for (int b = 0; b < kBoneBlock * grid.blocks(); ++b) {
    require(std::abs(usual_rotation(grid, b).norm() - 1) < kUnit);
    require(grid.steps[b] > 0 && grid.steps[b] <= 1);
  }
}

using Lanes = float[kBoneBlock];

// Unit quaternions from the turns x, y, z that are given in steps.
struct LaneQuaternions {
  Lanes w, x, y, z;

  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the loop fills them
  [[gnu::always_inline]] LaneQuaternions(const std::int32_t (&numbers)[3][kBoneBlock], const float* steps) {
    for (int i = 0; i < kBoneBlock; ++i) {
      const float a = steps[i] * static_cast<float>(numbers[0][i]), b = steps[i] * static_cast<float>(numbers[1][i]),
                  c = steps[i] * static_cast<float>(numbers[2][i]), square = a * a + b * b + c * c,
                  scale = 1 / (1 + square);
      w[i] = (1 - square) * scale;
      x[i] = 2 * scale * a;
      y[i] = 2 * scale * b;
      z[i] = 2 * scale * c;
    }
  }

  // Goes straight to another rotation, on the shorter way, and makes the result unit.
  [[gnu::always_inline]] void blend(const LaneQuaternions& to, float weight) {
    for (int i = 0; i < kBoneBlock; ++i) {
      const float side = w[i] * to.w[i] + x[i] * to.x[i] + y[i] * to.y[i] + z[i] * to.z[i] < 0 ? -weight : weight;
      const float d = w[i] + (side * to.w[i] - weight * w[i]), a = x[i] + (side * to.x[i] - weight * x[i]),
                  b = y[i] + (side * to.y[i] - weight * y[i]), c = z[i] + (side * to.z[i] - weight * z[i]),
                  scale = 1 / std::sqrt(d * d + a * a + b * b + c * c);
      w[i] = scale * d;
      x[i] = scale * a;
      y[i] = scale * b;
      z[i] = scale * c;
    }
  }

  // These after the rotations `from` [4, kBoneBlock], into [kBoneBlock, 4].
  [[gnu::always_inline]] void write(const float* from, float (&to)[kBoneBlock][4]) const {
    const float *a = from, *b = a + kBoneBlock, *c = b + kBoneBlock, *d = c + kBoneBlock;
    for (int i = 0; i < kBoneBlock; ++i) {
      to[i][0] = a[i] * w[i] - b[i] * x[i] - c[i] * y[i] - d[i] * z[i];
      to[i][1] = a[i] * x[i] + b[i] * w[i] + c[i] * z[i] - d[i] * y[i];
      to[i][2] = a[i] * y[i] - b[i] * z[i] + c[i] * w[i] + d[i] * x[i];
      to[i][3] = a[i] * z[i] + b[i] * y[i] - c[i] * x[i] + d[i] * w[i];
    }
  }
};

}  // namespace

PoseGrid pose_grid(const Skeleton& skeleton, const std::vector<Clip>& clips) {
  PoseGrid grid;
  grid.bones = skeleton.size();
  grid.usual.assign(std::size_t{4} * kBoneBlock * grid.blocks(), 0);
  grid.steps.assign(static_cast<std::size_t>(kBoneBlock) * grid.blocks(), 1);
  const double scale = standard_scale(skeleton);
  const std::vector<int> chains = chain_lengths(skeleton, skeleton.roles.hips);
  const std::vector<double> lengths = bone_lengths(skeleton);
  for (int b = 0; b < kBoneBlock * grid.blocks(); ++b) {
    grid.usual[number_of(b, 0, 4)] = 1;
    if (b >= grid.bones) continue;
    const Quaternion usual = mean_rotation(clips, b, grid.bones);
    const double values[] = {usual.w(), usual.x(), usual.y(), usual.z()};
    for (int axis = 0; axis < 4; ++axis) grid.usual[number_of(b, axis, 4)] = static_cast<float>(values[axis]);
    const double off = std::min(kMostOff, kReach / (chains[b] * lengths[b] * scale));
    grid.steps[b] = static_cast<float>(std::max(kFinest, off / kOff));
  }
  return grid;
}

PackedClip pack(const Skeleton& skeleton, std::shared_ptr<const PoseGrid> grid, const Clip& clip) {
  PackedClip packed;
  packed.name = clip.name;
  packed.rate = clip.rate;
  packed.frames = clip.frames;
  packed.grid = std::move(grid);
  packed.least.resize(std::size_t{3} * kBoneBlock * packed.grid->blocks());
  measure_root(clip, standard_scale(skeleton), packed);
  const std::vector<std::int32_t> steps = steps_of(skeleton, *packed.grid, clip);
  measure_turns(steps, packed);
  write_poses(clip, steps, packed);
  return packed;
}

Clip unpack(const PackedClip& packed) {
  const int bones = packed.grid->bones;
  Clip clip{packed.name, packed.rate, packed.frames, {}, {}, {}};
  clip.root_positions.resize(std::size_t{3} * clip.frames);
  clip.rotations.resize(std::size_t{4} * bones * clip.frames);
  for (int f = 0; f < clip.frames; ++f) {
    store_vector(sample_pose(packed, f, &clip.rotations[std::size_t{4} * bones * f]),
                 &clip.root_positions[std::size_t{3} * f]);
    clip.headings.push_back(frame_at(packed, f).heading);
  }
  return clip;
}

FRAGMOTION_VECTORISED Vector3 sample_pose(const PackedClip& clip, double at, double* rotations) {
  const PoseGrid& grid = *clip.grid;
  const PackedBetween between(clip, at);
  double root[kRootNumbers];
  unsigned bit = between.root(clip, root);
  const std::int32_t* least = clip.least.data();
  const std::uint8_t* bits = &clip.bits[kRootNumbers];
  for (int block = 0; block < grid.blocks(); ++block) {
    std::int32_t a[3][kBoneBlock], b[3][kBoneBlock];
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < kBoneBlock; ++i) {
        const std::uint32_t mask = mask_of(*bits);
        a[axis][i] = *least + static_cast<std::int32_t>(read_bits(between.pose, bit, mask));
        b[axis][i] = *least++ + static_cast<std::int32_t>(read_bits(between.next, bit, mask));
        bit += *bits++;
      }
    }
    const float* steps = &grid.steps[static_cast<std::size_t>(kBoneBlock) * block];
    LaneQuaternions quaternions(a, steps);
    quaternions.blend(LaneQuaternions(b, steps), static_cast<float>(between.weight));
    float blended[kBoneBlock][4];
    quaternions.write(&grid.usual[std::size_t{4} * kBoneBlock * block], blended);
    const int first = kBoneBlock * block, values = 4 * std::min(kBoneBlock, grid.bones - first);
    std::copy_n(&blended[0][0], values, rotations + std::ptrdiff_t{4} * first);
  }
  return {root[0], root[1], root[2]};
}

CharacterFrame frame_at(const PackedClip& clip, double at) {
  double root[kRootNumbers];
  PackedBetween(clip, at).root(clip, root);
  return {{root[0], root[1]}, root[3]};
}

void check(const PackedClip& clip, const Skeleton& skeleton) {
  const PoseGrid& grid = *clip.grid;
  check_grid(grid, skeleton.size());
  const std::size_t turns = std::size_t{3} * kBoneBlock * grid.blocks();
  require(clip.rate > 0 && clip.rate <= kHighestRate && clip.frames >= 2);
  require(clip.least.size() == turns && clip.bits.size() == kRootNumbers + turns);
  for (const int bits : clip.bits) require(bits <= PackedClip::kMostBits);
  for (const std::int32_t number : clip.least) require(std::abs(static_cast<double>(number)) < kMostSteps);
  for (int i = 0; i < kRootNumbers; ++i) {
    require(clip.steps[i] > 0 && std::abs(clip.origin[i]) < kFarthest && clip.steps[i] * kMostSteps < kFarthest);
  }
  require(clip.poses.size() >= PackedClip::kSpare && (clip.poses.size() - PackedClip::kSpare) % clip.frames == 0 &&
          clip.pose_bytes() == bytes_for(clip.bits));
}

}  // namespace fragmotion
