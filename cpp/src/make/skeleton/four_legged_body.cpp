// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "skeleton/body_shape.hpp"
#include "skeleton/body_sides.hpp"

namespace fragmotion {
namespace {

// Of a leg's length.
constexpr double kFeetLevel = 0.2;  // between the heights of the hind and the fore feet, at most
constexpr double kMeet = 2.0 / 3;   // of how far the ends of hip bones and shoulder blades are apart: their beginnings
constexpr double kByShape = 0.85;

constexpr double kLowerLeg = 0.4;  // of a leg, at least: what is below its knee or elbow

class FourLegs {
 public:
  FourLegs(const BodyShape& shape, const BodyTree& tree) : shape_(shape), tree_(tree) {}

  std::vector<LimbPair> legs() const {
    std::vector<LimbPair> legs;
    for (LimbPair& pair : find_limb_pairs(shape_)) {
      if (leads_down(pair.chains[0]) && leads_down(pair.chains[1])) legs.push_back(std::move(pair));
    }
    return legs;
  }

  std::optional<BodyJoints> find(std::vector<LimbPair> legs) const {
    if (legs.size() != 2 || !carry_a_trunk(legs[0], legs[1]) || has_arms(legs)) return std::nullopt;
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
    put_left_first(legs, body);
    return body;
  }

 private:
  // The mean over the poses.
  template <typename Of>
  double mean(const Of& of) const {
    double sum = 0;
    for (const Vector3* heads : shape_.poses()) sum += of(heads);
    return sum / static_cast<double>(shape_.poses().size());
  }

  // Whatever the height of the bone that it hangs on; and whoever goes on hands and knees has shins that lie.
  bool leads_down(const Chain& chain) const {
    return BodyShape::descent(shape_.poses(), chain.front(), chain.back()) > kSameWay &&
           (!shape_.moves() || BodyShape::descent(shape_.poses(), knee(chain), chain.back()) > kSameWay);
  }

  int knee(const Chain& chain) const {
    const auto is_lower = [&](int bone) { return shape_.reach(bone) < kLowerLeg * shape_.reach(chain.front()); };
    return *(std::find_if(chain.begin() + 1, chain.end(), is_lower) - 1);
  }

  // Between where a pair's limbs begin.
  static Vector3 begin(const LimbPair& pair, const Vector3* heads) {
    return 0.5 * (heads[pair.chains[0].front()] + heads[pair.chains[1].front()]);
  }

  static double lowest(const LimbPair& pair, const Vector3* heads) {
    return std::min(heads[pair.chains[0].back()].z(), heads[pair.chains[1].back()].z());
  }

  // Between where a pair's limbs end.
  static Vector3 end(const LimbPair& pair, const Vector3* heads) {
    return 0.5 * (heads[pair.chains[0].back()] + heads[pair.chains[1].back()]);
  }

  // Whether all their feet stand on the ground, and what is between hips and shoulders lies rather than stands. Limbs
  // may begin with bones of the trunk, so how long it is is told by the feet.
  bool carry_a_trunk(const LimbPair& a, const LimbPair& b) const {
    const double leg = std::min(a.length, b.length);
    const double along = mean([&](const Vector3* heads) { return (end(b, heads) - end(a, heads)).head<2>().norm(); });
    const double feet = mean([&](const Vector3* heads) { return lowest(a, heads) - lowest(b, heads); });
    const double rise = mean([&](const Vector3* heads) { return std::abs((begin(b, heads) - begin(a, heads)).z()); });
    return std::abs(feet) < kFeetLevel * leg && along > kTrunkLength * leg && along > rise;
  }

