// SPDX-License-Identifier: MIT
#include "skeleton/standing_legs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skeleton/body_shape.hpp"

namespace fragmotion {
namespace {

class StandingLegs {
 public:
  StandingLegs(const BodyShape& shape, const BodyTree& tree) : shape_(shape), tree_(tree) {}

  void tell(Roles& roles) const {
    std::vector<LimbPair> legs = beside_each_other(on_ground(pairs(), roles));
    if (legs.empty()) return;
    int carrier = legs[0].node;
    for (const LimbPair& pair : legs) carrier = tree_.common(carrier, pair.node);
    if (roles.hips < 0 || !tree_.is_below(carrier, roles.hips)) roles.hips = carrier;
    std::sort(legs.begin(), legs.end(), [&](const LimbPair& a, const LimbPair& b) { return is_before(b, a); });
    Vector3 ahead = -Vector3::UnitY();
    if (legs.size() > 1) ahead = begin(legs.back()) - begin(legs.front());
    for (LimbPair& pair : legs) put_left_first(ahead, legs.size() == 1, pair);
    const std::size_t hind = legs.size() == 2 ? 0 : legs.size() / 2;
    tell(legs[hind].chains[0], roles.left_thigh, roles.left_foot, roles.left_toe);
    tell(legs[hind].chains[1], roles.right_thigh, roles.right_foot, roles.right_toe);
    if (legs.size() != 2) return;
    tell(legs[1].chains[0], roles.left_fore_leg, roles.left_fore_foot, roles.left_fore_toe);
    tell(legs[1].chains[1], roles.right_fore_leg, roles.right_fore_foot, roles.right_fore_toe);
  }

 private:
  Vector3 head(int bone) const { return shape_.rest()[bone]; }
  Vector3 tip(int bone) const { return head(bone) + shape_.rest_rotation(bone) * shape_.skeleton().tips[bone]; }

  double length(const Chain& chain) const {
    double length = shape_.skeleton().tips[chain.back()].norm();
    for (std::size_t i = 1; i < chain.size(); ++i) length += shape_.length(chain[i]);
    return length;
  }

  // The bone of the body that carries both; what is no part of it may stand between.
  int common(int a, int b) const {
    while (a >= 0 && !shape_.is_below(b, a)) a = shape_.parent(a);
    return a;
  }

  // From below a bone to a leaf.
  Chain chain_below(int node, int leaf) const {
    Chain chain;
    for (int b = leaf; b != node; b = shape_.parent(b)) chain.insert(chain.begin(), b);
    return chain;
  }

  bool are_named_sides(int a, int b) const {
    return shape_.side(a) != Side::kNone && shape_.side(b) != Side::kNone && shape_.side(a) != shape_.side(b);
  }

  // Whether limbs are each other's mirror image, across the body as Blender's front view has it or as they are named.
  bool are_mirrored(const Chain& a, const Chain& b, double length) const {
    if (a.size() != b.size()) return false;
    Vector3 across = tip(a.back()) - tip(b.back());
    across.z() = 0;
    if (across.norm() < kAlike * length) return false;
    if (!are_named_sides(a.back(), b.back()) && std::abs(across.x()) < std::abs(across.y())) return false;
    const Vector3 normal = across.normalized(), middle = 0.5 * (tip(a.back()) + tip(b.back()));
    const auto mirrored = [&](const Vector3& at) { return Vector3{at - 2 * normal.dot(at - middle) * normal}; };
    for (std::size_t i = 0; i < a.size(); ++i) {
      if ((mirrored(head(a[i])) - head(b[i])).norm() > kAlike * length) return false;
    }
    return (mirrored(tip(a.back())) - tip(b.back())).norm() < kAlike * length;
  }

  // Without the bones of the trunk that limbs begin with: those on the midline, and stubs.
  void begin_with_legs(LimbPair& pair) const {
    Chain &a = pair.chains[0], &b = pair.chains[1];
    const auto is_of_trunk = [&] {
      return (head(a[0]) - head(b[0])).norm() < kAlike * pair.length || shape_.length(a[1]) < kNoLegBone * pair.length;
    };
    while (a.size() > 2 && is_of_trunk()) a.erase(a.begin()), b.erase(b.begin());
    pair.length = length(a);
  }

  // Of each leg the longest way to the end of a toe.
  std::vector<LimbPair> pairs() const {
    std::vector<int> leaves;
    for (int b = 0; b < shape_.skeleton().size(); ++b) {
      if (tree_.in_body[b] && shape_.children(b).empty()) leaves.push_back(b);
    }
    std::vector<LimbPair> pairs;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      for (std::size_t j = i + 1; j < leaves.size(); ++j) {
        if (shape_.parent(leaves[i]) == shape_.parent(leaves[j]))
          continue;  // of one bone each, of which there may be many
        const int node = common(leaves[i], leaves[j]);
        if (node < 0) continue;
        LimbPair pair{node, {chain_below(node, leaves[i]), chain_below(node, leaves[j])}, 0};
        pair.length = length(pair.chains[0]);
        if (pair.chains[0].size() < 2 || !are_mirrored(pair.chains[0], pair.chains[1], pair.length)) continue;
        begin_with_legs(pair);
        keep_longest(std::move(pair), pairs);
      }
    }
    return pairs;
  }

