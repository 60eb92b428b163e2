// SPDX-License-Identifier: MIT
#include "fragments/gait_heights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantile.hpp"
#include "fragments/speed_range.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {

GaitHeights::GaitHeights(const Trajectories& t, const std::vector<Fragment>& fragments, const ControlSpace& space)
    : trajectories_(&t), faster_((space.walk() + space.run()) / 2) {
  std::array<std::vector<int>, 2> going;
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    const double speed = fragments[f].evident.speed();
    if (speed * space.scale() > kMoving) going[gait_at(speed)].push_back(static_cast<int>(f));
  }
  for (std::vector<int>& some : going) {
    const auto aside = std::stable_partition(
        some.begin(), some.end(), [&](int f) { return goes_straight_ahead(fragments[f].evident, space.turn_rate()); });
    if (aside != some.begin()) some.erase(aside, some.end());
  }
  for (std::size_t gait = 0; gait < going.size(); ++gait) {
    for (int tip = 0; tip < t.tips && !going[gait].empty(); ++tip) {
      std::vector<double> seen;
      for (const int f : going[gait]) seen.push_back(heights(f)[tip]);
      usual_[gait].push_back(median(std::move(seen)));
    }
    std::vector<double> away;
    for (const int f : going[gait]) away.push_back(distance(f, f, gait));
    if (!away.empty()) distances_[gait] = median(std::move(away));
  }
}

double GaitHeights::excess(int first, int last, double speed) const {
  const std::size_t gait = gait_at(speed);
  return std::max(0.0, distance(first, last, gait) - distances_[gait]);
}

double GaitHeights::distance(int first, int last, std::size_t gait) const {
  const std::vector<double>& usual = usual_[gait];
  double sum = 0;
  for (std::size_t tip = 0; tip < usual.size(); ++tip) {
    double mean = 0;
    for (int f = first; f <= last; ++f) mean += heights(f)[tip] / (last - first + 1);
    sum += std::abs(mean - usual[tip]);
  }
  return sum / trajectories_->reach;
}

}  // namespace fragmotion
