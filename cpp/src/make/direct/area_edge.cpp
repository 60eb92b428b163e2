// SPDX-License-Identifier: MIT
#include "direct/area_edge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

using Side = std::pair<std::array<double, 2>, std::array<double, 2>>;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector2 to_vector(const std::array<double, 2>& place) { return {place[0], place[1]}; }

// Its corners the way round that has it to the left; nothing where it stands upright.
std::vector<FlatTriangle> turned_left(const std::vector<FlatTriangle>& triangles) {
  std::vector<FlatTriangle> found;
  for (FlatTriangle triangle : triangles) {
    const double turns = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    if (turns < 0) std::swap(triangle[1], triangle[2]);
    if (turns != 0) found.push_back(triangle);
  }
  return found;
}

// The sides of triangles but for those that two of them have in common, each from its own side.
std::vector<Side> outer_sides(const std::vector<FlatTriangle>& triangles) {
  std::map<Side, int> sides;
  for (const FlatTriangle& triangle : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector2 &a = triangle[corner], &b = triangle[(corner + 1) % 3];
      const Side side{{a.x(), a.y()}, {b.x(), b.y()}};
      const auto other = sides.find({side.second, side.first});
      if (other == sides.end()) {
        ++sides[side];
      } else if (--other->second == 0) {
        sides.erase(other);
      }
    }
  }
  std::vector<Side> outer;
  for (const auto& [side, count] : sides) outer.push_back(side);
  return outer;
}

// From which share of a way to which it lies over a triangle; from more than to where it does not: M. Cyrus and J.
// Beck, "Generalized two- and three-dimensional clipping", Computers & Graphics 3, 1978.
std::pair<double, double> share_over(const FlatTriangle& triangle, const Vector2& start, const Vector2& way) {
  double from = 0, to = 1;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vector2 side = triangle[(corner + 1) % 3] - triangle[corner];
    const double inside = cross(side, start - triangle[corner]), inward = cross(side, way);
    if (inward > 0) {
      from = std::max(from, -inside / inward);
    } else if (inward < 0) {
      to = std::min(to, -inside / inward);
    } else if (inside < 0) {
      return {0, -1};
    }
  }
  return {from, to};
}

// Triangles by where they begin along x, so that few are looked at of many.
class Covering {
 public:
  explicit Covering(std::vector<FlatTriangle> triangles) : triangles_(std::move(triangles)) {
    std::sort(triangles_.begin(), triangles_.end(),
              [](const FlatTriangle& a, const FlatTriangle& b) { return begin_of(a) < begin_of(b); });
    for (const FlatTriangle& each : triangles_) {
      const double end = std::max({each[0].x(), each[1].x(), each[2].x()});
      widest_ = std::max(widest_, end - begin_of(each));
    }
  }

  // The shares of a way that lie over no triangle.
  std::vector<std::pair<double, double>> shares_bare(const Vector2& start, const Vector2& way) const {
    const auto [first, last] = std::minmax({start.x(), start.x() + way.x()});
    auto each = std::lower_bound(triangles_.begin(), triangles_.end(), first - widest_,
                                 [](const FlatTriangle& triangle, double x) { return begin_of(triangle) < x; });
    std::vector<std::pair<double, double>> covered, bare;
    for (; each != triangles_.end() && begin_of(*each) <= last; ++each) {
      const auto share = share_over(*each, start, way);
      if (share.first < share.second) covered.push_back(share);
    }
    std::sort(covered.begin(), covered.end());
    covered.emplace_back(1, 1);
    double reached = 0;
    for (const auto& [from, to] : covered) {
      if (from > reached + kRounding) bare.emplace_back(reached, from);
      reached = std::max(reached, to);
    }
    return bare;
  }

 private:
  static double begin_of(const FlatTriangle& triangle) {
    return std::min({triangle[0].x(), triangle[1].x(), triangle[2].x()});
  }

