// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "skeleton/body_shape.hpp"

namespace fragmotion {
namespace {

// Lengths are shares of BodyShape::size().
constexpr double kLimb = 0.2;     // a limb at least
constexpr double kLongest = 0.6;  // of the way along its bones, from a limb's beginning to its end
constexpr double kHand = 0.3;     // of a limb's length that hands and feet reach at most

// As far as the hands: which finger reaches farthest may differ.
bool alike(const BodyShape& shape, const Chain& a, const Chain& b) {
  const double limb = shape.branch(a[0]);
  const auto is_hand = [&](const Chain& chain, std::size_t i) {
    return i > 0 && shape.reach(chain[i - 1]) < kHand * limb;
  };
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (is_hand(a, i) && is_hand(b, i)) return true;
    if (i >= a.size() || i >= b.size() || std::abs(shape.length(a[i]) - shape.length(b[i])) > kAlike * limb)
      return false;
  }
  return true;
}

// Whether it has the joints of a limb, and is ever stretched: what controls a foot is folded up.
bool may_be_limb(const BodyShape& shape, const Chain& chain) {
  if (chain.size() < kLimbJoints) return false;
  const double farthest = kLongest * shape.reach(chain.front());
  const auto is_stretched = [&](const Vector3* heads) {
    return (heads[chain.back()] - heads[chain.front()]).norm() > farthest;
  };
  return is_stretched(shape.rest().data()) || std::any_of(shape.poses().begin(), shape.poses().end(), is_stretched);
}

bool on_one_side(const BodyShape& shape, const Chain& a, const Chain& b) {
  return shape.side(a[0]) != Side::kNone && shape.side(a[0]) == shape.side(b[0]);
}

// Which limbs that hang on one bone are alike, where each of the two is like no other.
std::vector<std::pair<std::size_t, std::size_t>> only_pairs(const BodyShape& shape, const std::vector<Chain>& limbs) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<int> mates(limbs.size(), 0);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    for (std::size_t j = i + 1; j < limbs.size(); ++j) {
      if (on_one_side(shape, limbs[i], limbs[j]) || !alike(shape, limbs[i], limbs[j])) continue;
      pairs.emplace_back(i, j);
      ++mates[i];
      ++mates[j];
    }
  }
  const auto is_unsure = [&](const auto& pair) { return mates[pair.first] > 1 || mates[pair.second] > 1; };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_unsure), pairs.end());
  return pairs;
}

}  // namespace

std::vector<LimbPair> find_limb_pairs(const BodyShape& shape) {
  std::vector<LimbPair> pairs;
  for (int node = 0; node < shape.skeleton().size(); ++node) {
    std::vector<Chain> limbs;
    for (const int child : shape.children(node)) {
      if (shape.branch(child) < kLimb * shape.size()) continue;
      if (Chain chain = shape.chain_from(child); may_be_limb(shape, chain)) limbs.push_back(std::move(chain));
    }
    for (const auto& [a, b] : only_pairs(shape, limbs))
      pairs.push_back({node, {limbs[a], limbs[b]}, shape.branch(limbs[a][0])});
  }
  return pairs;
}

double depth_of(const LimbPair& pair, const Poses& poses) {
  double depth = 0;
  for (const Vector3* heads : poses) {
    for (const Chain& chain : pair.chains) depth += heads[pair.node].z() - heads[chain.back()].z();
  }
  return depth / (2 * static_cast<double>(poses.size()) * pair.length);
}

}  // namespace fragmotion
