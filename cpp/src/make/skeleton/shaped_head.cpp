// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/rounding.hpp"
#include "skeleton/body_shape.hpp"
#include "skeleton/body_sides.hpp"

namespace fragmotion {
namespace {

constexpr double kBroad = 0.25;                        // of the trunk's length that shoulders are apart at least
constexpr double kHeadAbove = 0.16, kHeadUnder = 0.5;  // of the trunk's length that a head begins above the shoulders

class HeadFinder {
 public:
  explicit HeadFinder(const BodyShape& shape) : shape_(shape) {}

  /// Tells the head of the body, and how sure that is of a look that is `sure`.
  void find(Chain chain, double sure, BodyJoints& body) const {
    const auto whole = [](const std::array<Limb, 2>& limbs) { return limbs[0].whole() && limbs[1].whole(); };
    if (!whole(body.arms) || !whole(body.legs)) return;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      if (shape_.length(chain[i]) < kFileRounding * shape_.size()) chain.resize(i);  // a face, in the head's place
    }
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (shape_.children(chain[i]).size() > 1) chain.resize(i + 1);  // what carries a face
    }
    const Chain possible = possible_heads(body, chain);
    if (possible.empty()) return;
    body.head = longest_of(possible);
    body.head_confidence = body.head != chain[0] ? sure - 0.1 : 0.5;
  }

 private:
  // Which bone of a neck and what is beyond is the head: the longest, for faces hang on it, and its end may be marked
  // by a last bone that an importer made as long.
  int longest_of(const Chain& chain) const {
    const auto length_of = [&](int bone) { return shape_.skeleton().tips[bone].norm(); };
    int head = chain[0];
    for (const int bone : chain) {
      if (length_of(bone) > (1 + kFileRounding) * length_of(head)) head = bone;
    }
    return head;
  }

  Vector3 between(const std::array<Limb, 2>& limbs, const Vector3* heads) const {
    return (heads[limbs[0].bones[Limb::kUpper]] + heads[limbs[1].bones[Limb::kUpper]]) / 2;
  }

  // How far a bone begins above the shoulders, in lengths of the trunk: the mean over all poses but those that are none
  // of a body, as rest poses of files may be; 0 where there is no other.
  double above_shoulders(const BodyJoints& body, const Poses& poses, int bone) const {
    double above = 0;
    int told = 0;
    for (const Vector3* heads : poses) {
      const Vector3 shoulders = between(body.arms, heads), trunk = shoulders - between(body.legs, heads);
      if (trunk.isZero(0) || across(body.arms, heads).norm() < kBroad * trunk.norm()) continue;
      above += (heads[bone] - shoulders).dot(trunk) / trunk.squaredNorm();
      ++told;
    }
    return above / std::max(told, 1);
  }

  // An importer makes a last bone as long as the one before: it may be the head or mark the head's end.
  bool may_be_mark(const Chain& chain, std::size_t i) const {
    const double length = shape_.skeleton().tips[chain[i]].norm(),
                 before = i > 0 ? shape_.skeleton().tips[chain[i - 1]].norm() : 0;
    return i > 1 && i + 1 == chain.size() && std::abs(length - before) < kFileRounding * length;
  }

  // The bones of a neck and beyond that begin where a head does: at rest and in the motion, where both tell.
  Chain possible_heads(const BodyJoints& body, const Chain& chain) const {
    const Chain rest = possible_heads(body, shape_.resting(), chain);
    const Chain motion = possible_heads(body, shape_.poses(), chain);
    if (rest.empty() || motion.empty()) return rest.empty() ? motion : rest;
    Chain both;
    std::copy_if(rest.begin(), rest.end(), std::back_inserter(both),
                 [&](int bone) { return std::find(motion.begin(), motion.end(), bone) != motion.end(); });
    return both;
  }

  Chain possible_heads(const BodyJoints& body, const Poses& poses, const Chain& chain) const {
    Chain possible;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const double above = above_shoulders(body, poses, chain[i]);
      if (above < kHeadAbove || above > kHeadUnder) continue;
      if (possible.empty() && may_be_mark(chain, i)) possible.push_back(chain[i - 1]);
      possible.push_back(chain[i]);
    }
    return possible;
  }

  const BodyShape& shape_;
};

}  // namespace

void find_shaped_head(const BodyShape& shape, Chain neck, double sure, BodyJoints& body) {
  HeadFinder(shape).find(std::move(neck), sure, body);
}

}  // namespace fragmotion