  static void keep_longest(LimbPair pair, std::vector<LimbPair>& pairs) {
    const auto begins_so = [&](const LimbPair& other) { return other.chains[0].front() == pair.chains[0].front(); };
    const auto same = std::find_if(pairs.begin(), pairs.end(), begins_so);
    if (same == pairs.end())
      pairs.push_back(std::move(pair));
    else if (pair.length > same->length)
      *same = std::move(pair);
  }

  double bottom(const LimbPair& pair) const {
    return std::min(head(pair.chains[0].back()).z(), tip(pair.chains[0].back()).z());
  }

  Vector3 begin(const LimbPair& pair) const {
    return 0.5 * (head(pair.chains[0].front()) + head(pair.chains[1].front()));
  }

  Vector3 end(const LimbPair& pair) const { return 0.5 * (head(pair.chains[0].back()) + head(pair.chains[1].back())); }

  // What ends lowest of the whole body, of which a root may be on any height.
  std::vector<LimbPair> on_ground(std::vector<LimbPair> pairs, const Roles& roles) const {
    double ground = std::numeric_limits<double>::infinity();
    for (int b = roles.hips == 0 ? 0 : 1; b < shape_.skeleton().size(); ++b) {
      if (tree_.in_body[b]) ground = std::min(ground, head(b).z());
    }
    for (const LimbPair& pair : pairs) ground = std::min(ground, bottom(pair));
    const auto hangs = [&](const LimbPair& pair) {
      const Chain& chain = pair.chains[0];
      const auto has_hand = [&](int b) { return b == roles.left_hand || b == roles.right_hand; };
      return bottom(pair) - ground > kStands * pair.length || bottom(pair) > begin(pair).z() ||
             std::any_of(chain.begin(), chain.end(), has_hand);
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), hangs), pairs.end());
    return pairs;
  }

  // Without those that hang from above, as arms do, rather than stand beside what begins lowest; two pairs carry a
  // trunk.
  std::vector<LimbPair> beside_each_other(std::vector<LimbPair> pairs) const {
    if (pairs.empty()) return pairs;
    const auto is_lower = [&](const LimbPair& a, const LimbPair& b) { return begin(a).z() < begin(b).z(); };
    std::iter_swap(pairs.begin(), std::min_element(pairs.begin(), pairs.end(), is_lower));
    const auto along = [&](const LimbPair& pair) { return (end(pair) - end(pairs[0])).head<2>().norm(); };
    const auto hangs = [&](const LimbPair& pair) { return along(pair) < (begin(pair) - begin(pairs[0])).z(); };
    pairs.erase(std::remove_if(pairs.begin() + 1, pairs.end(), hangs), pairs.end());
    if (pairs.size() == 2 && along(pairs[1]) < kTrunkLength * pairs[0].length) pairs.pop_back();
    return pairs;
  }

  int named_head() const {
    for (int b = 0; b < tree_.size(); ++b) {
      if (tree_.in_body[b] && tree_.names[b].side == Side::kNone && tree_.says(b, Role::kHead) > 0) return b;
    }
    return -1;
  }

  bool is_named_fore(const LimbPair& pair) const {
    const auto is_fore = [&](int bone) { return has_any_word(tree_.names[bone], {"front", "fore"}); };
    return std::any_of(pair.chains[0].begin(), pair.chains[0].end(), is_fore);
  }

  // Whether a pair stands before another.
  bool is_before(const LimbPair& a, const LimbPair& b) const {
    if (is_named_fore(a) != is_named_fore(b)) return is_named_fore(a);
    const int known = named_head();
    if (known < 0) return begin(a).y() < begin(b).y();
    return (begin(a) - head(known)).head<2>().norm() < (begin(b) - head(known)).head<2>().norm();
  }

  // The foot is the last bone, or the one before toes on the ground.
  void tell(const Chain& chain, int& thigh, int& foot, int& toe) const {
    std::size_t end = chain.size() - 1;
    const double ground = std::min(head(chain.back()).z(), tip(chain.back()).z());
    while (end > 1 && head(chain[end - 1]).z() - ground < kStands * length(chain)) --end;
    thigh = chain[0];
    foot = chain[end];
    toe = end + 1 < chain.size() ? chain[end + 1] : -1;
  }

  // As the way from the hind pair to the fore one tells, else the names, else the front view.
  void put_left_first(const Vector3& ahead, bool by_names, LimbPair& pair) const {
    auto& [a, b] = pair.chains;
    const double left = (head(a[0]) - head(b[0])).dot(Vector3::UnitZ().cross(ahead));
    const bool is_named = by_names && are_named_sides(a[0], b[0]);
    if (is_named ? shape_.side(b[0]) == Side::kLeft : left < 0) std::swap(a, b);
  }

  const BodyShape& shape_;
  const BodyTree& tree_;
};

}  // namespace

void tell_standing_legs(const Skeleton& skeleton, Roles& roles) {
  const BodyTree tree(skeleton);
  const BodyShape shape(skeleton, tree, nullptr);
  StandingLegs(shape, tree).tell(roles);
}

}  // namespace fragmotion
