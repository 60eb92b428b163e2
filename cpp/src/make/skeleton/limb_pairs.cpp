// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "skeleton/body_shape.hpp"

namespace fragmotion {
namespace {

// Lengths are shares of BodyShape::size().
constexpr double kLimb = 0.2;     // a limb at least
constexpr double kLongest = 0.6;  // of the way along its bones, from a limb's beginning to its end
constexpr double kAlike = 0.05;   // of a limb's length: bones of a pair differ by less
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

}  // namespace

std::vector<LimbPair> find_limb_pairs(const BodyShape& shape) {
  std::vector<LimbPair> pairs;
  for (int node = 0; node < shape.skeleton().size(); ++node) {
    std::vector<Chain> limbs;
    for (const int child : shape.children(node)) {
      if (shape.branch(child) < kLimb * shape.size()) continue;
      if (Chain chain = shape.chain_from(child); may_be_limb(shape, chain)) limbs.push_back(std::move(chain));
    }
    std::optional<LimbPair> pair;
    int found = 0;
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      for (std::size_t j = i + 1; j < limbs.size(); ++j) {
        if (!alike(shape, limbs[i], limbs[j])) continue;
        pair = LimbPair{node, {limbs[i], limbs[j]}, shape.branch(limbs[i][0])};
        ++found;
      }
    }
    if (found == 1) pairs.push_back(*pair);
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
