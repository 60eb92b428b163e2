// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "skeleton/body_shape.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kAsLong = 0.75;  // of a bone's length, that another one of its limb has which is about as long
constexpr double kNarrow = 0.25;  // of the way from arm to arm over the collars, that collars are apart at most

using Joints = std::array<int, 3>;  // of a limb's chain: where its upper and lower bone and its end begin

class LimbShaper {
 public:
  LimbShaper(const BodyShape& shape, double sure) : shape_(shape), sure_(sure) {}

  std::array<Limb, 2> find(const LimbPair& pair, bool arm) const {
    const bool collared = arm && begins_with_collars(pair);
    const Joints found = joints(pair.chains[0], parts(pair), collared ? 1 : 0);
    return {limb(pair.chains[0], found, arm, collared), limb(pair.chains[1], found, arm, collared)};
  }

 private:
  double way(const Chain& chain, int from, int to) const {
    return (shape_.rest()[chain[to]] - shape_.rest()[chain[from]]).norm();
  }

  // How much a joint of a chain bends in the motion, rad.
  double bends(const Chain& chain, std::size_t i) const {
    double least = kPi, most = 0;
    for (const Vector3* heads : shape_.poses()) {
      const Vector3 before = heads[chain[i]] - heads[chain[i - 1]], after = heads[chain[i + 1]] - heads[chain[i]];
      const double angle = std::atan2(before.cross(after).norm(), before.dot(after));
      least = std::min(least, angle);
      most = std::max(most, angle);
    }
    return most - least;
  }

  // Which bones of limbs may be only parts of those before: in the motion they hardly bend against them.
  std::vector<bool> parts(const LimbPair& pair) const {
    const auto& [left, right] = pair.chains;
    std::vector<bool> parts(std::min(left.size(), right.size()), false);
    for (std::size_t i = 1; shape_.moves() && i + 1 < parts.size(); ++i) {
      parts[i] = bends(left, i) < kBends && bends(right, i) < kBends;
    }
    return parts;
  }

  // Collar bones begin beside each other; upper arms begin at both sides.
  bool begins_with_collars(const LimbPair& pair) const {
    const auto& [left, right] = pair.chains;
    const double between = (shape_.rest()[left[0]] - shape_.rest()[right[0]]).norm();
    const double across = between + shape_.length(left[1]) + shape_.length(right[1]);
    return between < kNarrow * across;
  }

  // Where the two longest bones that follow each other begin and end. Such a bone may have parts; but a wrist that is
  // held still is no part of a lower arm, and adds less to its length than a part does.
  Joints joints(const Chain& chain, const std::vector<bool>& part, int first) const {
    const int bones = static_cast<int>(part.size());
    Joints best{-1, -1, -1};
    double most = 0;
    for (int upper = first; upper + 2 < bones; ++upper) {
      for (int lower = upper + 1; lower + 1 < bones && !part[upper]; ++lower) {
        if (shape_.has_fingers(chain[lower])) break;
        for (int end = lower + 1; end < bones && !part[lower]; ++end) {
          const int skipped = end - upper - 2;
          const double shorter =
              std::min(way(chain, upper, lower), way(chain, lower, end)) * std::pow(kAsLong, skipped);
          if (shorter > most) most = shorter, best = {upper, lower, end};
          if (!part[end] || shape_.has_fingers(chain[end])) break;
        }
        if (!part[lower]) break;
      }
    }
    return best;
  }

  // Whether a bone leads ahead that a steeper one leads down to.
  static bool is_foot(const Poses& poses, const Chain& chain, int shin, int foot) {
    return BodyShape::descent(poses, chain[shin], chain[foot]) >
           BodyShape::descent(poses, chain[foot], chain[foot + 1]);
  }

  Limb limb(const Chain& chain, const Joints& joints, bool arm, bool collared) const {
    const auto [upper, lower, end] = joints;
    if (upper < 0) return {};
    if (arm && upper == 0 && lower > 1) return {};  // a shoulder against which the arm is held still looks like a part
    const int bones = static_cast<int>(chain.size());
    const double most = kAsLong * std::min(way(chain, upper, lower), way(chain, lower, end));
    const bool hand =
        shape_.has_fingers(chain[end]);  // whose lower arm and elbow are told, so what is before is a shoulder
    const bool in_parts =
        arm && !shape_.moves() && !hand && way(chain, lower, end) < kAsLong * way(chain, upper, lower);
    if (in_parts) return {};  // or so it may be: motion would tell
    const bool shoulder = (hand && shape_.moves()) || (collared && upper == 1);
    const bool foot = !arm && end + 1 < bones &&
                      (is_foot(shape_.resting(), chain, lower, end) || is_foot(shape_.poses(), chain, lower, end));
    if (upper > 0 && way(chain, upper - 1, upper) > most && !shoulder) return {};
    if (end + 1 < bones && way(chain, end, end + 1) > most && !hand && !foot) return {};
    Limb limb;
    const auto set = [&](int part, int i, double confidence) {
      limb.bones[part] = chain[i];
      limb.confidence[part] = confidence;
    };
    if (arm && upper > 0) set(Limb::kFirst, 0, sure_ - 0.1);
    set(Limb::kUpper, upper, sure_);
    set(Limb::kLower, lower, sure_);
    set(Limb::kEnd, end, sure_);
    if (!arm && has_toe(chain, end)) set(Limb::kTip, end + 1, sure_ - 0.15);
    return limb;
  }

  // Of several toes none is told.
  bool has_toe(const Chain& chain, int foot) const {
    const int bones = static_cast<int>(chain.size());
    if (foot + 1 >= bones) return false;
    const int toe = chain[foot + 1];
    const auto is_as_long = [&](int other) {
      return other != toe && shape_.branch(other) > kAsLong * shape_.branch(toe);
    };
    const std::vector<int>& beside = shape_.children(chain[foot]);
    if (std::any_of(beside.begin(), beside.end(), is_as_long)) return false;
    return foot + 2 < bones || shape_.skeleton().tips[toe].norm() > kFileRounding * shape_.size();
  }

  const BodyShape& shape_;
  double sure_;
};

}  // namespace

std::array<Limb, 2> shaped_limbs(const BodyShape& shape, const LimbPair& pair, bool arms, double sure) {
  return LimbShaper(shape, sure).find(pair, arms);
}

}  // namespace fragmotion
