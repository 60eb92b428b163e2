// SPDX-License-Identifier: MIT
#include "motion/packed_clip.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/rounding.hpp"
#include "base/take_limits.hpp"
#include "base/vectorised.hpp"

namespace fragmotion {
namespace {

constexpr double kMostSteps = 1 << PackedPoses::kMostBits;

inline std::uint32_t read_bits(const std::uint8_t* bytes, unsigned at, std::uint32_t mask) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes + (at >> 3), sizeof word);
  return (word >> (at & 7)) & mask;
}

constexpr std::uint32_t mask_of(int bits) { return (std::uint32_t{1} << bits) - 1; }

// The poses on both sides of a time, and how near it is to the second.
struct PackedBetween {
  int frame;
  const std::uint8_t *pose, *next;
  double weight;

  PackedBetween(const PackedClip& clip, double at) : frame(std::clamp(static_cast<int>(at), 0, clip.frames - 1)) {
    const std::size_t bytes = clip.poses->pose_bytes;
    pose = &clip.poses->bytes[bytes * frame];
    next = pose + (frame + 1 < clip.frames ? bytes : 0);
    weight = std::clamp(at - frame, 0.0, 1.0);
  }

  // Writes place and heading; returns where the turns begin.
  unsigned root(const PackedClip& clip, double* values) const {
    const PackedPoses& poses = *clip.poses;
    unsigned at = 0;
    for (int i = 0; i < PackedPoses::kRootNumbers; ++i) {
      const std::uint32_t mask = mask_of(poses.bits[i]);
      const double a = read_bits(pose, at, mask), b = read_bits(next, at, mask);
      values[i] = poses.origin[i] + poses.steps[i] * (a + weight * (b - a));
      at += poses.bits[i];
    }
    if (clip.mirrored) {
      for (const int i : {0, 3}) values[i] = -values[i];
    }
    return at;
  }
};

void require(bool holds) {
  if (!holds) throw std::invalid_argument("its packed poses do not fit together");
}

[[gnu::cold]] void check_rotations(const std::vector<float>& lanes, const PoseGrid& grid) {
  require(lanes.size() == std::size_t{4} * kBoneBlock * grid.blocks());
  for (int b = 0; b < kBoneBlock * grid.blocks(); ++b)
    require(std::abs(quaternion_of(lanes, b).norm() - 1) < kFloatRounding);
}

[[gnu::cold]] void check_mirror(const PoseGrid& grid) {
  const std::vector<int>& counterparts = grid.mirror.counterparts;
  require(static_cast<int>(counterparts.size()) == grid.bones);
  for (int b = 0; b < grid.bones; ++b) {
    require(counterparts[b] >= 0 && counterparts[b] < grid.bones && counterparts[counterparts[b]] == b);
  }
  check_rotations(grid.mirror.before, grid);
  check_rotations(grid.mirror.after, grid);
}

[[gnu::cold]] void check_poses(const PackedPoses& poses, int frames, const PoseGrid& grid) {
  const std::size_t turns = std::size_t{3} * kBoneBlock * grid.blocks();
  require(poses.least.size() == turns && poses.bits.size() == PackedPoses::kRootNumbers + turns);
  for (const int bits : poses.bits) require(bits <= PackedPoses::kMostBits);
  for (const std::int32_t number : poses.least) require(std::abs(static_cast<double>(number)) < kMostSteps);
  for (int i = 0; i < PackedPoses::kRootNumbers; ++i) {
    require(poses.steps[i] > 0 && std::abs(poses.origin[i]) < kLargestNumber &&
            poses.steps[i] * kMostSteps < kLargestNumber);
  }
  require(poses.pose_bytes == bytes_for(poses.bits) &&
          poses.bytes.size() == poses.pose_bytes * frames + PackedPoses::kSpare);
}

using Turns = std::int32_t[3][kBoneBlock];

// Reads the turns of a block of bones from a pose, from a bit on, and of a second pose where there is one; returns the
// bit after them.
template <bool kTwo>
[[gnu::always_inline]] inline unsigned read_turns(const std::uint8_t* pose, const std::uint8_t* next, unsigned bit,
                                                  const std::uint8_t* bits, const std::int32_t* least, Turns& first,
                                                  Turns& second) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kBoneBlock; ++i) {
      const std::uint32_t mask = mask_of(*bits);
      first[axis][i] = *least + static_cast<std::int32_t>(read_bits(pose, bit, mask));
      if (kTwo) second[axis][i] = *least + static_cast<std::int32_t>(read_bits(next, bit, mask));
      ++least;
      bit += *bits++;
    }
  }
  return bit;
}

