// SPDX-License-Identifier: MIT
#include "skins.hpp"

#include <algorithm>
#include <cmath>

#include "io/rigid_matrix.hpp"

namespace fragmotion::bindings {
namespace {

constexpr py::ssize_t kRow = 3;  // vertex, group, weight

int whole(double number, std::size_t end, const char* what) {
  if (number >= 0 && number < static_cast<double>(end) && number == std::floor(number)) return static_cast<int>(number);
  throw std::invalid_argument("weights: there is no such " + std::string(what) + " as " + std::to_string(number));
}

}  // namespace

void BoundSkin::add(const Doubles& world, const Doubles& points, const std::vector<std::string>& groups,
                    const Doubles& weights) {
  check_shape(world, "world", {4, 4});
  check_shape(points, "points", {-1, 3});
  check_shape(weights, "weights", {-1, kRow});
  std::vector<int> bones;
  for (const std::string& group : groups) {
    const auto found = std::find(bones_.begin(), bones_.end(), group);
    bones.push_back(found == bones_.end() ? -1 : static_cast<int>(found - bones_.begin()));
  }
  Skin added;
  const Eigen::Matrix4d place = RowMajor(world.data());
  for (py::ssize_t i = 0; i < points.shape(0); ++i) {
    added.points.push_back((place * load_vector(points.data(i, 0)).homogeneous()).head<3>());
    if (!added.points.back().allFinite()) throw std::invalid_argument("points: a place is not finite");
  }
  std::vector<double> totals(added.points.size(), 0);
  for (py::ssize_t i = 0; i < weights.shape(0); ++i) {
    const double* row = weights.data(i, 0);
    const int point = whole(row[0], added.points.size(), "vertex"), bone = bones[whole(row[1], bones.size(), "group")];
    if (!(row[2] >= 0 && row[2] <= 1)) throw std::invalid_argument("weights: one is not from 0 to 1");
    if (bone < 0 || row[2] == 0) continue;
    added.weights.push_back({point, bone, row[2]});
    totals[point] += row[2];
  }
  const int first = static_cast<int>(skin_.points.size());
  for (Skin::Weight& weight : added.weights) weight.weight /= totals[weight.point], weight.point += first;
  skin_.points.insert(skin_.points.end(), added.points.begin(), added.points.end());
  skin_.weights.insert(skin_.weights.end(), added.weights.begin(), added.weights.end());
}

const Skin& BoundSkin::of(const Skeleton& skeleton) const {
  if (skeleton.names != bones_) throw std::invalid_argument("the skin is of another skeleton");
  return skin_;
}

const Skin* skin_of(const BoundSkin* bound, const Skeleton& skeleton) {
  return bound == nullptr ? nullptr : &bound->of(skeleton);
}

}  // namespace fragmotion::bindings
