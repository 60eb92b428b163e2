// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "skeleton/body_shape.hpp"
#include "skeleton/body_sides.hpp"

namespace fragmotion {
namespace {

// Lengths are shares of BodyShape::size().
constexpr double kLimb = 0.2;           // a limb at least
constexpr double kLongest = 0.6;        // of the way along its bones, from a limb's beginning to its end
constexpr double kAlike = 0.05;         // of a limb's length: bones of a pair differ by less
constexpr double kHand = 0.3;           // of a limb's length that hands and feet reach at most
constexpr double kHead = 0.03;          // neck and head at least
constexpr double kPelvis = 0.02;        // between the hips and a pelvis at most
constexpr double kSure = 1.5;           // votes more for one way to take the pairs than for the other
constexpr std::size_t kLimbJoints = 3;  // of a limb at least: where its upper and lower bone and its end begin

class ShapeFinder {
 public:
  explicit ShapeFinder(const BodyShape& shape) : shape_(shape) {}

  Body find() {
    const std::vector<LimbPair> pairs = find_pairs();
    if (pairs.size() < 2) return {};
    std::optional<std::pair<LimbPair, LimbPair>> body = legs_and_arms(pairs);
    if (!body) return {};
    auto& [legs, arms] = *body;
    Body result;
    result.hips = carrier(legs.node, arms.node);
    result.hips_confidence = sure_;
    result.chest = arms.node;
    result.legs = shaped_limbs(shape_, legs, false, sure_);
    result.arms = shaped_limbs(shape_, arms, true, sure_);
    if (!result.legs[0].whole()) return {};
    find_shaped_head(shape_, middle(arms, legs.node), sure_, result);
    if (!tell_sides(result)) result.legs = result.arms = {};
    return result;
  }

 private:
  // As far as the hands: which finger reaches farthest may differ.
  bool alike(const Chain& a, const Chain& b, double limb) const {
    const auto is_hand = [&](const Chain& chain, std::size_t i) {
      return i > 0 && shape_.reach(chain[i - 1]) < kHand * limb;
    };
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (is_hand(a, i) && is_hand(b, i)) return true;
      if (i >= a.size() || i >= b.size() || std::abs(shape_.length(a[i]) - shape_.length(b[i])) > kAlike * limb)
        return false;
    }
    return true;
  }

  // Whether it has the joints of a limb, and is ever stretched: what controls a foot is folded up.
  bool may_be_limb(const Chain& chain) const {
    if (chain.size() < kLimbJoints) return false;
    const double farthest = kLongest * shape_.reach(chain.front());
    const auto is_stretched = [&](const Vector3* heads) {
      return (heads[chain.back()] - heads[chain.front()]).norm() > farthest;
    };
    return is_stretched(shape_.rest().data()) ||
           std::any_of(shape_.poses().begin(), shape_.poses().end(), is_stretched);
  }

  std::vector<LimbPair> find_pairs() const {
    std::vector<LimbPair> pairs;
    for (int node = 0; node < shape_.skeleton().size(); ++node) {
      std::vector<Chain> limbs;
      for (const int child : shape_.children(node)) {
        if (shape_.branch(child) < kLimb * shape_.size()) continue;
        if (Chain chain = shape_.chain_from(child); may_be_limb(chain)) limbs.push_back(std::move(chain));
      }
      std::optional<LimbPair> pair;
      int found = 0;
      for (std::size_t i = 0; i < limbs.size(); ++i) {
        for (std::size_t j = i + 1; j < limbs.size(); ++j) {
          const double limb = shape_.branch(limbs[i][0]);
          if (!alike(limbs[i], limbs[j], limb)) continue;
          pair = LimbPair{node, {limbs[i], limbs[j]}, limb};
          ++found;
        }
      }
      if (found == 1) pairs.push_back(*pair);
    }
    return pairs;
  }

  // What carries both: a pelvis beside the spine carries legs alone. -1 where neither pelvis nor carrier is the hips.
  int carrier(int legs, int arms) const {
    if (shape_.is_below(legs, arms) || shape_.is_below(arms, legs)) return legs;
    int both = legs;
    while (both >= 0 && !shape_.is_below(arms, both)) both = shape_.parent(both);
    return both >= 0 && (shape_.rest()[both] - shape_.rest()[legs]).norm() < kPelvis * shape_.size() ? both : -1;
  }

