// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "skeleton/body_shape.hpp"
#include "skeleton/body_sides.hpp"

namespace fragmotion {
namespace {

// Of a leg's length.
constexpr double kFeetLevel = 0.2;    // between the heights of the hind and the fore feet, at most
constexpr double kTrunkLength = 0.3;  // between the hind and the fore feet along the ground, at least
constexpr double kNoLegBone = 0.1;    // a bone that a leg begins with and that is shorter is a part of the trunk
constexpr double kMeet = 2.0 / 3;    // of how far the ends of hip bones and shoulder blades are apart: their beginnings
constexpr double kPawHeight = 0.15;  // over the ground, at most: where a paw begins
constexpr double kByShape = 0.85;

class FourLegs {
 public:
  FourLegs(const BodyShape& shape, const BodyTree& tree) : shape_(shape), tree_(tree) {}

  std::optional<BodyJoints> find() const {
    std::vector<LimbPair> legs;
    for (LimbPair& pair : find_limb_pairs(shape_)) {
      if (leads_down(pair)) legs.push_back(std::move(pair));
    }
    if (legs.size() != 2 || !carry_a_trunk(legs[0], legs[1])) return std::nullopt;
    const int head = find_head(legs);
    if (head < 0 && legs[0].node == legs[1].node) return std::nullopt;
    if (fore_of(legs, head) == 0) std::swap(legs[0], legs[1]);
    BodyJoints body;
    body.four_legged = true;
    body.hips = hips_of(legs);
    body.hips_confidence = kByShape;
    body.chest = legs[1].node;
    body.head = head;
    body.head_confidence = head >= 0 && tree_.says(head, Role::kHead) > 0 ? kNamed : kByShape;
    for (int side = 0; side < 2; ++side) {
      body.legs[side] = leg(legs[0], side);
      body.arms[side] = leg(legs[1], side);
    }
    put_left_first(begin(legs[1]) - begin(legs[0]), body);
    return body;
  }

 private:
  const Vector3& at(int bone) const { return shape_.rest()[bone]; }

  // Between where a pair's limbs begin.
  Vector3 begin(const LimbPair& pair) const { return 0.5 * (at(pair.chains[0].front()) + at(pair.chains[1].front())); }

  // Whatever the height of the bone that it hangs on.
  bool leads_down(const LimbPair& pair) const {
    return std::all_of(pair.chains.begin(), pair.chains.end(), [&](const Chain& chain) {
      return BodyShape::descent(shape_.resting(), chain.front(), chain.back()) > kUpright;
    });
  }

  double lowest(const LimbPair& pair) const {
    return std::min(at(pair.chains[0].back()).z(), at(pair.chains[1].back()).z());
  }

  // Between where a pair's limbs end.
  Vector3 end(const LimbPair& pair) const { return 0.5 * (at(pair.chains[0].back()) + at(pair.chains[1].back())); }

  // Whether all their feet stand on the ground, and what is between hips and shoulders lies rather than stands. Limbs
  // may begin with bones of the trunk, so how long it is is told by the feet.
  bool carry_a_trunk(const LimbPair& a, const LimbPair& b) const {
    const double leg = std::min(a.length, b.length), along = (end(b) - end(a)).head<2>().norm();
    return std::abs(lowest(a) - lowest(b)) < kFeetLevel * leg && along > kTrunkLength * leg &&
           along > std::abs((begin(b) - begin(a)).z());
  }

  int find_head(const std::vector<LimbPair>& legs) const {
    int head = -1;
    double most = 0;
    for (int b = 0; b < tree_.size(); ++b) {
      const double said = tree_.in_body[b] && tree_.names[b].side == Side::kNone ? tree_.says(b, Role::kHead) : 0;
      if (said > most && (shape_.is_below(b, legs[0].node) || shape_.is_below(b, legs[1].node))) most = said, head = b;
    }
    return head;
  }

  // Which pair is the fore one: the one by the head, else the one that hangs on the other.
  int fore_of(const std::vector<LimbPair>& legs, int head) const {
    if (head < 0) return shape_.is_below(legs[0].node, legs[1].node) ? 0 : 1;
    return (at(head) - begin(legs[0])).norm() < (at(head) - begin(legs[1])).norm() ? 0 : 1;
  }

  // What carries both pairs, from the hind one on.
  int hips_of(const std::vector<LimbPair>& legs) const {
    int hips = legs[0].node;
    while (shape_.parent(hips) >= 0 && !shape_.is_below(legs[1].node, hips)) hips = shape_.parent(hips);
    return hips;
  }

  // Between a joint of a pair and its fellow, m.
  double across(const LimbPair& pair, std::size_t joint) const {
    return (at(pair.chains[0][joint]) - at(pair.chains[1][joint])).norm();
  }

  // Whether a bone that limbs begin with is one of the trunk: a stub, or a hip bone or shoulder blade, which leads out.
  bool is_of_trunk(const LimbPair& pair, int side, std::size_t joint) const {
    const Chain& chain = pair.chains[side];
    return shape_.length(chain[joint + 1]) < kNoLegBone * shape_.branch(chain[0]) ||
           across(pair, joint) < kMeet * across(pair, joint + 1);
  }

  Limb leg(const LimbPair& pair, int side) const {
    const Chain& chain = pair.chains[side];
    const double length = shape_.branch(chain[0]), ground = at(chain.back()).z();
    std::size_t upper = 0, foot = chain.size() - 1;
    const std::size_t bones = std::min(pair.chains[0].size(), pair.chains[1].size());
    while (upper + 3 < bones && is_of_trunk(pair, side, upper)) ++upper;
    while (foot > upper + 2 && at(chain[foot - 1]).z() - ground < kPawHeight * length) --foot;
    Limb limb;
    const auto set = [&](int part, std::size_t i) {
      limb.bones[part] = chain[i];
      limb.confidence[part] = kByShape;
    };
    set(Limb::kUpper, upper);
    set(Limb::kEnd, foot);
    if (foot + 1 < chain.size()) set(Limb::kTip, foot + 1);
    return limb;
  }

  void put_left_first(const Vector3& forward, BodyJoints& body) const {
    const Vector3 left = Vector3::UnitZ().cross(forward);
    for (auto* legs : {&body.legs, &body.arms}) {
      if (fragmotion::across(*legs, shape_.rest().data()).dot(left) < 0) std::swap((*legs)[0], (*legs)[1]);
    }
  }

  const BodyShape& shape_;
  const BodyTree& tree_;
};

}  // namespace

std::optional<BodyJoints> four_legged_body(const Skeleton& skeleton, const BodyTree& tree) {
  const BodyShape shape(skeleton, tree, nullptr);
  return FourLegs(shape, tree).find();
}

}  // namespace fragmotion
