// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/rounding.hpp"
#include "skeleton/body_shape.hpp"
#include "skeleton/body_sides.hpp"

namespace fragmotion {
namespace {

// Lengths are shares of BodyShape::size().
constexpr double kHead = 0.03;  // neck and head at least
constexpr double kSure = 1.5;   // votes more for one way to take the pairs than for the other

class ShapeFinder {
 public:
  explicit ShapeFinder(const BodyShape& shape) : shape_(shape) {}

  BodyJoints find() {
    const std::vector<LimbPair> pairs = one_a_bone(find_limb_pairs(shape_));
    if (pairs.size() < 2) return {};
    std::optional<std::pair<LimbPair, LimbPair>> body = legs_and_arms(pairs);
    if (!body) return {};
    auto& [legs, arms] = *body;
    BodyJoints result;
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

  bool points_to_wrong_sides(BodyJoints named) const {
    const int left = named.legs[0].bones[Limb::kEnd];
    return is_flat(named.legs[0]) && is_flat(named.legs[1]) && tell_sides(named) &&
           named.legs[0].bones[Limb::kEnd] != left;
  }

 private:
  // A man has no four limbs on one bone.
  static std::vector<LimbPair> one_a_bone(const std::vector<LimbPair>& pairs) {
    std::vector<LimbPair> alone;
    for (const LimbPair& pair : pairs) {
      const auto beside = [&](const LimbPair& other) { return other.node == pair.node; };
      if (std::count_if(pairs.begin(), pairs.end(), beside) == 1) alone.push_back(pair);
    }
    return alone;
  }

  // What carries both: a pelvis beside the spine carries legs alone. -1 where neither pelvis nor carrier is the hips.
  int carrier(int legs, int arms) const {
    if (shape_.is_below(legs, arms) || shape_.is_below(arms, legs)) return legs;
    int both = legs;
    while (both >= 0 && !shape_.is_below(arms, both)) both = shape_.parent(both);
    return both >= 0 && (shape_.rest()[both] - shape_.rest()[legs]).norm() < kFileRounding * shape_.size() ? both : -1;
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
    if (depth_of(a, shape_.poses()) > kSameWay || depth_of(b, shape_.poses()) > kSameWay || stands(a.node, b.node))
      votes += feet < 0 ? 1.5 : -1.5;
    return votes;
  }

  // Whether the way between two bones is steep on the mean over all poses.
  bool stands(int a, int b) const { return a != b && std::abs(BodyShape::descent(shape_.poses(), a, b)) > kSameWay; }

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

  // Whether names tell where the foot of a leg points, and that is rather level: leaves get tips that go on downward.
  bool is_flat(const Limb& leg) const {
    const int foot = leg.bones[Limb::kEnd];
    if (!leg.whole() || (leg.bones[Limb::kTip] < 0 && !shape_.children(foot).empty())) return false;
    const Vector3 way = pointing(leg, shape_.rest().data());
    return std::abs(way.z()) < way.head<2>().norm();
  }

  bool tell_sides(BodyJoints& body) const {
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

BodyJoints shaped_body(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion) {
  return ShapeFinder(BodyShape(skeleton, tree, motion)).find();
}

bool points_to_wrong_sides(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion,
                           const BodyJoints& named) {
  const BodyShape shape(skeleton, tree, motion);
  return ShapeFinder(shape).points_to_wrong_sides(named);
}

}  // namespace fragmotion
