// SPDX-License-Identifier: MIT
#include "direct/make_way.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

constexpr int kNarrowings = 20;          // of what velocities are off by where none is clear
constexpr std::int64_t kRows = 1 << 24;  // of cells: more than fit into a million m

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2 to_the_left(const Vector2& v) { return {-v.y(), v.x()}; }

// The half-planes of a clearance, so many of which, the first ones, are moved back by so much.
class Program {
 public:
  Program(const Clearance& clearance, int moved, double back, double most)
      : clearance_(clearance), moved_(moved), back_(back), most_(most) {}

  // What is next to `wanted` in all of them and within the circle of the fastest.
  std::optional<Vector2> solve(const Vector2& wanted) const {
    Vector2 best = clamp_length(wanted, most_);
    for (int i = 0; i < clearance_.count; ++i) {
      if (dot(best - point(i), normal(i)) >= 0) continue;
      const std::optional<Vector2> along = solve_along(i, wanted);
      if (!along) return std::nullopt;
      best = *along;
    }
    return best;
  }

 private:
  const Vector2& normal(int i) const { return clearance_.planes[static_cast<std::size_t>(i)].normal; }
  Vector2 point(int i) const {
    const Vector2& point = clearance_.planes[static_cast<std::size_t>(i)].point;
    return i < moved_ ? Vector2{point - back_ * normal(i)} : point;
  }

  // The same on the edge of one, within those before it.
  std::optional<Vector2> solve_along(int edge, const Vector2& wanted) const {
    const Vector2 from = point(edge), along = to_the_left(normal(edge));
    const double middle = -dot(from, along), off = dot(from, normal(edge)), square = most_ * most_ - off * off;
    if (square < 0) return std::nullopt;
    double first = middle - std::sqrt(square), last = middle + std::sqrt(square);
    for (int i = 0; i < edge; ++i) {
      const double lacks = dot(point(i) - from, normal(i)), gains = dot(along, normal(i));
      if (std::abs(gains) < kRounding) {
        if (lacks > 0) return std::nullopt;
      } else if (gains > 0) {
        first = std::max(first, lacks / gains);
      } else {
        last = std::min(last, lacks / gains);
      }
    }
    if (first > last) return std::nullopt;
    return Vector2{from + std::clamp(dot(wanted - from, along), first, last) * along};
  }

  const Clearance& clearance_;
  int moved_;
  double back_, most_;
};

// The velocity that is off by the least where the first planes may give way; none where the rest leave none.
std::optional<Vector2> least_off(const Clearance& clearance, int moved, const Vector2& wanted, double most) {
  double least = 0, enough = 0;
  for (int i = 0; i < moved; ++i) {
    const HalfPlane& plane = clearance.planes[static_cast<std::size_t>(i)];
    enough = std::max(enough, dot(plane.point, plane.normal) + most);
  }
  const auto off_by = [&](double back) { return Program(clearance, moved, back, most).solve(wanted); };
  if (!off_by(enough)) return std::nullopt;
  for (int i = 0; i < kNarrowings; ++i) {
    const double middle = (least + enough) / 2;
    (off_by(middle) ? enough : least) = middle;
  }
  return off_by(enough);
}

// By what the velocity of `one` as seen from `other` must change at least, and outward from what is forbidden.
HalfPlane least_change(const Walker& one, const Walker& other, double seconds) {
  const Vector2 way = other.place - one.place,
                velocity = one.velocity - other.velocity - (one.stays ? 1 : 0) * other.wish;
  const double apart = one.radius + other.radius, square = way.squaredNorm();
  const bool touch = square <= apart * apart;
  const double within = touch ? seconds : MakeWay::kAhead;
  const Vector2 beyond = velocity - way / within;  // from the middle of the circle that ends what is forbidden
  const double ahead = dot(beyond, way);
  if (touch || (ahead < 0 && ahead * ahead > apart * apart * beyond.squaredNorm())) {
    const double length = beyond.norm();
    const Vector2 outward = length > 0 ? Vector2{beyond / length} : Vector2{&one < &other ? 1.0 : -1.0, 0};
    return {(apart / within - length) * outward, outward};
  }
  const double leg = std::sqrt(square - apart * apart);
  const double side = cross(way, beyond) > 0 ? 1 : -1;  // who meet head on keep to the right
  const Vector2 edge = (leg * way + side * apart * to_the_left(way)) / square;
  return {dot(velocity, edge) * edge - velocity, side * to_the_left(edge)};
}

}  // namespace

