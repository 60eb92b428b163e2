// SPDX-License-Identifier: MIT
#include "direct/painted_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

namespace fragmotion {
namespace {

constexpr int kTries = 400;        // in a row for each place that is there, until the area counts as full
constexpr double kSeam = 1e-9;     // of a way, that rounding leaves between two triangles with a common edge
constexpr double kFinest = 1e-12;  // of the furthest corner: a finer grid has no numbers for its cells

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

// From which share of a way to which it lies over a triangle; `from` is more than `to` where it does not.
struct Stretch {
  double from = 0, to = 1;
};

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

// M. Cyrus and J. Beck, "Generalized two- and three-dimensional clipping", Computers & Graphics 3, 1978.
Stretch stretch_over(const PaintedTriangle& triangle, const Vector2& start, const Vector2& way) {
  const std::array<Vector2, 3> corners{triangle.corners[0].head<2>(), triangle.corners[1].head<2>(),
                                       triangle.corners[2].head<2>()};
  const double turns = cross(corners[1] - corners[0], corners[2] - corners[0]);
  Stretch stretch{0, turns == 0 ? -1.0 : 1.0};  // nothing lies over a triangle that stands upright
  for (int corner = 0; corner < 3; ++corner) {
    const Vector2 edge = std::copysign(1.0, turns) * (corners[(corner + 1) % 3] - corners[corner]);
    const double inside = cross(edge, start - corners[corner]), inward = cross(edge, way);
    if (inward > 0) {
      stretch.from = std::max(stretch.from, -inside / inward);
    } else if (inward < 0) {
      stretch.to = std::min(stretch.to, -inside / inward);
    } else if (inside < 0) {
      return {0, -1};
    }
  }
  return stretch;
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

std::vector<Vector3> PaintedArea::draw_apart(Random& random, int count, double spacing) const {
  std::vector<Vector3> places;
  Grid grid(std::max(spacing, kFinest * furthest_of(triangles_)));
  std::int64_t misses = 0;
  while (static_cast<int>(places.size()) < count && misses < kTries * static_cast<std::int64_t>(places.size() + 1)) {
    const Vector3 place = draw(random);
    if (grid.has_nearer(place, spacing)) {
      ++misses;
      continue;
    }
    places.push_back(place);
    grid.add(place);
    misses = 0;
  }
  return places;
}

std::vector<Vector3> PaintedArea::draw_ways(Random& random, const std::vector<Vector3>& starts, int count) const {
  std::vector<Vector3> places;
  for (Vector3 place : starts) {
    for (int number = 0; number < count; ++number) {
      for (int tries = 0; tries < kTries; ++tries) {
        const Vector3 next = draw(random);
        if (!is_painted_between(place, next)) continue;
        place = next;
        break;
      }
      places.push_back(place);
    }
  }
  return places;
}

bool PaintedArea::is_painted_between(const Vector3& from, const Vector3& to) const {
  const Vector2 start = from.head<2>(), way = (to - from).head<2>();
  std::vector<Stretch> stretches;
  for (const PaintedTriangle& triangle : triangles_) {
    if (most_paint(triangle) == 0) continue;
    const Stretch stretch = stretch_over(triangle, start, way);
    if (stretch.from <= stretch.to) stretches.push_back(stretch);
  }
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  double reached = 0;
  for (const Stretch& stretch : stretches) {
    if (stretch.from > reached + kSeam) return false;
    reached = std::max(reached, stretch.to);
  }
  return reached >= 1 - kSeam;
}

}  // namespace fragmotion
