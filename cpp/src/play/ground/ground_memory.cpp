// SPDX-License-Identifier: MIT
#include "ground/ground_memory.hpp"

#include <algorithm>
#include <limits>

namespace fragmotion {
namespace {

constexpr double kLasts = 0.15;  // s after which they are asked for again

}  // namespace

void GroundMemory::advance(double seconds, int most) {
  for (int i = 0; i < count_; ++i) asked_[i].age += seconds;
  left_ = most;
}

bool GroundMemory::knows(const Vector2& place, double within, std::optional<GroundPlane>& plane) const {
  const Asked *lately = nullptr, *ever = nullptr;
  double near = within * within, nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count_; ++i) {
    const Asked& asked = asked_[i];
    const double apart = (asked.place - place).squaredNorm();
    if (apart < nearest) nearest = apart, ever = &asked;
    if (asked.age < kLasts && apart < near) near = apart, lately = &asked;
  }
  const Asked* known = lately != nullptr ? lately : left_ > 0 ? nullptr : ever;
  if (known == nullptr) return false;
  plane.reset();
  if (known->exists) {
    plane = known->plane;
    plane->height += known->plane.slope.dot(place - known->place);
  }
  return true;
}

void GroundMemory::keep(const Vector2& place, const std::optional<GroundPlane>& plane) {
  asked_[next_] = {place, plane.value_or(GroundPlane{}), plane.has_value(), 0};
  next_ = (next_ + 1) % static_cast<int>(kPlaces);
  count_ = std::max(count_, next_ == 0 ? static_cast<int>(kPlaces) : next_);
  --left_;
}

}  // namespace fragmotion
