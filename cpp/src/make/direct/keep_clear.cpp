// SPDX-License-Identifier: MIT
#include "direct/keep_clear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/ranges.hpp"
#include "control/trace_frames.hpp"
#include "direct/make_way.hpp"

namespace fragmotion {
namespace {

constexpr double kControl = 1 / kTraceRate;        // s
constexpr double kNearGoal = 0.5;                  // m of a 1.8 m character: what is nearer than that is no goal
constexpr double kGoalLate = 1.5, kGoalLater = 3;  // times as long as planned, and s more: then a goal is given up
constexpr double kMostScale = 1e6;
constexpr double kGoesOn = 0.2;  // s until a body can do otherwise, in which it goes on: it takes so much more room
constexpr int kForgets = 10;     // controls after which it forgets on which side it went past something
constexpr int kGlances = 8;      // at the way that it would go, for what stands there

// The place of an outline that is next to another, and whether that is inside.
struct Beside {
  Vector2 place;
  double square = std::numeric_limits<double>::infinity();
  bool inside = true;
};

Beside beside(const std::vector<Vector2>& outline, const Vector2& place) {
  Beside found;
  double turn = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2& from = outline[i];
    const Vector2 edge = outline[(i + 1) % outline.size()] - from, way = place - from;
    const double length = edge.squaredNorm(), along = length > 0 ? std::clamp(dot(way, edge) / length, 0.0, 1.0) : 0;
    const Vector2 nearest = from + along * edge;
    const double square = (place - nearest).squaredNorm(), side = edge.x() * way.y() - edge.y() * way.x();
    if (square < found.square) found.place = nearest, found.square = square;
    if (turn * side < 0) found.inside = false;
    if (side != 0) turn = side;
  }
  found.inside = found.inside && outline.size() > 2;
  return found;
}

double distance_to(const std::vector<Vector2>& outline, const Vector2& place) {
  const Beside found = beside(outline, place);
  return found.inside ? -std::sqrt(found.square) : std::sqrt(found.square);
}

// On which side one passes what is on its way: the side that is less of a detour, and that again until nothing is.
class Detour {
 public:
  // The velocity that passes the first thing that would be touched within MakeWay::kAhead.
  Vector2 around(const std::vector<std::vector<Vector2>>& obstacles, const Vector2& place, const Vector2& velocity,
                 double radius) {
    for (int glance = 1; glance <= kGlances; ++glance) {
      const Vector2 there = place + MakeWay::kAhead * glance / kGlances * velocity;
      for (const std::vector<Vector2>& outline : obstacles) {
        if (distance_to(outline, there) < radius) return past(outline, place, velocity, radius);
      }
    }
    if (++clear_ > kForgets) side_ = 0;
    return velocity;
  }

 private:
  Vector2 past(const std::vector<Vector2>& outline, const Vector2& place, const Vector2& velocity, double radius) {
    double left = 0, right = 0;
    for (const Vector2& corner : outline) {
      const Vector2 way = corner - place;
      const double off = std::atan2(velocity.x() * way.y() - velocity.y() * way.x(), dot(velocity, way)),
                   room = std::asin(std::min(1.0, radius / std::max(way.norm(), radius)));
      left = std::max(left, off + room);
      right = std::min(right, off - room);
    }
    if (side_ == 0) side_ = left < -right ? 1 : -1;
    clear_ = 0;
    return Eigen::Rotation2Dd(side_ > 0 ? left : right) * velocity;
  }

  int side_ = 0, clear_ = 0;  // to the left: 1, to the right: -1; controls since something was on the way
};

// A member on its way.
class Heeding {
 public:
  Heeding(const CrowdMember& member, std::size_t controls)
      : member_(&member), controls_(member.wanted.empty() ? controls : member.wanted.size()) {
    if (member.path) follower_.emplace(space(), *member.path, member.options);
  }

  bool is_done() const { return trace_.size() >= controls_; }
  std::size_t controls() const { return controls_; }

  Walker walker(double radius) const {
    const CharacterFrame at = player().frame();
    const Vector2 velocity = Eigen::Rotation2Dd(at.heading) * player().commanded_velocity();
    if (is_done()) return {place(at.position), Vector2::Zero(), radius, false};
    return {place(at.position), way(velocity), radius + kGoesOn * way(velocity).norm(), true};
  }

  // The next control, clear of all.
  void decide(const Clearance& clearance, const CrowdOptions& options) {
    Control control = wanted();
    const double most = std::max(std::hypot(control.x, control.y), space().walk());
    const Eigen::Rotation2Dd turned(player().frame().heading);
    const Vector2 asked = way(turned * Vector2{control.x, control.y}),
                  meant = detour_.around(options.obstacles, place(player().frame().position), asked, options.radius);
    const Vector2 clear = back(way_round_.choose(clearance, meant, member_->scale * most, kControl));
    const Vector2 seen = turned.inverse() * clear;
    control.x = seen.x();
    control.y = seen.y();
    trace_.push_back(control);
  }

