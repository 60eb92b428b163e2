// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "skeleton/body_tree.hpp"

namespace fragmotion {
namespace {

// Lengths are shares of the longest way from a leaf to another one.
constexpr double kLimb = 0.2;       // a limb at least
constexpr double kAlike = 0.05;     // of a limb's length: bones of a pair differ by less
constexpr double kHead = 0.04;      // neck and head at least
constexpr double kStub = 1e-3;      // a bone that ends where it begins: a marker
constexpr double kPelvis = 0.02;    // between the hips and a pelvis at most
constexpr double kSame = 1.05;      // times as long: no longer
constexpr double kStandsOut = 1.5;  // times as long as the neck
constexpr double kDoubtful = 0.15;  // of the head's length, that a bone beyond it has: which is the head?
constexpr double kStiff = 0.05;     // rad that a joint bends by at least in a motion, if it is one
constexpr double kSplit = 0.8;      // a third bone of a limb that is as long as that of the shorter two: no telling
constexpr double kUpright = 0.5;    // of a leg's length that feet are under the hips
constexpr double kSure = 1.5;       // votes more for one way to take the pairs than for the other
constexpr double kSided = 0.5;      // mean cosine to the left
constexpr double kForward = 0.3;    // of a foot's length that it points level
constexpr double kTelling = 0.05;   // of the poses that tell the sides at least
constexpr int kMostPoses = 200;

using Chain = std::vector<int>;

/// Two limbs that are alike, and the bone that they hang on.
struct Pair {
  int node = -1;
  std::array<Chain, 2> chains;
  double length = 0;
};

class ShapeFinder {
 public:
  ShapeFinder(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion)
      : skeleton_(skeleton), tree_(tree) {
    rest_pose(skeleton, rest_, rotations_);
    observe(motion);
    grow();
  }

  Body find() {
    const std::vector<Pair> pairs = find_pairs();
    if (pairs.size() < 2) return {};
    std::optional<std::pair<Pair, Pair>> body = legs_and_arms(pairs);
    if (!body) return {};
    auto& [legs, arms] = *body;
    Body result;
    result.hips = carrier(legs.node, arms.node);
    result.hips_confidence = sure_;
    result.chest = arms.node;
    find_head(legs, arms, result);
    result.legs = limbs(legs, 0);
    result.arms = limbs(arms, 1);
    if (!tell_sides(result)) result.legs = result.arms = {};
    return result;
  }

 private:
  void observe(const ObservedPoses* motion) {
    if (!motion || motion->poses < 1) {
      poses_.push_back(rest_.data());
      return;
    }
    moves_ = true;
    const int step = std::max(1, motion->poses / kMostPoses);
    for (int p = 0; p < motion->poses; p += step) {
      poses_.push_back(&motion->heads[static_cast<std::size_t>(p) * skeleton_.size()]);
    }
  }

  double length(int bone) const { return (rest_[bone] - rest_[parents_[bone]]).norm(); }

  // How the body's bones hang on each other, and how far the farthest below is.
  void grow() {
    const int bones = skeleton_.size();
    parents_.assign(bones, -1);
    children_.assign(bones, {});
    reach_.assign(bones, 0);
    for (int b = 0; b < bones; ++b) {
      int above = tree_.parents[b];
      while (above >= 0 && !taken(above)) above = tree_.parents[above];
      if (!taken(b)) continue;
      parents_[b] = above;
      if (above >= 0) children_[above].push_back(b);
    }
    for (int b = bones - 1; b >= 0; --b) {
      if (parents_[b] >= 0) reach_[parents_[b]] = std::max(reach_[parents_[b]], length(b) + reach_[b]);
    }
    for (int b = 0; b < bones; ++b) size_ = std::max(size_, across_at(b));
  }

  // The two longest branches of a bone together. One alone may be as long as the way from the origin to a body.
  double across_at(int bone) const {
    double first = 0, second = 0;
    for (const int child : children_[bone]) {
      const double branch = length(child) + reach_[child];
      second = std::max(second, std::min(first, branch));
      first = std::max(first, branch);
    }
    return second > 0 ? first + second : 0;
  }

