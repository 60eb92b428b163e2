// SPDX-License-Identifier: MIT
#include "motion/clip.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "base/ranges.hpp"
#include "base/rounding.hpp"
#include "base/take_limits.hpp"
#include "motion/facing.hpp"

namespace fragmotion {

namespace {

[[noreturn]] void fail(const std::string& clip, const std::string& cause) {
  throw std::invalid_argument("clip '" + clip + "': " + cause);
}

std::string place(int frame, const std::string& bone) {
  return "frame " + std::to_string(frame) + ", bone '" + bone + "': ";
}

void check_shape(const Clip& clip, int bones) {
  if (!(clip.rate >= kLowestRate && clip.rate <= kHighestRate))
    fail(clip.name, "the rate is " + text_of(clip.rate) + " frames/s, expected " + text_of(kLowestRate) + " to " +
                        text_of(kHighestRate));
  if (clip.frames < 2) fail(clip.name, "has " + std::to_string(clip.frames) + " frames, expected at least 2");
  const std::size_t frames = clip.frames;
  if (clip.root_positions.size() != frames * 3)
    fail(clip.name, "has " + std::to_string(clip.root_positions.size()) + " root position values, expected " +
                        std::to_string(frames) + " frames x 3");
  if (clip.rotations.size() != frames * bones * 4)
    fail(clip.name, "has " + std::to_string(clip.rotations.size()) + " rotation values, expected " +
                        std::to_string(frames) + " frames x " + std::to_string(bones) + " bones x 4");
}

void check_positions(const Skeleton& skeleton, const Clip& clip) {
  for (std::size_t i = 0; i < clip.root_positions.size(); ++i) {
    const double value = clip.root_positions[i];
    if (std::abs(value) <= kFarthestBody) continue;
    const std::string cause = std::isfinite(value) ? "position is more than 1000 km from the origin: check the units"
                                                   : "position is not finite";
    fail(clip.name, place(static_cast<int>(i / 3), skeleton.names[skeleton.roles.hips]) + cause);
  }
}

void check_headings(const Clip& clip) {
  if (clip.headings.size() != static_cast<std::size_t>(clip.frames)) fail(clip.name, "needs a heading a frame");
  for (const double heading : clip.headings) {
    if (!std::isfinite(heading)) fail(clip.name, "has a heading that is not finite");
  }
}

/// Makes one bone's rotations unit and continuous.
void clean_rotations(const Skeleton& skeleton, int bone, Clip& clip) {
  Quaternion previous = Quaternion::Identity();
  for (int f = 0; f < clip.frames; ++f) {
    double* stored = &clip.rotations[4 * (static_cast<std::size_t>(f) * skeleton.size() + bone)];
    Quaternion q = load_quaternion(stored);
    if (!q.coeffs().allFinite()) fail(clip.name, place(f, skeleton.names[bone]) + "rotation is not finite");
    if (q.norm() < 1e-6) fail(clip.name, place(f, skeleton.names[bone]) + "rotation is a zero quaternion");
    q.normalize();
    if (f > 0 && dot(q.coeffs(), previous.coeffs()) < 0) q.coeffs() *= -1;
    store_quaternion(q, stored);
    previous = q;
  }
}

void rest_rotations(const Skeleton& skeleton, int bone, Clip& clip) {
  for (int f = 0; f < clip.frames; ++f) {
    const std::size_t at = 4 * (static_cast<std::size_t>(f) * skeleton.size() + bone);
    store_quaternion(skeleton.rest_rotations[bone], &clip.rotations[at]);
  }
}

/// The take's index of each bone in the tree of the skeleton's hips, -1 outside; throws unless the trees are the same.
std::vector<int> match_bones(const Skeleton& skeleton, const Take& take) {
  const int hips = skeleton.roles.hips;
  std::vector<int> found(skeleton.size(), -1);
  for (int b = 0; b < skeleton.size(); ++b) {
    if (!skeleton.is_below(b, hips)) continue;
    found[b] = take.skeleton.find(skeleton.names[b]);
    if (found[b] < 0) fail(take.name, "has no bone '" + skeleton.names[b] + "'");
    if (b != hips && take.skeleton.parents[found[b]] != found[skeleton.parents[b]])
      fail(take.name, "bone '" + skeleton.names[b] + "' is not the child of '" + skeleton.names[skeleton.parents[b]] +
                          "' as in the skeleton");
  }
  return found;
}

/// Local rotations mean the same only where the rest frames are the same.
void check_rest(const Skeleton& skeleton, const Take& take, const std::vector<int>& found) {
  std::vector<Vector3> heads;
  std::vector<Quaternion> ours, theirs;
  rest_pose(skeleton, heads, ours);
  rest_pose(take.skeleton, heads, theirs);
  for (int b = 0; b < skeleton.size(); ++b) {
    if (found[b] >= 0 && ours[b].angularDistance(theirs[found[b]]) > kFloatRounding)
      fail(take.name, "bone '" + skeleton.names[b] +
                          "' rests in another rotation than the skeleton's; put the take on the rig first");
  }
}

}  // namespace

Clip make_clip(const Skeleton& skeleton, Clip clip) {
  check_shape(clip, skeleton.size());
  check_positions(skeleton, clip);
  check_markers(clip.markers, clip.frames);
  for (int b = 0; b < skeleton.size(); ++b) {
    if (skeleton.is_below(b, skeleton.roles.hips))
      clean_rotations(skeleton, b, clip);
    else
      rest_rotations(skeleton, b, clip);
  }
  if (clip.headings.empty()) clip.headings = facing(Kinematics(skeleton), clip);
  check_headings(clip);
  return clip;
}

Clip clip_from_take(const Skeleton& skeleton, const Take& take) {
  const std::vector<int> found = match_bones(skeleton, take);
  check_rest(skeleton, take, found);
  std::vector<double> positions, rotations;
  world_transforms(take, positions, rotations);

  const int hips = skeleton.roles.hips;
  Clip clip{take.name, take.rate, take.frames, {}, {}, {}};
  clip.root_positions.resize(3 * static_cast<std::size_t>(take.frames));
  clip.rotations.resize(4 * static_cast<std::size_t>(take.frames) * skeleton.size());
  for (int f = 0; f < take.frames; ++f) {
    const std::size_t from = static_cast<std::size_t>(f) * take.skeleton.size();
    const std::size_t to = static_cast<std::size_t>(f) * skeleton.size();
    store_vector(load_vector(&positions[3 * (from + found[hips])]), &clip.root_positions[3 * f]);
    for (int b = 0; b < skeleton.size(); ++b) {
      if (found[b] < 0) continue;
      const std::vector<double>& source = b == hips ? rotations : take.rotations;
      store_quaternion(load_quaternion(&source[4 * (from + found[b])]), &clip.rotations[4 * (to + b)]);
    }
  }
  return make_clip(skeleton, std::move(clip));
}

Take take_from_clip(const Skeleton& skeleton, const Clip& clip) {
  check_shape(clip, skeleton.size());
  std::vector<Vector3> heads;
  std::vector<Quaternion> rests;
  rest_pose(skeleton, heads, rests);
  const int hips = skeleton.roles.hips, above = skeleton.parents[hips];
  const Vector3 origin = above < 0 ? Vector3::Zero() : heads[above];
  const Quaternion back = above < 0 ? Quaternion::Identity() : rests[above].conjugate();
  Take take{skeleton, clip.name, clip.rate, clip.frames, {}, clip.rotations};
  for (int f = 0; f < clip.frames; ++f) {
    const std::size_t first = static_cast<std::size_t>(f) * skeleton.size();
    for (const Vector3& offset : skeleton.offsets)
      take.translations.insert(take.translations.end(), offset.begin(), offset.end());
    const Vector3 root = load_vector(&clip.root_positions[3 * static_cast<std::size_t>(f)]);
    store_vector(back * (root - origin), &take.translations[3 * (first + hips)]);
    const Quaternion turned = back * load_quaternion(&clip.rotations[4 * (first + hips)]);
    store_quaternion(turned, &take.rotations[4 * (first + hips)]);
  }
  return make_take(std::move(take));
}

Clip part(const Clip& clip, int begin, int end) {
  Clip result;
  result.name = clip.name;
  result.rate = clip.rate;
  result.frames = end - begin + 1;
  const std::ptrdiff_t bones = static_cast<std::ptrdiff_t>(clip.rotations.size()) / clip.frames;
  const auto copy = [&](const std::vector<double>& from, std::ptrdiff_t width) {
    return std::vector<double>(from.begin() + width * begin, from.begin() + width * (end + 1));
  };
  result.root_positions = copy(clip.root_positions, 3);
  result.headings = copy(clip.headings, 1);
  result.rotations = copy(clip.rotations, bones);
  result.markers = markers_in_rounds(clip.markers, begin, result.frames, result.frames);
  result.led = clip.led;
  return result;
}

}  // namespace fragmotion