  void step(double seconds) const { player().step(trace_.back(), seconds); }

  Trace take() { return std::move(trace_); }

 private:
  Player& player() const { return *member_->player; }
  const ControlSpace& space() const { return player().styled_character().space; }

  Vector2 way(const Vector2& own) const { return member_->scale * (Eigen::Rotation2Dd(member_->origin.heading) * own); }
  Vector2 back(const Vector2& theirs) const {
    return Eigen::Rotation2Dd(-member_->origin.heading) * theirs / member_->scale;
  }
  Vector2 place(const Vector2& own) const { return member_->origin.position + way(own); }

  Control wanted() {
    if (!member_->wanted.empty()) return member_->wanted[trace_.size()];
    if (!member_->path) seek_goal();
    if (!follower_) return {};
    due_ -= kControl;
    return follower_->steer(player().frame(), kControl);
  }

  // Goes for the next goal where it is at the last one, or late.
  void seek_goal() {
    if (follower_ && !follower_->stands() && due_ > 0) return;
    follower_.reset();
    for (; next_ < member_->goals.size() && !follower_; ++next_) {
      const Vector2 here = player().frame().position, goal = member_->goals[next_];
      if ((goal - here).norm() * space().scale() < kNearGoal) continue;
      follower_.emplace(space(), Path({here, goal}));
      due_ = kGoalLate * follower_->seconds_left() + kGoalLater;
    }
  }

  const CrowdMember* member_;
  std::size_t controls_, next_ = 0;
  std::optional<PathFollower> follower_;
  double due_ = 0;  // s until a goal is given up
  Detour detour_;
  WayRound way_round_;
  Trace trace_;
};

// Keeps one clear of what stands around, m in the crowd's world.
void keep_off(const std::vector<std::vector<Vector2>>& obstacles, const Walker& walker, Clearance& clearance) {
  std::vector<std::pair<double, HalfPlane>> seen;
  for (const std::vector<Vector2>& outline : obstacles) {
    const Beside found = beside(outline, walker.place);
    const double distance = distance_to(outline, walker.place);
    if (distance == 0 || distance > walker.radius + MakeWay::kAhead * (1 + 2 * walker.velocity.norm())) continue;
    const Vector2 outward = (walker.place - found.place) / distance;
    const double room = distance - walker.radius, within = room > 0 ? MakeWay::kAhead / 2 : kControl;
    seen.push_back({distance, {Vector2{-room / within * outward}, outward}});
  }
  std::stable_sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [distance, plane] : seen) clearance.add(plane);
}

void check(const std::vector<CrowdMember>& members, const CrowdOptions& options) {
  require_range("the radius of a crowd's members", options.radius, 1e-9, 1e6);
  require_range("the time of a crowd, in s,", options.seconds, kControl, kLongestCall);
  for (const CrowdMember& member : members) {
    if (member.player == nullptr) throw std::invalid_argument("a member of a crowd has no player");
    require_range("the scale of a crowd's member", member.scale, 1 / kMostScale, kMostScale);
  }
}

}  // namespace

std::vector<Trace> keep_clear(const std::vector<CrowdMember>& members, const CrowdOptions& options,
                              const Progress& progress) {
  check(members, options);
  std::vector<Heeding> heeding;
  std::size_t controls = 1;
  for (const CrowdMember& member : members) {
    heeding.emplace_back(member, static_cast<std::size_t>(std::lround(options.seconds * kTraceRate)));
    controls = std::max(controls, heeding.back().controls());
  }
  MakeWay make_way;
  std::vector<Walker> walkers(members.size());
  const auto decide = [&] {
    for (std::size_t i = 0; i < heeding.size(); ++i) walkers[i] = heeding[i].walker(options.radius);
    make_way.look(walkers);
    for (std::size_t i = 0; i < heeding.size(); ++i) {
      if (heeding[i].is_done()) continue;
      Clearance clearance = make_way.clearance(i, kControl);
      keep_off(options.obstacles, walkers[i], clearance);
      heeding[i].decide(clearance, options);
    }
  };
  const int frames = frame_count(controls, options.rate);
  std::size_t decided = 0;
  for (int f = 1; f < frames; ++f) {
    if (f % 64 == 0) report(progress, static_cast<double>(f) / frames, "Making way");
    if (control_at(f, options.rate, controls) == decided) {
      decide();
      ++decided;
    }
    for (const Heeding& each : heeding) {
      if (decided <= each.controls()) each.step(1 / options.rate);
    }
  }
  std::vector<Trace> traces;
  for (Heeding& each : heeding) traces.push_back(each.take());
  return traces;
}

}  // namespace fragmotion