// Unit quaternions from the turns x, y, z that are given in steps.
[[gnu::always_inline]] inline void write_turns(const Turns& numbers, const float* steps, TurnBlock& __restrict turns) {
  for (int i = 0; i < kBoneBlock; ++i) {
    const float a = steps[i] * static_cast<float>(numbers[0][i]), b = steps[i] * static_cast<float>(numbers[1][i]),
                c = steps[i] * static_cast<float>(numbers[2][i]), square = a * a + b * b + c * c,
                scale = 1 / (1 + square);
    turns.w[i] = (1 - square) * scale;
    turns.x[i] = 2 * scale * a;
    turns.y[i] = 2 * scale * b;
    turns.z[i] = 2 * scale * c;
  }
}

// Quaternions of a block of bones.
struct LaneQuaternions : TurnBlock {
  // So far straight from one to another, on the shorter way, made unit. They are read where they are: copied in small
  // parts, they would have to be waited for before they are loaded in large ones.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the loop fills them
  [[gnu::always_inline]] LaneQuaternions(const TurnBlock& from, const TurnBlock& to, float weight) {
    for (int i = 0; i < kBoneBlock; ++i) {
      const float p = from.w[i], q = from.x[i], r = from.y[i], s = from.z[i];
      const float side = p * to.w[i] + q * to.x[i] + r * to.y[i] + s * to.z[i] < 0 ? -weight : weight;
      const float d = p + (side * to.w[i] - weight * p), a = q + (side * to.x[i] - weight * q),
                  b = r + (side * to.y[i] - weight * r), c = s + (side * to.z[i] - weight * s),
                  scale = 1 / std::sqrt(d * d + a * a + b * b + c * c);
      w[i] = scale * d;
      x[i] = scale * a;
      y[i] = scale * b;
      z[i] = scale * c;
    }
  }

  // Turns by rotations [4, kBoneBlock] first.
  [[gnu::always_inline]] void turn_after(const float* first) {
    const float *p = first, *q = p + kBoneBlock, *r = q + kBoneBlock, *s = r + kBoneBlock;
    for (int i = 0; i < kBoneBlock; ++i) {
      const float a = w[i], b = x[i], c = y[i], d = z[i];
      w[i] = a * p[i] - b * q[i] - c * r[i] - d * s[i];
      x[i] = a * q[i] + b * p[i] + c * s[i] - d * r[i];
      y[i] = a * r[i] - b * s[i] + c * p[i] + d * q[i];
      z[i] = a * s[i] + b * r[i] - c * q[i] + d * p[i];
    }
  }

  // Turns by rotations [4, kBoneBlock] afterwards.
  [[gnu::always_inline]] void turn_by(const float* last) {
    const float *p = last, *q = p + kBoneBlock, *r = q + kBoneBlock, *s = r + kBoneBlock;
    for (int i = 0; i < kBoneBlock; ++i) turn_by(p[i], q[i], r[i], s[i], i);
  }

  // Turns one of them in the world.
  [[gnu::always_inline]] void turn_by(int lane, const PlaneTurn& half) {
    const auto c = static_cast<float>(half.cosine), s = static_cast<float>(half.sine);
    for (int i = 0; i < kBoneBlock; ++i) turn_by(i == lane ? c : 1, 0, 0, i == lane ? s : 0, i);
  }

  // Turns by what is left of the turns of a block, of which so many are in a row.
  [[gnu::always_inline]] void turn_by(const FadingTurns& fading, const float* turns, int row) {
    const float *u = turns, *v = u + row, *t = v + row, *to_u = t + row, *to_v = to_u + row, *to_t = to_v + row;
    const float offset = fading.offset, speed = fading.speed;
    for (int i = 0; i < kBoneBlock; ++i) {
      const float a = offset * u[i] + speed * to_u[i], b = offset * v[i] + speed * to_v[i],
                  c = offset * t[i] + speed * to_t[i], square = a * a + b * b + c * c, scale = 1 / (1 + square);
      turn_by((1 - square) * scale, 2 * scale * a, 2 * scale * b, 2 * scale * c, i);
    }
  }

