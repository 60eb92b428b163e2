// SPDX-License-Identifier: MIT
#include "direct/painted_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

constexpr int kTries = 400;  // in a row for each place that is there, until the area counts as full

double most_paint(const PaintedTriangle& triangle) {
  return *std::max_element(triangle.paint.begin(), triangle.paint.end());
}

void check(const PaintedTriangle& triangle) {
  for (int corner = 0; corner < 3; ++corner) {
    if (!triangle.corners[corner].allFinite()) throw std::invalid_argument("a corner of the area is not finite");
    if (!(triangle.paint[corner] >= 0 && triangle.paint[corner] <= 1)) {
      throw std::invalid_argument("the paint of an area must be 0 to 1");
    }
  }
}

// Places by the cells of a grid, seen from above: what is near another lies in a cell beside it.
class Grid {
 public:
  explicit Grid(double cell) : cell_(cell) {}

  void add(const Vector3& place) { places_[cell_of(place)].push_back(place); }

  bool has_nearer(const Vector3& place, double spacing) const {
    const auto [x, y] = cell_of(place);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        const auto found = places_.find({i, j});
        if (found == places_.end()) continue;
        for (const Vector3& other : found->second) {
          if ((place - other).head<2>().norm() < spacing) return true;
        }
      }
    }
    return false;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;

  Cell cell_of(const Vector3& place) const {
    return {static_cast<std::int64_t>(std::floor(place.x() / cell_)),
            static_cast<std::int64_t>(std::floor(place.y() / cell_))};
  }

  double cell_;
  std::map<Cell, std::vector<Vector3>> places_;
};

AreaEdge edge_of(const std::vector<PaintedTriangle>& triangles) {
  std::vector<FlatTriangle> painted;
  for (const PaintedTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners;
    if (most_paint(triangle) > 0) painted.push_back({a.head<2>(), b.head<2>(), c.head<2>()});
  }
  return AreaEdge(painted);
}

double furthest_of(const std::vector<PaintedTriangle>& triangles) {
  double furthest = 0;
  for (const PaintedTriangle& triangle : triangles) {
    for (const Vector3& corner : triangle.corners) furthest = std::max(furthest, corner.cwiseAbs().maxCoeff());
  }
  return furthest;
}

}  // namespace

PaintedArea::PaintedArea(std::vector<PaintedTriangle> triangles) : triangles_(std::move(triangles)) {
  double sum = 0;
  for (const PaintedTriangle& triangle : triangles_) {
    check(triangle);
    const auto& [a, b, c] = triangle.corners;
    sum += (b - a).cross(c - a).norm() * most_paint(triangle);
    sums_.push_back(sum);
  }
  if (!(sum > 0 && std::isfinite(sum))) throw std::invalid_argument("nothing of the area is painted");
  edge_ = edge_of(triangles_);
}

// Uniform in a triangle (R. Osada and others, "Shape distributions", ACM Transactions on Graphics 21, 2002, Sec. 4.1),
// and drawn again the likelier, the less is painted there.
Vector3 PaintedArea::draw(Random& random) const {
  while (true) {
    const auto found = std::upper_bound(sums_.begin(), sums_.end(), random.uniform() * sums_.back());
    const PaintedTriangle& triangle = triangles_[std::min<std::size_t>(found - sums_.begin(), sums_.size() - 1)];
    const double root = std::sqrt(random.uniform()), share = random.uniform();
    const std::array<double, 3> shares{1 - root, root * (1 - share), root * share};
    Vector3 place = Vector3::Zero();
    double paint = 0;
    for (int corner = 0; corner < 3; ++corner) {
      place += shares[corner] * triangle.corners[corner];
      paint += shares[corner] * triangle.paint[corner];
    }
    if (random.uniform() * most_paint(triangle) < paint) return place;
  }
}

std::vector<Vector3> PaintedArea::draw_apart(Random& random, int count, double spacing, double room) const {
  std::vector<Vector3> places;
  Grid grid(std::max(spacing, kRounding * furthest_of(triangles_)));
  std::int64_t misses = 0;
  while (static_cast<int>(places.size()) < count) {
    if (misses >= kTries * static_cast<std::int64_t>(places.size() + 1)) {
      if (room <= 0) break;
      room = 0;  // at the edge, too
      misses = 0;
    }
    const Vector3 place = draw(random);
    if (grid.has_nearer(place, spacing) || (room > 0 && edge_.room(place.head<2>()) < room)) {
      ++misses;
      continue;
    }
    places.push_back(place);
    grid.add(place);
    misses = 0;
  }
  return places;
}

std::vector<Vector3> PaintedArea::draw_ways(Random& random, const std::vector<Vector3>& starts, int count,
                                            double room) const {
  std::vector<Vector3> places;
  for (Vector3 place : starts) {
    for (int number = 0; number < count; ++number) {
      place = draw_way(random, place, room);
      places.push_back(place);
    }
  }
  return places;
}

Vector3 PaintedArea::draw_way(Random& random, const Vector3& from, double room) const {
  const Vector2 start = from.head<2>();
  const double here = edge_.room(start), enough = std::min(room, here);
  Vector3 best = from;
  double most = -1;
  for (int tries = 0; tries < kTries && here > 0 && most < enough + room; ++tries) {
    const Vector3 next = draw(random);
    const Vector2 end = next.head<2>();
    const double way = edge_.room(start, end);
    if (way <= 0) continue;
    const double found = std::min(way, enough) + std::min(edge_.room(end), room);
    if (found > most) most = found, best = next;
  }
  return best;
}

}  // namespace fragmotion
