// SPDX-License-Identifier: MIT
#include "direct/follow_path.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "control/trace_frames.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {
namespace {

constexpr double kStandsOn = 1;      // s at the end
constexpr double kInTime = 0.25;     // s from the time of arrival that will do
constexpr double kGoodEnough = 0.4;  // of what will do, in place and in time
// m: tries of stop_early; those after kUsualTries where none before will do.
constexpr double kSooner[] = {0,    0.05,  -0.05, 0.1,   -0.1, 0.15,  0.08, -0.08, 0.02, -0.02,
                              0.03, -0.03, 0.06,  -0.06, 0.12, -0.12, 0.2,  -0.15, 0.04, 0.25};
constexpr int kUsualTries = 10;

// Measures a walk frame by frame.
class Measure {
 public:
  Measure(const PathFollower& follower, PathEnd end, double scale, double rate)
      : follower_(follower), stands_(end == PathEnd::stand), scale_(scale), rate_(rate) {}

  void add(const CharacterFrame& before, const CharacterFrame& now, int frame, PathWalk& walk) {
    if (!follower_.is_on_path()) return;
    const double left = to_end(now);
    if (!walk.arrived) {
      add_distance(now, walk);
      walk.seconds = frame / rate_;
      walk.arrived = stands_ ? is_at_end(left, (now.position - before.position).norm() * rate_)
                             : follower_.way() >= follower_.path().length();
      walk.arrival_distance = left;
    }
    if (stands_) walk.arrival_distance = left;
  }

  void finish(PathWalk& walk) const { walk.mean_distance = count_ > 0 ? sum_ / count_ : 0; }

 private:
  double to_end(const CharacterFrame& now) const {
    return (follower_.path().place(follower_.path().length()) - now.position).norm();
  }
  bool is_at_end(double left, double speed) const {
    const double way = follower_.path().length() - follower_.way();
    return left * scale_ < kArrived && way * scale_ < kNearby && speed * scale_ < kMoving;
  }

  void add_distance(const CharacterFrame& now, PathWalk& walk) {
    const Path& path = follower_.path();
    const double length = path.length(), around = std::min(kNearby / scale_, length / 2),
                 from = follower_.way() - around, to = follower_.way() + around;
    const double place =
        path.nearest(now.position, path.is_closed() ? from : std::max(from, 0.0), stands_ ? std::min(to, length) : to);
    const double distance = (path.place(place) - now.position).norm();
    sum_ += distance;
    ++count_;
    walk.greatest_distance = std::max(walk.greatest_distance, distance);
  }

  const PathFollower& follower_;
  bool stands_;
  double scale_, rate_;
  double sum_ = 0;
  int count_ = 0;
};

PathWalk walk_once(Player& player, const CharacterFrame& start, const Path& path, const FollowOptions& options,
                   double rate, int frames, const Progress& progress) {
  const ControlSpace& space = player.styled_character().space;
  player.reset(start, player.playing_style());
  PathFollower follower(space, path, options);
  Measure measure(follower, options.end, space.scale(), rate);
  PathWalk walk;
  int ends = frames;  // the frame at which it has stood long enough
  for (int f = 1; f < frames; ++f) {
    if (f % 256 == 0) report(progress, std::min(follower.way() / path.length(), 1.0), "Following the path");
    const CharacterFrame before = player.frame();
    if (control_at(f, rate, walk.trace.size() + 1) == walk.trace.size()) {
      if (f >= ends) break;
      walk.trace.push_back(follower.steer(before, 1 / kTraceRate));
      if (!follower.stands()) ends = frames;
      if (follower.stands() && ends == frames) ends = f + static_cast<int>(std::lround(kStandsOn * rate));
    }
    player.step(walk.trace.back(), 1 / rate);
    measure.add(before, player.frame(), f, walk);
  }
  measure.finish(walk);
  return walk;
}

// The error of a walk, in parts of what will do.
double error(const PathWalk& walk, double arrive, double scale) {
  const double place = walk.arrival_distance * scale / kArrived;
  const double time = arrive > 0 ? std::abs(walk.seconds - arrive) / kInTime : 0;
  return std::max(place, time) + (walk.arrived ? 0 : 1);
}

}  // namespace

PathWalk follow_path(Player& player, const CharacterFrame& start, const Path& path, const FollowOptions& options,
                     double rate, double seconds, const Progress& progress) {
  require_range("the longest that a path is followed, in s,", seconds, kControlStep, kLongestCall);
  const int frames = frame_count(static_cast<std::size_t>(std::lround(seconds * kTraceRate)), rate);
  const ControlSpace& space = player.styled_character().space;
  const PathFollower plan(space, path, options);
  const double soonest = plan.seconds_left();
  const double arrive = options.arrive > 0 ? std::max(options.arrive, soonest) : 0;
  const auto error_of = [&](const PathWalk& walk) { return error(walk, arrive, space.scale()); };
  FollowOptions tried = options;
  PathWalk best;
  int tries = 0;
  for (const double sooner : kSooner) {
    tried.stop_early = options.stop_early + sooner / space.scale();
    PathWalk walk = walk_once(player, start, path, tried, rate, frames, progress);
    const double late = walk.arrived ? walk.seconds - options.arrive : 0;
    if (best.trace.empty() || error_of(walk) < error_of(best)) best = std::move(walk);
    const double enough = ++tries < kUsualTries ? kGoodEnough : 1;
    const bool cannot_arrive = soonest > seconds;
    if (options.end != PathEnd::stand || error_of(best) < enough || cannot_arrive) break;
    if (soonest < options.arrive) tried.arrive = std::max(options.arrive - late / 2, kControlStep);
  }
  best.asked_speed = plan.asked_speed();
  best.planned_seconds = std::max(soonest, options.arrive);
  return best;
}

}  // namespace fragmotion