  // Into [bones, 4], of a block of bones in the clip's order.
  [[gnu::always_inline]] void write(const PackedClip& clip, int first, double* rotations) const {
    float written[kBoneBlock][4];
    for (int i = 0; i < kBoneBlock; ++i) {
      written[i][0] = w[i];
      written[i][1] = x[i];
      written[i][2] = y[i];
      written[i][3] = z[i];
    }
    const int count = std::min(kBoneBlock, clip.grid->bones - first);
    if (clip.mirrored) {
      for (int i = 0; i < count; ++i)
        std::copy_n(written[i], 4, rotations + std::ptrdiff_t{4} * clip.grid->mirror.counterparts[first + i]);
    } else {
      std::copy_n(&written[0][0], count < kBoneBlock ? 4 * count : 4 * kBoneBlock,
                  rotations + std::ptrdiff_t{4} * first);
    }
  }

 private:
  [[gnu::always_inline]] void turn_by(float a, float b, float c, float d, int i) {
    const float p = w[i], q = x[i], r = y[i], s = z[i];
    w[i] = a * p - b * q - c * r - d * s;
    x[i] = a * q + b * p + c * s - d * r;
    y[i] = a * r - b * s + c * p + d * q;
    z[i] = a * s + b * r - c * q + d * p;
  }
};

// Writes the turns of a block of bones in a pose, which begin at a bit of it, and in a second one where there is one:
// both at once take less time. Returns the bit after them.
FRAGMOTION_VECTORISED unsigned unpack_block(const PackedClip& clip, int block, const std::uint8_t* pose,
                                            const std::uint8_t* next, unsigned bit, TurnBlock& turns,
                                            TurnBlock& next_turns) {
  const std::size_t first = static_cast<std::size_t>(kBoneBlock) * block;
  const std::int32_t* least = &clip.poses->least[3 * first];
  const std::uint8_t* bits = &clip.poses->bits[PackedPoses::kRootNumbers + 3 * first];
  const float* steps = &clip.grid->steps[first];
  Turns a, b;
  bit = next != nullptr ? read_turns<true>(pose, next, bit, bits, least, a, b)
                        : read_turns<false>(pose, pose, bit, bits, least, a, b);
  write_turns(a, steps, turns);
  if (next != nullptr) write_turns(b, steps, next_turns);
  return bit;
}

// Writes the rotations of a block of bones that are so far from the turns of a pose to those of the next, and turned
// further; without the fading turns into `plain`.
FRAGMOTION_VECTORISED void blend_block(const PackedClip& clip, int block, const TurnBlock& pose, const TurnBlock& next,
                                       float weight, const PoseTurns& further, TurnBlock& plain, double* rotations) {
  const PoseGrid& grid = *clip.grid;
  const int first = kBoneBlock * block, row = std::min(kBoneBlock, grid.bones - first);
  const std::size_t lanes = std::size_t{4} * first;
  LaneQuaternions turns(pose, next, weight);
  if (clip.mirrored) turns.turn_after(&grid.mirror.after[lanes]);
  turns.turn_by(clip.mirrored ? &grid.mirror.before[lanes] : &grid.usual[lanes]);
  const int hips = clip.lane_of(further.hips) - first;
  if (hips >= 0 && hips < kBoneBlock) turns.turn_by(hips, further.half);
  plain = turns;
  const FadingTurns& fading = further.fading;
  if (fading.lanes != nullptr) turns.turn_by(fading, fading.lanes + std::ptrdiff_t{6} * first, row);
  turns.write(clip, first, rotations);
}

}  // namespace

Quaternion quaternion_of(const std::vector<float>& lanes, int bone) {
  const auto at = [&](int axis) { return static_cast<double>(lanes[place_of(bone, axis, 4)]); };
  return {at(0), at(1), at(2), at(3)};
}

std::size_t bytes_for(const std::vector<std::uint8_t>& bits) {
  std::size_t sum = 0;
  for (const int each : bits) sum += each;
  return std::max<std::size_t>(1, (sum + 7) / 8);
}

[[gnu::cold]] PackedClip mirror_image(const PackedClip& original, std::string name) {
  PackedClip image = original;
  image.name = std::move(name);
  image.mirrored = true;
  return image;
}

[[gnu::cold]] int original_of(const std::vector<PackedClip>& clips, std::size_t mirrored) {
  if (!clips[mirrored].mirrored) return -1;
  const auto found = std::find_if(clips.begin(), clips.end(), [&](const PackedClip& clip) {
    return !clip.mirrored && clip.poses == clips[mirrored].poses;
  });
  return found == clips.end() ? -1 : static_cast<int>(found - clips.begin());
}

