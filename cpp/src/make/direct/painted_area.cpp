// SPDX-License-Identifier: MIT
#include "direct/painted_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace fragmotion {
namespace {

constexpr int kTries = 400;  // for each place, until the area counts as full

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
  for (std::int64_t tries = std::int64_t{kTries} * count; tries > 0 && static_cast<int>(places.size()) < count;
       --tries) {
    const Vector3 place = draw(random);
    const auto is_near = [&](const Vector3& other) { return (place - other).head<2>().norm() < spacing; };
    if (std::none_of(places.begin(), places.end(), is_near)) places.push_back(place);
  }
  return places;
}

}  // namespace fragmotion