  // Whether bones beside all legs are named as arms are: of a man who can have an animal's legs besides.
  bool has_arms(const std::vector<LimbPair>& legs) const {
    const auto is_of_legs = [&](int bone) {
      return std::any_of(legs.begin(), legs.end(), [&](const LimbPair& pair) {
        return shape_.is_below(bone, pair.chains[0].front()) || shape_.is_below(bone, pair.chains[1].front());
      });
    };
    std::array<bool, 2> found{};
    for (int b = 0; b < tree_.size(); ++b) {
      const Side side = tree_.names[b].side;
      const bool is_arm = tree_.in_body[b] && side != Side::kNone && tree_.says(b, Role::kLowerArm) > 2;
      if (is_arm && !is_of_legs(b)) found[side == Side::kLeft ? 0 : 1] = true;
    }
    return found[0] && found[1];
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

  bool is_named_fore(const LimbPair& pair) const {
    const auto is_fore = [&](int bone) { return has_any_word(tree_.names[bone], {"front", "fore"}); };
    return std::any_of(pair.chains[0].begin(), pair.chains[0].end(), is_fore);
  }

  // Which pair is the fore one: the one that is named so, the one by the head, or the one that hangs on the other.
  int fore_of(const std::vector<LimbPair>& legs, int head) const {
    const bool first = is_named_fore(legs[0]);
    if (first != is_named_fore(legs[1])) return first ? 0 : 1;
    if (head < 0) return shape_.is_below(legs[0].node, legs[1].node) ? 0 : 1;
    const auto way = [&](const LimbPair& pair) {
      return mean([&](const Vector3* heads) { return (heads[head] - begin(pair, heads)).norm(); });
    };
    return way(legs[0]) < way(legs[1]) ? 0 : 1;
  }

  // What carries both pairs, from the hind one on.
  int hips_of(const std::vector<LimbPair>& legs) const {
    int hips = legs[0].node;
    while (shape_.parent(hips) >= 0 && !shape_.is_below(legs[1].node, hips)) hips = shape_.parent(hips);
    return hips;
  }

  // Between a joint of a pair and its fellow, m.
  double width(const LimbPair& pair, std::size_t joint) const {
    return mean(
        [&](const Vector3* heads) { return (heads[pair.chains[0][joint]] - heads[pair.chains[1][joint]]).norm(); });
  }

  // Whether a bone that limbs begin with is one of the trunk: a stub, or a hip bone or shoulder blade, which leads out.
  bool is_of_trunk(const LimbPair& pair, int side, std::size_t joint) const {
    const Chain& chain = pair.chains[side];
    return shape_.length(chain[joint + 1]) < kNoLegBone * shape_.branch(chain[0]) ||
           width(pair, joint) < kMeet * width(pair, joint + 1);
  }

  Limb leg(const LimbPair& pair, int side) const {
    const Chain& chain = pair.chains[side];
    const double length = shape_.branch(chain[0]);
    const auto height = [&](int bone) {
      return mean([&](const Vector3* heads) { return heads[bone].z() - heads[chain.back()].z(); });
    };
    std::size_t upper = 0, foot = chain.size() - 1;
    const std::size_t bones = std::min(pair.chains[0].size(), pair.chains[1].size());
    while (upper + 3 < bones && is_of_trunk(pair, side, upper)) ++upper;
    while (foot > upper + 2 && height(chain[foot - 1]) < kStands * length) --foot;
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

  void put_left_first(const std::vector<LimbPair>& legs, BodyJoints& body) const {
    for (auto* limbs : {&body.legs, &body.arms}) {
      const double left = mean([&](const Vector3* heads) {
        const Vector3 forward = begin(legs[1], heads) - begin(legs[0], heads);
        return across(*limbs, heads).dot(Vector3::UnitZ().cross(forward));
      });
      if (left < 0) std::swap((*limbs)[0], (*limbs)[1]);
    }
  }

  const BodyShape& shape_;
  const BodyTree& tree_;
};

Limb told_leg(const LegRoles& leg) {
  Limb limb;
  limb.bones = {-1, leg.thigh, -1, leg.foot, leg.toe};
  limb.confidence.fill(kByShape);
  return limb;
}

bool is_told(const Limb& limb) { return limb.bones[Limb::kUpper] >= 0 && limb.bones[Limb::kEnd] >= 0; }

// Of a skeleton that has them from somebody.
std::optional<BodyJoints> told_body(const Skeleton& skeleton) {
  const std::array<LegRoles, kMostLegs> legs = leg_roles(skeleton.roles);
  BodyJoints body;
  body.four_legged = true;
  body.hips = skeleton.roles.hips;
  body.head = skeleton.roles.head;
  body.hips_confidence = body.head_confidence = kByShape;
  for (int side = 0; side < 2; ++side) {
    body.legs[side] = told_leg(legs[side]);
    body.arms[side] = told_leg(legs[2 + side]);
    if (body.hips < 0 || !is_told(body.legs[side]) || !is_told(body.arms[side])) return std::nullopt;
  }
  return body;
}

}  // namespace

std::optional<BodyJoints> four_legged_body(const Skeleton& skeleton, const BodyTree& tree,
                                           const ObservedPoses* motion) {
  if (std::optional<BodyJoints> told = told_body(skeleton)) return told;
  const BodyShape resting(skeleton, tree, nullptr);
  const FourLegs at_rest(resting, tree);
  if (std::vector<LimbPair> legs = at_rest.legs(); !legs.empty() || !motion) return at_rest.find(std::move(legs));
  const BodyShape moving(skeleton, tree, motion);
  const FourLegs in_motion(moving, tree);
  return in_motion.find(in_motion.legs());
}

}  // namespace fragmotion
