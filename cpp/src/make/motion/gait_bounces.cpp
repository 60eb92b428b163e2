// SPDX-License-Identifier: MIT
#include "motion/gait_bounces.hpp"

#include <algorithm>

#include "motion/foot_paths.hpp"

namespace fragmotion {
namespace {

// Of a character of 1.8 m.
constexpr double kFeetApart = 0.1;    // m between feet that can change places
constexpr double kAsHigh = 0.7;       // of a rise, that the next one has at least
constexpr double kLongestStep = 0.7;  // s: no step of a gait takes longer

// The centre of mass between two of its lowest moments, or between one and the clip's end.
struct Bounce {
  int begin = 0, top = 0, end = 0;  // frames
  double rise = 0;                  // m over the higher end
  bool alternates = false;
};

double height(const std::vector<Vector3>& path, int f) { return path[f].z(); }

// The frames in which a path is lowest, between rises and falls of at least so much.
std::vector<int> lowest_moments(const std::vector<Vector3>& path, double least) {
  std::vector<int> moments;
  int low = 0, high = 0;
  bool falling = true;
  for (int f = 1; f < static_cast<int>(path.size()); ++f) {
    if (height(path, f) < height(path, low)) low = f;
    if (height(path, f) > height(path, high)) high = f;
    if (falling && height(path, f) > height(path, low) + least) {
      moments.push_back(low);
      falling = false;
      high = f;
    } else if (!falling && height(path, f) < height(path, high) - least) {
      falling = true;
      low = f;
    }
  }
  if (falling && low > 0) moments.push_back(low);
  return moments;
}

// How far the right foot is ahead of the left one and over it, m.
Vector2 apart(const FootPaths& feet, const Clip& clip, int f) {
  const CharacterFrame frame{Vector2::Zero(), clip.headings[f]};
  return frame.to_local(feet[1].heel[f] - feet[0].heel[f]).tail<2>();
}

int highest(const std::vector<Vector3>& path, int begin, int end) {
  int highest = begin;
  for (int f = begin; f <= end; ++f) {
    if (height(path, f) > height(path, highest)) highest = f;
  }
  return highest;
}

std::vector<Bounce> bounces_of(const std::vector<Vector3>& center, const FootPaths& feet, const Clip& clip,
                               double scale) {
  std::vector<int> ends = lowest_moments(center, kLeastBounce / scale);
  if (ends.empty() || ends.front() > 0) ends.insert(ends.begin(), 0);
  if (ends.back() + 1 < clip.frames) ends.push_back(clip.frames - 1);
  std::vector<Bounce> bounces;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const int begin = ends[i], end = ends[i + 1], top = highest(center, begin, end);
    bounces.push_back({begin, top, end, height(center, top) - std::max(height(center, begin), height(center, end))});
  }
  const auto change_places = [&](int from, int to) {
    return apart(feet, clip, from).dot(apart(feet, clip, to)) * scale * scale < -kFeetApart * kFeetApart;
  };
  const bool gallops = feet.count() > 2;  // hind legs may swing together
  for (std::size_t i = 0; i < bounces.size(); ++i) {
    Bounce& bounce = bounces[i];
    const int top = bounces[i + 1 < bounces.size() ? i + 1 : std::max<std::size_t>(i, 1) - 1].top;
    const bool changes = change_places(bounce.begin, bounce.end) || change_places(bounce.top, top);
    bounce.alternates = bounce.end - bounce.begin <= kLongestStep * clip.rate && (gallops || changes);
  }
  return bounces;
}

}  // namespace

std::vector<bool> gait_bounces(const Kinematics& kinematics, const Clip& clip, const std::vector<Vector3>& center) {
  std::vector<bool> in_gait(clip.frames, false);
  const FootPaths feet = foot_paths(kinematics, clip);
  if (feet[0].heel.empty()) return in_gait;
  const std::vector<Bounce> bounces = bounces_of(center, feet, clip, standard_scale(kinematics.skeleton()));
  const auto goes_on = [&](std::size_t i, std::size_t beside) {
    return beside < bounces.size() && bounces[beside].alternates && bounces[beside].rise >= kAsHigh * bounces[i].rise;
  };
  const std::size_t flights = feet.count() / 2;  // of a stride of a gallop, one higher than the other
  for (std::size_t i = 0; i < bounces.size(); ++i) {
    const bool at_end = i == 0 || i + 1 == bounces.size();
    if (!bounces[i].alternates && !at_end) continue;
    if (!goes_on(i, i - 1) && !goes_on(i, i + 1) && !goes_on(i, i - flights) && !goes_on(i, i + flights)) continue;
    std::fill(in_gait.begin() + bounces[i].begin, in_gait.begin() + bounces[i].end + 1, true);
  }
  return in_gait;
}

}  // namespace fragmotion