  bool taken(int bone) const { return tree_.in_body[bone] && !tree_.twist[bone]; }

  // The bones that lead farthest.
  Chain chain_from(int bone) const {
    Chain chain{bone};
    while (!children_[chain.back()].empty()) {
      const std::vector<int>& next = children_[chain.back()];
      chain.push_back(*std::max_element(next.begin(), next.end(),
                                        [&](int a, int b) { return length(a) + reach_[a] < length(b) + reach_[b]; }));
    }
    return chain;
  }

  bool alike(const Chain& a, const Chain& b, double limb) const {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (std::abs(length(a[i]) - length(b[i])) > kAlike * limb) return false;
    }
    return true;
  }

  std::vector<Pair> find_pairs() const {
    std::vector<Pair> pairs;
    for (int node = 0; node < skeleton_.size(); ++node) {
      std::vector<Chain> limbs;
      for (const int child : children_[node]) {
        if (length(child) + reach_[child] >= kLimb * size_) limbs.push_back(chain_from(child));
      }
      std::optional<Pair> pair;
      int found = 0;
      for (std::size_t i = 0; i < limbs.size(); ++i) {
        for (std::size_t j = i + 1; j < limbs.size(); ++j) {
          const double limb = length(limbs[i][0]) + reach_[limbs[i][0]];
          if (!alike(limbs[i], limbs[j], limb)) continue;
          pair = Pair{node, {limbs[i], limbs[j]}, limb};
          ++found;
        }
      }
      if (found == 1) pairs.push_back(*pair);
    }
    return pairs;
  }

  int leaves(int bone) const {
    if (children_[bone].empty()) return 1;
    int count = 0;
    for (const int child : children_[bone]) count += leaves(child);
    return count;
  }

  bool is_below(int bone, int ancestor) const {
    while (bone > ancestor) bone = parents_[bone];
    return bone == ancestor;
  }

  // What carries both: a pelvis beside the spine carries legs alone. -1 where neither pelvis nor carrier is the hips.
  int carrier(int legs, int arms) const {
    if (is_below(legs, arms) || is_below(arms, legs)) return legs;
    int both = legs;
    while (both >= 0 && !is_below(arms, both)) both = parents_[both];
    return both >= 0 && (rest_[both] - rest_[legs]).norm() < kPelvis * size_ ? both : -1;
  }

  // The longest chain at a node that is neither of the pair's nor leads to the other pair.
  Chain middle(const Pair& pair, int other) const {
    Chain longest;
    double most = kHead * size_;
    for (const int child : children_[pair.node]) {
      if (child == pair.chains[0][0] || child == pair.chains[1][0] || is_below(other, child)) continue;
      const double far = length(child) + reach_[child];
      if (far > most) most = far, longest = chain_from(child);
    }
    return longest;
  }

  // How far the ends of a pair's limbs are under their node, on the mean over all poses, in lengths of the limbs.
  double under(const Pair& pair) const {
    double depth = 0;
    for (const Vector3* heads : poses_) {
      for (const Chain& chain : pair.chains) depth += heads[pair.node].z() - heads[chain.back()].z();
    }
    return depth / (2 * static_cast<double>(poses_.size()) * pair.length);
  }

  double two_longest(const Pair& pair) const {
    double first = 0, second = 0;
    for (std::size_t i = 1; i < pair.chains[0].size(); ++i) {
      const double bone = length(pair.chains[0][i]);
      if (bone > first)
        second = first, first = bone;
      else
        second = std::max(second, bone);
    }
    return first + second;
  }

  // For `a` being the legs.
  double votes(const Pair& a, const Pair& b) const {
    const auto more = [](double x, double y, double weight) { return x > y ? weight : x < y ? -weight : 0; };
    double votes = more(two_longest(a), 1.05 * two_longest(b), 1);
    votes += more(leaves(b.chains[0][0]), leaves(a.chains[0][0]), 0.5);
    votes += !middle(b, a.node).empty() - !middle(a, b.node).empty();
    votes += is_below(b.node, a.node) ? 0.5 : -0.5;
    const double feet = lowest(a) - lowest(b);
    if (under(a) > kUpright || under(b) > kUpright) votes += feet < 0 ? 1.5 : -1.5;
    return votes;
  }