  std::vector<FlatTriangle> triangles_;
  double widest_ = 0;  // along x
};

Vector2 next_to(const Vector2& place, const Vector2& from, const Vector2& to) {
  const Vector2 way = to - from;
  return from + std::clamp(dot(place - from, way) / way.squaredNorm(), 0.0, 1.0) * way;
}

double distance(const Vector2& place, const Vector2& from, const Vector2& to) {
  return (place - next_to(place, from, to)).norm();
}

bool cross_each_other(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

}  // namespace

AreaEdge::AreaEdge(const std::vector<FlatTriangle>& triangles) {
  const std::vector<FlatTriangle> turned = turned_left(triangles);
  double furthest = 0;
  for (const FlatTriangle& triangle : turned) {
    for (const Vector2& corner : triangle) furthest = std::max(furthest, corner.cwiseAbs().maxCoeff());
  }
  const Covering covering(turned);
  for (const Side& side : outer_sides(turned)) {
    const Vector2 from = to_vector(side.first), way = to_vector(side.second) - from,
                  outward = Vector2{way.y(), -way.x()} / way.norm();
    for (const auto& [first, last] : covering.shares_bare(from + kRounding * furthest * outward, way))
      stretches_.push_back({from + first * way, from + last * way});
  }
  const double same = 4 * kRounding * furthest;
  std::stable_sort(stretches_.begin(), stretches_.end(),
                   [](const Stretch& a, const Stretch& b) { return a.from.x() < b.from.x(); });
  for (Stretch& one : stretches_) {
    auto next = std::lower_bound(stretches_.begin(), stretches_.end(), one.to.x() - same,
                                 [](const Stretch& each, double x) { return each.from.x() < x; });
    for (; next != stretches_.end() && next->from.x() <= one.to.x() + same; ++next) {
      const bool joins = std::abs(next->from.y() - one.to.y()) <= same;
      if (joins && cross(one.to - one.from, next->to - next->from) >= 0) one.juts_out = false;
    }
  }
}

// By how often the edge goes round it.
bool AreaEdge::holds(const Vector2& place) const {
  int rounds = 0;
  for (const auto& [from, to, juts] : stretches_) {
    const bool rises = from.y() <= place.y() && to.y() > place.y(), falls = from.y() > place.y() && to.y() <= place.y();
    const double left = cross(to - from, place - from);
    rounds += (rises && left > 0) - (falls && left < 0);
  }
  return rounds != 0;
}

double AreaEdge::room(const Vector2& place) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to, juts] : stretches_) least = std::min(least, distance(place, from, to));
  return holds(place) ? least : -least;
}

double AreaEdge::room(const Vector2& from, const Vector2& to) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, juts] : stretches_) {
    if (cross_each_other(a, b, from, to)) return 0;
    least = std::min({least, distance(from, a, b), distance(to, a, b)});
    if (from != to) least = std::min({least, distance(a, from, to), distance(b, from, to)});
  }
  return least;
}

AreaEdge::Beside AreaEdge::beside(const Vector2& place) const {
  Beside found;
  if (!holds(place)) {
    const auto off = [&](const Stretch& each) { return distance(place, each.from, each.to); };
    const auto nearest = std::min_element(stretches_.begin(), stretches_.end(),
                                          [&](const Stretch& a, const Stretch& b) { return off(a) < off(b); });
    if (nearest != stretches_.end()) found.across.push_back(next_to(place, nearest->from, nearest->to));
    return found;
  }
  for (const Stretch& each : stretches_) {
    const Vector2 way = each.to - each.from;
    const double along = dot(place - each.from, way);
    if (along >= 0 && along <= way.squaredNorm() && cross(way, place - each.from) > 0)
      found.across.push_back(next_to(place, each.from, each.to));
    if (each.juts_out) found.corners.push_back(each.to);
  }
  return found;
}

}  // namespace fragmotion
