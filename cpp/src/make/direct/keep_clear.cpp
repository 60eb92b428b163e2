// SPDX-License-Identifier: MIT
#include "direct/keep_clear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/ranges.hpp"
#include "base/rounding.hpp"
#include "base/take_limits.hpp"
#include "control/trace_frames.hpp"
#include "direct/make_way.hpp"
#include "runtime/player_constants.hpp"

namespace fragmotion {
namespace {

constexpr double kGoalLate = 1.5, kGoalLater = 3;  // times as long as planned, and s more: then a goal is given up
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

// By how much a velocity is on the side of a plane where it may be, m/s.
double room_in(const HalfPlane& plane, const Vector2& velocity) { return dot(velocity - plane.point, plane.normal); }

// A member on its way.
class Heeding {
 public:
  Heeding(const CrowdMember& member, const CrowdOptions& options)
      : member_(&member),
        options_(&options),
        controls_(member.wanted.empty() ? static_cast<std::size_t>(std::lround(options.seconds * kTraceRate))
                                        : member.wanted.size()) {
    if (member.path) follower_.emplace(space(), *member.path, member.options);
  }

  bool is_done() const { return trace_.size() >= controls_; }
  std::size_t controls() const { return controls_; }

  Walker walker() const {
    const double radius = options_->radius;
    const CharacterFrame at = player().frame();
    const Vector2 velocity = Eigen::Rotation2Dd(at.heading) * player().commanded_velocity();
    if (is_done()) return {place(at.position), Vector2::Zero(), radius, false};
    Walker walker{place(at.position), way(velocity), radius + kGoesOn * way(velocity).norm(), true};
    way_round_.show(walker);
    return walker;
  }