  double lowest(const Pair& pair) const {
    double height = 0;
    for (const Vector3* heads : poses_)
      height += std::min(heads[pair.chains[0].back()].z(), heads[pair.chains[1].back()].z());
    return height / static_cast<double>(poses_.size());
  }

  std::optional<std::pair<Pair, Pair>> legs_and_arms(std::vector<Pair> pairs) {
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.length > b.length; });
    const Pair &a = pairs[0], &b = pairs[1];
    const double told = votes(a, b);
    if (std::abs(told) < kSure) return std::nullopt;
    sure_ = std::min(0.9, 0.6 + 0.1 * std::abs(told));
    return told > 0 ? std::pair{a, b} : std::pair{b, a};
  }

  // Which bone of a neck and what is beyond is the head: the longest, for faces hang on it, and its end may be marked
  // by a last bone that an importer made as long. -1 where another one beyond it may be the head.
  int longest_of(const Chain& chain) const {
    const auto length_of = [&](int i) { return skeleton_.tips[chain[i]].norm(); };
    const int last = static_cast<int>(chain.size()) - 1;
    int head = 0;
    for (int i = 1; i <= last; ++i) {
      if (length_of(i) > kSame * length_of(head)) head = i;
    }
    for (int i = head + 1; i <= last; ++i) {
      const bool is_mark = i == last && i == head + 1 && head > 0 &&
                           length_of(head) > kStandsOut * length_of(head - 1) && length_of(i) > length_of(head) / kSame;
      if (!is_mark && length_of(i) > kDoubtful * length_of(head)) return -1;
    }
    return head;
  }

  void find_head(const Pair& legs, const Pair& arms, Body& body) const {
    Chain chain = middle(arms, legs.node);
    for (std::size_t i = 1; i < chain.size(); ++i) {
      if (length(chain[i]) < kStub * size_) chain.resize(i);  // a face, in the head's place
    }
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (children_[chain[i]].size() > 1) chain.resize(i + 1);  // what carries a face
    }
    const int head = chain.empty() ? -1 : longest_of(chain);
    if (head < 0) return;
    body.head = chain[head];
    body.head_confidence = head > 0 ? sure_ - 0.1 : 0.5;
  }

  // How much a joint of a chain bends in the motion, rad.
  double bends(const Chain& chain, std::size_t i) const {
    double least = kPi, most = 0;
    for (const Vector3* heads : poses_) {
      const Vector3 before = heads[chain[i]] - heads[chain[i - 1]], after = heads[chain[i + 1]] - heads[chain[i]];
      const double angle = std::atan2(before.cross(after).norm(), before.dot(after));
      least = std::min(least, angle);
      most = std::max(most, angle);
    }
    return most - least;
  }

  // Without the bones that are only parts of the one before.
  Chain joints(const Chain& chain) const {
    if (!moves_ || chain.size() < 4) return chain;
    Chain joints{chain[0]};
    for (std::size_t i = 1; i < chain.size(); ++i) {
      if (i + 1 == chain.size() || bends(chain, i) > kStiff) joints.push_back(chain[i]);
    }
    return joints;
  }

  std::array<Limb, 2> limbs(const Pair& pair, bool arm) const {
    return {limb(joints(pair.chains[0]), arm), limb(joints(pair.chains[1]), arm)};
  }

  // The two longest bones that follow each other are the upper and the lower one.
  Limb limb(const Chain& chain, bool arm) const {
    const int bones = static_cast<int>(chain.size());
    const auto bone = [&](int i) {
      return i + 1 < bones && i >= 0 ? (rest_[chain[i + 1]] - rest_[chain[i]]).norm() : 0;
    };
    int upper = -1;
    double most = 0;
    for (int i = 0; i + 2 < bones; ++i) {
      const double shorter = std::min(bone(i), bone(i + 1));
      if (shorter > most) most = shorter, upper = i;
    }
    if (upper < 0 || bone(upper - 1) > kSplit * most || bone(upper + 2) > kSplit * most) return {};
    Limb limb;
    const auto set = [&](int part, int i, double confidence) {
      limb.bones[part] = chain[i];
      limb.confidence[part] = confidence;
    };
    if (arm && upper > 0) set(Limb::kFirst, upper - 1, sure_ - 0.1);
    set(Limb::kUpper, upper, sure_);
    set(Limb::kLower, upper + 1, sure_);
    set(Limb::kEnd, upper + 2, sure_);
    const bool toe =
        !arm && upper + 3 < bones && (upper + 4 < bones || skeleton_.tips[chain[upper + 3]].norm() > kStub * size_);
    if (toe) set(Limb::kTip, upper + 3, sure_ - 0.15);
    return limb;
  }

  // Where a foot's end is: the next bone's head, at rest also its tip.
  std::optional<Vector3> pointing(const Limb& leg, const Vector3* heads) const {
    const int foot = leg.bones[Limb::kEnd];
    int next = leg.bones[Limb::kTip];
    if (next < 0 && !children_[foot].empty()) next = children_[foot][0];
    if (next >= 0) return heads[next] - heads[foot];
    if (heads != rest_.data()) return std::nullopt;
    return rotations_[foot] * skeleton_.tips[foot];
  }

  // To the body's left in a pose, by where the feet point; zero where they do not or the body does not stand.
  Vector3 left_in(const Body& body, const Vector3* heads) const {
    Vector3 forward = Vector3::Zero();
    double length = 0;
    for (const Limb& leg : body.legs) {
      const Vector3 down = heads[leg.bones[Limb::kUpper]] - heads[leg.bones[Limb::kEnd]];
      const std::optional<Vector3> foot = pointing(leg, heads);
      if (!foot || down.z() < kUpright * down.norm()) return Vector3::Zero();
      forward += *foot;
      length += foot->norm();
    }
    forward.z() = 0;
    if (forward.norm() < kForward * length || length < kStub * size_) return Vector3::Zero();
    return Vector3::UnitZ().cross(forward).normalized();
  }

  static Vector3 across(const std::array<Limb, 2>& limbs, const Vector3* heads) {
    return heads[limbs[0].bones[Limb::kUpper]] - heads[limbs[1].bones[Limb::kUpper]];
  }

  bool tell_sides(Body& body) const {
    if (!body.legs[0].whole() || !body.legs[1].whole()) return false;
    double legs = 0, arms = 0;
    int telling = 0;  // poses; a runner's feet hardly point forward in most
    const bool has_arms = body.arms[0].whole() && body.arms[1].whole();
    for (const Vector3* heads : poses_) {
      const Vector3 left = left_in(body, heads);
      if (left.isZero()) continue;
      ++telling;
      legs += across(body.legs, heads).normalized().dot(left);
      if (has_arms) arms += across(body.arms, heads).normalized().dot(left);
    }
    if (telling < kTelling * static_cast<double>(poses_.size())) return false;
    legs /= telling;
    arms /= telling;
    if (std::abs(legs) < kSided) return false;
    if (legs < 0) std::swap(body.legs[0], body.legs[1]);
    if (arms < 0) std::swap(body.arms[0], body.arms[1]);
    if (std::abs(arms) < kSided) body.arms = {};
    return true;
  }

  const Skeleton& skeleton_;
  const BodyTree& tree_;
  std::vector<Vector3> rest_;
  std::vector<Quaternion> rotations_;
  std::vector<const Vector3*> poses_;
  bool moves_ = false;
  std::vector<int> parents_;
  std::vector<std::vector<int>> children_;
  std::vector<double> reach_;
  double size_ = 0, sure_ = 0;
};

}  // namespace

Body shaped_body(const Skeleton& skeleton, const BodyTree& tree, const ObservedPoses* motion) {
  return ShapeFinder(skeleton, tree, motion).find();
}

}  // namespace fragmotion
