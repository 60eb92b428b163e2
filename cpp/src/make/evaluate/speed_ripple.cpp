// SPDX-License-Identifier: MIT
#include "evaluate/speed_ripple.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rates.hpp"
#include "evaluate/jumps.hpp"
#include "evaluate/performance.hpp"
#include "evaluate/tracks.hpp"
#include "fragments/speed_range.hpp"

namespace fragmotion {
namespace {

constexpr double kLong = 1, kSmooth = 0.1;      // s
constexpr double kSteady = 0.1;                 // of the speed
constexpr double kNear = 0.1;                   // m/s
constexpr double kSlowest = 0.5, kFastest = 3;  // m/s, and the step between commands
constexpr double kSettling = 3, kHeld = 11;     // s

// Mean velocity along the ground from frame `begin` to frame `end`, m/s.
Vector2 velocity(const BodyTrack& track, int begin, int end) {
  return (track.center[end] - track.center[begin]).head<2>() * track.rate / (end - begin);
}

double standard_deviation(double sum, double squares, double count) {
  return std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
}

// Of the hips' height.
double bob(const BodyTrack& track, int begin, int end) {
  double sum = 0, squares = 0;
  for (int f = begin; f <= end; ++f) {
    const double height = track.hips[f].z();
    sum += height;
    squares += height * height;
  }
  return standard_deviation(sum, squares, end - begin + 1);
}

// How often a foot comes to stand after frame `begin` until `end`.
double steps(const BodyTrack& track, int begin, int end) {
  double count = 0;
  for (int side = 0; side < track.feet.count(); ++side) {
    for (int f = begin + 1; f <= end; ++f) count += track.stands[side][f] && !track.stands[side][f - 1] ? 1 : 0;
  }
  return count;
}

Going going(const BodyTrack& track, int begin) {
  const int end = begin + track.frames_in(kLong), half = track.frames_in(kSmooth / 2);
  const Vector2 mean = velocity(track, begin, end), way = mean.normalized();
  double sum = 0, squares = 0, count = 0;
  for (int f = begin + half; f <= end - half; ++f) {
    const double speed = velocity(track, f - half, f + half).dot(way);
    sum += speed;
    squares += speed * speed;
    ++count;
  }
  return {mean.norm(), standard_deviation(sum, squares, count), bob(track, begin, end), steps(track, begin, end)};
}

bool is_steady(const BodyTrack& track, int begin) {
  const int second = track.frames_in(kLong), half = track.frames_in(kLong / 2), quarter = track.frames_in(kLong / 4);
  const Vector2 mean = velocity(track, begin, begin + second);
  const double heading = track.heading[begin + half];
  const Vector2 ahead{-std::sin(heading), std::cos(heading)};
  const Vector2 change = velocity(track, begin + second - quarter, begin + second + quarter) -
                         velocity(track, begin - quarter, begin + quarter);
  return mean.dot(ahead) >= std::cos(kSameDirection) * mean.norm() && change.norm() <= kSteady * mean.norm();
}

// Of each frame, whether one jumps in the second that begins at it, or in the time around a jump.
std::vector<bool> jumping(const BodyTrack& track, const UsualHeights& usual) {
  std::vector<bool> jumping(track.frames());
  const int around = track.frames_in(kAroundJump), second = track.frames_in(kLong);
  for (const Jump& jump : find_jumps(track, usual)) {
    const int first = std::max(0, jump.take_off - around - second), end = jump.landing + around + 1;
    std::fill(jumping.begin() + first, jumping.begin() + std::min(end, track.frames()), true);
  }
  return jumping;
}

void compare(SpeedRipple& row, const std::vector<Going>& takes) {
  row.takes_speed = row.takes_ripple = row.takes_bob = row.takes_steps = std::numeric_limits<double>::quiet_NaN();
  if (takes.empty()) return;
  row.takes_speed = std::min_element(takes.begin(), takes.end(), [&](const Going& a, const Going& b) {
                      return std::abs(a.speed - row.commanded) < std::abs(b.speed - row.commanded);
                    })->speed;
  double ripple = 0, bob = 0, steps = 0, count = 0;
  for (const Going& going : takes) {
    if (std::abs(going.speed - row.takes_speed) > kNear) continue;
    ripple += going.ripple;
    bob += going.bob;
    steps += going.steps;
    ++count;
  }
  row.takes_ripple = ripple / count;
  row.takes_bob = bob / count;
  row.takes_steps = steps / count;
}

}  // namespace

std::vector<Going> goings(const BodyTrack& track, int first) {
  std::vector<Going> found;
  for (int f = first; f + track.frames_in(kLong) < track.frames(); ++f) found.push_back(going(track, f));
  return found;
}

std::vector<Going> steady_goings(const BodyTrack& track, const UsualHeights& usual) {
  const int second = track.frames_in(kLong), quarter = track.frames_in(kLong / 4);
  const std::vector<bool> jumps = jumping(track, usual);
  std::vector<Going> found;
  for (int f = quarter; f + second + quarter < track.frames(); ++f) {
    if (!jumps[f] && is_steady(track, f)) found.push_back(going(track, f));
  }
  return found;
}

std::vector<SpeedRipple> speed_ripples(const std::shared_ptr<const Character>& character,
                                       const PlayerOptions& options) {
  const Kinematics kinematics(character->pool.skeleton);
  std::vector<Going> takes;
  const auto [tracks, floors] = tracks_of(character->pool.skeleton, captured_takes(character->pool));
  const UsualHeights usual = usual_heights(tracks);
  for (const BodyTrack& track : tracks) {
    const std::vector<Going> some = steady_goings(track, usual);
    takes.insert(takes.end(), some.begin(), some.end());
  }
  std::vector<SpeedRipple> rows;
  for (double commanded = kSlowest; commanded <= kFastest; commanded += kSlowest) {
    const Trace trace(static_cast<std::size_t>(kHeld * kTraceRate),
                      Control{0, commanded / character->space.scale(), 0, 0});
    const Performance performance = perform(Player(character, options), trace, kGameRate);
    BodyTrack track = body_track(kinematics, clip_of(performance));
    stand_on(track, floors);
    SpeedRipple row;
    row.commanded = commanded;
    const std::vector<Going> played = goings(track, track.frames_in(kSettling));
    for (const Going& going : played) {
      row.speed += going.speed / static_cast<double>(played.size());
      row.ripple += going.ripple / static_cast<double>(played.size());
      row.bob += going.bob / static_cast<double>(played.size());
      row.steps += going.steps / static_cast<double>(played.size());
    }
    compare(row, takes);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace fragmotion
