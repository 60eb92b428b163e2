// SPDX-License-Identifier: MIT
#include "fragments/entry_poses.hpp"

#include <algorithm>

#include "base/rounding.hpp"
#include "fragments/body_tips.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

// Of each fragment that begins with the mirror image of another's poses, the number of that; -1 of the others. Images
// are in the order of their originals, or are not all found.
[[gnu::cold]] std::vector<int> originals_of(const PackedPool& pool, const std::vector<Fragment>& fragments) {
  std::vector<int> originals;
  auto next = fragments.begin();
  for (const Fragment& image : fragments) {
    originals.push_back(-1);
    const PackedClip& shown = pool.clips[image.clip];
    if (!shown.mirrored) continue;
    next = std::find_if(next, fragments.end(), [&](const Fragment& f) {
      const PackedClip& clip = pool.clips[f.clip];
      return !clip.mirrored && clip.poses == shown.poses && f.first_played() == image.first_played();
    });
    if (next != fragments.end()) originals.back() = static_cast<int>(next - fragments.begin());
  }
  return originals;
}

// Of each point of two poses that is seen of a mirror image the original's; empty where there is none of one.
[[gnu::cold]] std::vector<int> mirrored_points(const PackedPool& pool) {
  const std::vector<int> measured = measured_bones(pool.skeleton), &bones = pool.clips[0].grid->mirror.counterparts;
  std::vector<int> points;
  for (std::size_t i = 0; i < 2 * measured.size() && !bones.empty(); ++i) {
    const std::size_t pose = i / measured.size() * measured.size();
    const auto found = std::find(measured.begin(), measured.end(), bones[measured[i - pose]]);
    if (found == measured.end()) return {};
    points.push_back(static_cast<int>(pose + (found - measured.begin())));
  }
  return points;
}

void write_image(const float* original, const std::vector<int>& points, int stride, float* rows) {
  for (const int point : points) {
    rows[0] = -original[point];
    rows[stride] = original[stride + point];
    rows[2 * stride] = original[2 * stride + point];
    ++rows;
  }
}

void write(const PackedPool& pool, const Fragment& f, TipWriter& tips, int stride, float* rows) {
  const PackedClip& clip = pool.clips[f.clip];
  CharacterFrame frame;
  for (int later = 0; later < 2; ++later) {
    const double at = f.first_played() + later * kEntry * clip.rate;
    const RootPose root = sample_pose(clip, at, clip.grid->bones, tips.rotations());
    if (later == 0) frame = root.frame();
    tips.add(root.place, frame, rows, stride, later * tips.points());
  }
}

}  // namespace

std::vector<float> entry_poses(const PackedPool& pool) { return entry_poses(pool, pool.fragments); }

// A body that is its own mirror image shows so in one pose, as each bone does.
[[gnu::cold]] std::vector<float> entry_poses(const PackedPool& pool, const std::vector<Fragment>& fragments) {
  if (fragments.empty()) return {};
  TipWriter tips(pool.skeleton);
  const int stride = padded(2 * tips.points());
  const std::size_t row = std::size_t{3} * stride, count = fragments.size();
  std::vector<float> poses, image(row);
  poses.reserve(count * row);
  const std::vector<int> points = mirrored_points(pool), originals = originals_of(pool, fragments);
  const auto is_image = [&](std::size_t i) { return originals[i] >= 0 && !points.empty(); };
  std::size_t first = 0;
  while (first < count && !is_image(first)) ++first;
  for (std::size_t i = 0; i < count; ++i) {
    poses.resize(row * (i + 1));
    if (i == first || !is_image(i)) write(pool, fragments[i], tips, stride, &poses[row * i]);
  }
  tips.flush();
  if (first == count) return poses;
  write_image(&poses[row * originals[first]], points, stride, image.data());
  const bool is_even = tip_distance(image.data(), &poses[row * first], stride) < 2 * tips.points() * kFileRounding;
  for (std::size_t i = first + 1; i < count; ++i) {
    if (is_image(i) && is_even) write_image(&poses[row * originals[i]], points, stride, &poses[row * i]);
    if (is_image(i) && !is_even) write(pool, fragments[i], tips, stride, &poses[row * i]);
  }
  tips.flush();
  return poses;
}

}  // namespace fragmotion