  // The next control, clear of all: things count where they are not heeded without being asked to.
  void decide(Clearance clearance, std::vector<HalfPlane> things) {
    Control control = wanted();
    const double most = member_->scale * std::max(std::hypot(control.x, control.y), space().walk());
    const Eigen::Rotation2Dd turned(player().frame().heading);
    const Vector2 asked = way(turned * Vector2{control.x, control.y}),
                  meant = detour_.around(options_->obstacles, here(), asked, options_->radius);
    add_edge(things);
    WayRound way_round = way_round_;
    Vector2 clear = way_round.choose(clearance, meant, most, kControlStep);
    for (int added = 0; added < Clearance::kMostOthers; ++added) {
      const auto worst = std::min_element(things.begin(), things.end(), [&](const HalfPlane& a, const HalfPlane& b) {
        return room_in(a, clear) < room_in(b, clear);
      });
      if (worst == things.end() || room_in(*worst, clear) > -kRounding) break;
      clearance.add(*worst);
      things.erase(worst);
      way_round = way_round_;
      clear = way_round.choose(clearance, meant, most, kControlStep);
    }
    way_round_ = way_round;
    const Vector2 seen = turned.inverse() * back(clear);
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
  Vector2 here() const { return place(player().frame().position); }

  // The speed from which a body stops in so many m, if it goes on before it gets slower.
  double stopping_in(double room) const {
    const double slower = member_->scale * RootLimits{}.acceleration / space().scale();
    return slower * (std::sqrt(kGoesOn * kGoesOn + 2 * room / slower) - kGoesOn);
  }

  // Towards the edge it goes no faster than it can stop before it, and past corners; from beyond it comes back.
  void add_edge(std::vector<HalfPlane>& things) const {
    if (options_->area == nullptr) return;
    const Walker one = walker();
    const bool within = options_->area->holds(one.place);
    const AreaEdge::Beside beside = options_->area->beside(one.place);
    for (const Vector2& next : beside.across) {
      const Vector2 away = one.place - next;
      const double distance = away.norm();
      if (distance == 0) continue;
      const Vector2 inward = (within ? 1 : -1) / distance * away;
      const double speed = within ? -stopping_in(std::max(distance - options_->radius, 0.0))
                                  : std::min(stopping_in(distance + options_->radius), member_->scale * space().walk());
      things.push_back({speed * inward, inward});
    }
    for (const Vector2& corner : beside.corners) {
      const double room = std::min(one.radius, (corner - one.place).norm());
      things.push_back(clear_of({one.place, one.velocity, room}, {corner, Vector2::Zero(), 0, false}, kControlStep));
    }
  }

  Control wanted() {
    if (!member_->wanted.empty()) return member_->wanted[trace_.size()];
    if (!member_->path) seek_goal();
    if (!follower_) return {};
    due_ -= kControlStep;
    return follower_->steer(player().frame(), kControlStep);
  }

  // Goes for the next goal where it is at the last one, or late.
  void seek_goal() {
    if (follower_ && !follower_->stands() && due_ > 0) return;
    follower_.reset();
    for (; next_ < member_->goals.size() && !follower_; ++next_) {
      const Vector2 here = player().frame().position, goal = member_->goals[next_];
      if ((goal - here).norm() * space().scale() < kNearby || !is_open(goal)) continue;
      follower_.emplace(space(), Path({here, goal}));
      due_ = kGoalLate * follower_->seconds_left() + kGoalLater;
    }
  }

  // Whether the straight way there is in the area.
  bool is_open(const Vector2& goal) const {
    return options_->area == nullptr || options_->area->room(here(), place(goal)) > 0;
  }

  const CrowdMember* member_;
  const CrowdOptions* options_;
  std::size_t controls_, next_ = 0;
  std::optional<PathFollower> follower_;
  double due_ = 0;  // s until a goal is given up
  Detour detour_;
  WayRound way_round_;
  Trace trace_;
};

// What keeps one clear of what stands around, m in the crowd's world.
std::vector<HalfPlane> keep_off(const std::vector<std::vector<Vector2>>& obstacles, const Walker& walker) {
  std::vector<HalfPlane> seen;
  for (const std::vector<Vector2>& outline : obstacles) {
    const Beside found = beside(outline, walker.place);
    const double distance = distance_to(outline, walker.place);
    if (distance == 0) continue;
    const Vector2 outward = (walker.place - found.place) / distance;
    const double room = distance - walker.radius, within = room > 0 ? MakeWay::kAhead / 2 : kControlStep;
    seen.push_back({Vector2{-room / within * outward}, outward});
  }
  return seen;
}

Walker passer_by(const std::vector<Vector2>& places, std::size_t control, double radius) {
  const std::size_t last = places.size() - 1, now = std::min(control, last);
  return {places[now], (places[std::min(now + 1, last)] - places[now]) / kControlStep, radius, false};
}

void check(const std::vector<CrowdMember>& members, const CrowdOptions& options) {
  require_range("the radius of a crowd's members", options.radius, kRounding, kFarthestBody);
  require_range("the time of a crowd, in s,", options.seconds, kControlStep, kLongestCall);
  for (const CrowdMember& member : members) {
    if (member.player == nullptr) throw std::invalid_argument("a member of a crowd has no player");
    require_range("the scale of a crowd's member", member.scale, 1 / kMostOfSpace, kMostOfSpace);
  }
  for (const std::vector<Vector2>& places : options.passers_by) {
    if (places.empty()) throw std::invalid_argument("a passer-by of a crowd has no place");
  }
}

}  // namespace

std::vector<Trace> keep_clear(const std::vector<CrowdMember>& members, const CrowdOptions& options,
                              const Progress& progress) {
  check(members, options);
  std::vector<Heeding> heeding;
  std::size_t controls = 1;
  for (const CrowdMember& member : members) {
    heeding.emplace_back(member, options);
    controls = std::max(controls, heeding.back().controls());
  }
  MakeWay make_way;
  std::vector<Walker> walkers;
  const auto decide = [&](std::size_t control) {
    walkers.clear();
    for (const Heeding& each : heeding) walkers.push_back(each.walker());
    for (const auto& places : options.passers_by) walkers.push_back(passer_by(places, control, options.radius));
    make_way.look(walkers);
    for (std::size_t i = 0; i < heeding.size(); ++i) {
      if (heeding[i].is_done()) continue;
      heeding[i].decide(make_way.clearance(i, kControlStep), keep_off(options.obstacles, walkers[i]));
    }
  };
  const int frames = frame_count(controls, options.rate);
  std::size_t decided = 0;
  for (int f = 1; f < frames; ++f) {
    if (f % 64 == 0) report(progress, static_cast<double>(f) / frames, "Making way");
    if (control_at(f, options.rate, controls) == decided) {
      decide(decided);
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