HalfPlane clear_of(const Walker& one, const Walker& other, double seconds) {
  const HalfPlane change = least_change(one, other, seconds);
  return {one.velocity + (other.yields ? 0.5 : 1) * change.point, change.normal};
}

void Clearance::add(const HalfPlane& plane) {
  if (count < kMost + kMostOthers) planes[static_cast<std::size_t>(count++)] = plane;
}

Vector2 Clearance::nearest(const Vector2& wanted, double most) const {
  std::optional<Vector2> found = Program(*this, 0, 0, most).solve(wanted);
  if (!found) found = least_off(*this, walkers, wanted, most);
  if (!found) found = least_off(*this, count, wanted, most);
  return found.value_or(Vector2::Zero());
}

Vector2 WayRound::choose(const Clearance& clearance, const Vector2& wanted, double most, double seconds) {
  const double square = wanted.squaredNorm();
  const auto held_up = [&](const Vector2& velocity) {
    if (square == 0) return velocity == Vector2::Zero() ? 0.0 : 0.5;
    return std::clamp(1 - dot(velocity, wanted) / square, 0.0, 1.0);
  };
  const double right_angles = held_up(clearance.nearest(wanted, most)) * (1 - held_up_ / kPatience);
  const Vector2 chosen = clearance.nearest(Eigen::Rotation2Dd(-kPi / 2 * right_angles) * wanted, most);
  held_up_ = std::clamp(held_up_ + (2 * held_up(chosen) - 1) * seconds, 0.0, kPatience);
  wanted_ = wanted;
  return chosen;
}

void WayRound::show(Walker& walker) const {
  walker.stays = wanted_ == Vector2::Zero();
  if (!walker.stays) walker.wish = (1 - held_up_ / kPatience) * (wanted_ - walker.velocity);
}

std::int64_t MakeWay::cell(const Vector2& place, int column, int row) const {
  const auto index = [&](double along) { return static_cast<std::int64_t>(std::floor(along / reach_)); };
  return (index(place.y()) + row) * kRows + index(place.x()) + column;
}

void MakeWay::look(const std::vector<Walker>& walkers) {
  walkers_ = walkers;
  double fastest = 0, widest = 0;
  for (const Walker& walker : walkers_) {
    fastest = std::max(fastest, walker.velocity.norm());
    widest = std::max(widest, walker.radius);
  }
  reach_ = 2 * (widest + kAhead * fastest) + kAhead;
  cells_.clear();
  for (std::size_t i = 0; i < walkers_.size(); ++i) cells_.emplace_back(cell(walkers_[i].place, 0, 0), i);
  std::sort(cells_.begin(), cells_.end());
}

template <typename Each>
void MakeWay::each_near(const Vector2& place, const Each& each) const {
  for (int row = -1; row <= 1; ++row) {
    const std::pair<std::int64_t, std::size_t> first{cell(place, -1, row), 0};
    const std::int64_t last = cell(place, 1, row);
    for (auto at = std::lower_bound(cells_.begin(), cells_.end(), first); at != cells_.end() && at->first <= last;
         ++at) {
      each(at->second);
    }
  }
}

Clearance MakeWay::clearance(std::size_t walker, double seconds) const {
  const Walker& one = walkers_[walker];
  std::array<Seen, Clearance::kMost> nearest{};
  int seen = 0;
  each_near(one.place, [&](std::size_t other) {
    const double square = (walkers_[other].place - one.place).squaredNorm();
    if (other == walker || square > reach_ * reach_) return;
    if (seen == Clearance::kMost && square >= nearest[Clearance::kMost - 1].square) return;
    int at = seen < Clearance::kMost ? seen++ : seen - 1;
    for (; at > 0 && nearest[at - 1].square > square; --at) nearest[at] = nearest[at - 1];
    nearest[at] = {square, other};
  });
  Clearance clearance;
  for (int i = 0; i < seen; ++i) clearance.add(clear_of(one, walkers_[nearest[i].walker], seconds));
  clearance.walkers = clearance.count;
  return clearance;
}

}  // namespace fragmotion