  // The longest chain at a node that is neither of the pair's nor leads to the other pair.
  Chain middle(const LimbPair& pair, int other) const {
    Chain longest;
    double most = kHead * shape_.size();
    for (const int child : shape_.children(pair.node)) {
      if (child == pair.chains[0][0] || child == pair.chains[1][0] || shape_.is_below(other, child)) continue;
      const double far = shape_.branch(child);
      if (far > most) most = far, longest = shape_.chain_from(child);
    }
    return longest;
  }

  // How far the ends of a pair's limbs are under their node, on the mean over all poses, in lengths of the limbs.
  double under(const LimbPair& pair) const {
    double depth = 0;
    for (const Vector3* heads : shape_.poses()) {
      for (const Chain& chain : pair.chains) depth += heads[pair.node].z() - heads[chain.back()].z();
    }
    return depth / (2 * static_cast<double>(shape_.poses().size()) * pair.length);
  }

  double two_longest(const LimbPair& pair) const {
    double first = 0, second = 0;
    for (std::size_t i = 1; i < pair.chains[0].size(); ++i) {
      const double bone = shape_.length(pair.chains[0][i]);
      if (bone > first)
        second = first, first = bone;
      else
        second = std::max(second, bone);
    }
    return first + second;
  }

  // For `a` being the legs.
  double votes(const LimbPair& a, const LimbPair& b) const {
    const auto more = [](double x, double y, double weight) { return x > y ? weight : x < y ? -weight : 0; };
    double votes = more(two_longest(a), 1.05 * two_longest(b), 1);
    votes += more(shape_.leaves(b.chains[0][0]), shape_.leaves(a.chains[0][0]), 0.5);
    votes += !middle(b, a.node).empty() - !middle(a, b.node).empty();
    votes += shape_.is_below(b.node, a.node) ? 0.5 : -0.5;
    const double feet = lowest(a) - lowest(b);
    if (under(a) > kUpright || under(b) > kUpright || stands(a.node, b.node)) votes += feet < 0 ? 1.5 : -1.5;
    return votes;
  }

  // Whether the way between two bones is steep on the mean over all poses.
  bool stands(int a, int b) const { return a != b && std::abs(BodyShape::descent(shape_.poses(), a, b)) > kUpright; }

  double lowest(const LimbPair& pair) const {
    double height = 0;
    for (const Vector3* heads : shape_.poses())
      height += std::min(heads[pair.chains[0].back()].z(), heads[pair.chains[1].back()].z());
    return height / static_cast<double>(shape_.poses().size());
  }

  std::optional<std::pair<LimbPair, LimbPair>> legs_and_arms(std::vector<LimbPair> pairs) {
    std::sort(pairs.begin(), pairs.end(), [](const LimbPair& a, const LimbPair& b) { return a.length > b.length; });
    const LimbPair &a = pairs[0], &b = pairs[1];
    const double told = votes(a, b);
    if (std::abs(told) < kSure) return std::nullopt;
    sure_ = std::min(0.9, 0.6 + 0.1 * std::abs(told));
    return told > 0 ? std::pair{a, b} : std::pair{b, a};
  }

  // Where a foot's end is: the next bone's head, at rest also its tip; zero where neither is known.
  Vector3 pointing(const Limb& leg, const Vector3* heads) const {
    const int foot = leg.bones[Limb::kEnd];
    int next = leg.bones[Limb::kTip];
    if (next < 0 && !shape_.children(foot).empty()) next = shape_.chain_from(foot)[1];
    if (next >= 0) return heads[next] - heads[foot];
    return heads == shape_.rest().data() ? Vector3{shape_.rest_rotation(foot) * shape_.skeleton().tips[foot]}
                                         : Vector3::Zero();
  }

  bool tell_sides(Body& body) const {
    if (!body.legs[0].whole() || !body.legs[1].whole()) return false;
    std::vector<PosedFeet> poses;
    for (const Vector3* heads : shape_.poses()) {
      poses.push_back({heads, {pointing(body.legs[0], heads), pointing(body.legs[1], heads)}});
    }
    return put_left_first(poses, body);
  }

  const BodyShape& shape_;
  double sure_ = 0;
};

}  // namespace

Body shaped_body(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion) {
  return ShapeFinder(BodyShape(skeleton, tree, motion)).find();
}

}  // namespace fragmotion