[[gnu::cold]] Clip unpack(const PackedClip& packed) {
  const int bones = packed.grid->bones;
  Clip clip{packed.name, packed.rate, packed.frames, {}, {}, {}, packed.markers};
  clip.root_positions.resize(std::size_t{3} * clip.frames);
  clip.rotations.resize(std::size_t{4} * bones * clip.frames);
  for (int f = 0; f < clip.frames; ++f) {
    const RootPose root = sample_pose(packed, f, bones, &clip.rotations[std::size_t{4} * bones * f]);
    store_vector(root.place, &clip.root_positions[std::size_t{3} * f]);
    clip.headings.push_back(root.heading);
  }
  return clip;
}

Vector3 sample_pose(const PackedClip& clip, double at, double* rotations) {
  return sample_pose(clip, at, clip.grid->bones, rotations).place;
}

RootPose sample_pose(const PackedClip& clip, double at, int bones, double* rotations) {
  const int blocks = clip.mirrored ? clip.grid->blocks() : (bones + kBoneBlock - 1) / kBoneBlock;
  const PackedBetween between(clip, at);
  double root[PackedPoses::kRootNumbers];
  unsigned bit = between.root(clip, root);
  const bool is_between = between.weight > 0;
  for (int block = 0; block < blocks; ++block) {
    TurnBlock pose, next, plain;  // NOLINT(cppcoreguidelines-pro-type-member-init): these functions fill them
    bit = unpack_block(clip, block, between.pose, is_between ? between.next : nullptr, bit, pose, next);
    blend_block(clip, block, pose, is_between ? next : pose, static_cast<float>(between.weight), {}, plain, rotations);
  }
  return {{root[0], root[1], root[2]}, root[3]};
}

[[gnu::cold]] UnpackedPoses::UnpackedPoses(int bones)
    : blocks_((bones + kBoneBlock - 1) / kBoneBlock), turns_(packed_.size() * blocks_), plain_(blocks_) {}

RootPose UnpackedPoses::sample(const PackedClip& clip, double at, const PoseTurns& further, double* rotations) {
  const PackedBetween between(clip, at);
  double root[PackedPoses::kRootNumbers];
  unsigned bit = between.root(clip, root);
  const bool is_between = between.weight > 0;
  const std::size_t slot = between.frame % packed_.size(), next_slot = (slot + (is_between ? 1 : 0)) % packed_.size();
  TurnBlock *pose = &turns_[blocks_ * slot], *next = &turns_[blocks_ * next_slot];
  const bool lacks = std::exchange(packed_[slot], between.pose) != between.pose,
             lacks_next = is_between && std::exchange(packed_[next_slot], between.next) != between.next;
  for (int block = 0; block < blocks_; ++block) {
    if (lacks) {
      bit = unpack_block(clip, block, between.pose, lacks_next ? between.next : nullptr, bit, pose[block], next[block]);
    } else if (lacks_next) {
      bit = unpack_block(clip, block, between.next, nullptr, bit, next[block], next[block]);
    }
    blend_block(clip, block, pose[block], next[block], static_cast<float>(between.weight), further, plain_[block],
                rotations);
  }
  return {{root[0], root[1], root[2]}, root[3]};
}

RootPose root_at(const PackedClip& clip, double at) {
  double root[PackedPoses::kRootNumbers];
  PackedBetween(clip, at).root(clip, root);
  return {{root[0], root[1], root[2]}, root[3]};
}

[[gnu::cold]] void check(const PoseGrid& grid, const Skeleton& skeleton) {
  require(grid.bones == skeleton.size() && grid.steps.size() == static_cast<std::size_t>(kBoneBlock) * grid.blocks());
  check_rotations(grid.usual, grid);
  for (const float step : grid.steps) require(step > 0 && step <= 1);
  if (!grid.mirror.empty()) check_mirror(grid);
}

[[gnu::cold]] void check(const PackedClip& clip) {
  require(clip.rate > 0 && clip.rate <= kHighestRate && clip.frames >= 2);
  require(!clip.mirrored || !clip.grid->mirror.empty());
  check_poses(*clip.poses, clip.frames, *clip.grid);
  check_markers(clip.markers, clip.frames);
}

}  // namespace fragmotion
