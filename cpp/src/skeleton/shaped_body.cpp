// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "skeleton/body_sides.hpp"
#include "skeleton/body_tree.hpp"

namespace fragmotion {
namespace {

// Lengths are shares of the longest way from a leaf to another one.
constexpr double kLimb = 0.2;       // a limb at least
constexpr double kLongest = 0.6;    // of the way along its bones, from a limb's beginning to its end
constexpr double kAlike = 0.05;     // of a limb's length: bones of a pair differ by less
constexpr double kHand = 0.3;       // of a limb's length that hands and feet reach at most
constexpr double kBroad = 0.25;     // of the trunk's length that shoulders are apart at least
constexpr double kHead = 0.03;      // neck and head at least
constexpr double kStub = 1e-3;      // a bone that ends where it begins: a marker
constexpr double kPelvis = 0.02;    // between the hips and a pelvis at most
constexpr double kSame = 1.05;      // times as long: no longer
constexpr double kStandsOut = 1.5;  // times as long as the neck
constexpr double kDoubtful = 0.15;  // of the head's length, that a bone beyond it has: which is the head?
constexpr double kStiff = 0.05;     // rad that a joint bends by at least in a motion, if it is one
constexpr double kSplit = 0.8;      // a third bone of a limb that is as long as that of the shorter two: no telling
constexpr double kPart = 0.75;      // times as long at least a bone becomes by a part
constexpr double kHeadAbove = 0.16, kHeadUnder = 0.5;  // of the trunk's length that a head begins above the shoulders
constexpr double kCopied = 1e-3;                       // of a bone's length that a copy of it differs by
constexpr double kNarrow = 0.25;    // of the way from arm to arm over the collars, that collars are apart at most
constexpr double kBroadest = 0.36;  // the same, where they also lead apart and the arms do less
constexpr double kApart = 0.5, kLessApart = 0.3;  // cosines
constexpr double kShortArm = 0.75;                // of an upper arm's length, that a lower arm has at least
constexpr double kLonger = 1.3;  // times as long as a collar an upper arm is, where only the rest pose tells
constexpr double kSteep = 0.85, kSlanting = 0.8;  // of a bone's length that it leads down
constexpr double kSure = 1.5;                     // votes more for one way to take the pairs than for the other
constexpr int kMostPoses = 200;
constexpr int kFingers = 3;             // at least on a hand
constexpr std::size_t kLimbJoints = 3;  // of a limb at least: where its upper and lower bone and its end begin

constexpr double kNoTrunk = 1e-12;

using Chain = std::vector<int>;
using Poses = std::vector<const Vector3*>;
using Joints = std::array<int, 3>;  // of a limb's chain: where its upper and lower bone and its end begin

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
    result.legs = limbs(legs, false);
    result.arms = limbs(arms, true);
    if (!result.legs[0].whole()) return {};
    find_head(legs, arms, result);
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

  // As far as the hands: which finger reaches farthest may differ.
  bool alike(const Chain& a, const Chain& b, double limb) const {
    const auto is_hand = [&](const Chain& chain, std::size_t i) {
      return i > 0 && reach_[chain[i - 1]] < kHand * limb;
    };
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (is_hand(a, i) && is_hand(b, i)) return true;
      if (i >= a.size() || i >= b.size() || std::abs(length(a[i]) - length(b[i])) > kAlike * limb) return false;
    }
    return true;
  }

  // Whether it has the joints of a limb, and is ever stretched: what controls a foot is folded up.
  bool may_be_limb(const Chain& chain) const {
    if (chain.size() < kLimbJoints) return false;
    const double farthest = kLongest * reach_[chain.front()];
    const auto is_stretched = [&](const Vector3* heads) {
      return (heads[chain.back()] - heads[chain.front()]).norm() > farthest;
    };
    return is_stretched(rest_.data()) || std::any_of(poses_.begin(), poses_.end(), is_stretched);
  }

  std::vector<Pair> find_pairs() const {
    std::vector<Pair> pairs;
    for (int node = 0; node < skeleton_.size(); ++node) {
      std::vector<Chain> limbs;
      for (const int child : children_[node]) {
        if (length(child) + reach_[child] < kLimb * size_) continue;
        if (Chain chain = chain_from(child); may_be_limb(chain)) limbs.push_back(std::move(chain));
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
    if (under(a) > kUpright || under(b) > kUpright || stands(a.node, b.node)) votes += feet < 0 ? 1.5 : -1.5;
    return votes;
  }

  // Whether the way between two bones is steep on the mean over all poses.
  bool stands(int a, int b) const { return a != b && std::abs(descent(poses_, a, b)) > kUpright; }

  // How far down it is from one bone to another on the mean over poses, in lengths of the way.
  static double descent(const Poses& poses, int from, int to) {
    double down = 0;
    for (const Vector3* heads : poses) {
      const Vector3 way = heads[to] - heads[from];
      down -= way.z() / std::max(way.norm(), kNoTrunk);
    }
    return down / static_cast<double>(poses.size());
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

  Vector3 between(const std::array<Limb, 2>& limbs, const Vector3* heads) const {
    return (heads[limbs[0].bones[Limb::kUpper]] + heads[limbs[1].bones[Limb::kUpper]]) / 2;
  }

  // How far a bone begins above the shoulders, in lengths of the trunk: the mean over all poses but those that are none
  // of a body, as rest poses of files may be; 0 where there is no other.
  double above_shoulders(const Body& body, const Poses& poses, int bone) const {
    double above = 0;
    int told = 0;
    for (const Vector3* heads : poses) {
      const Vector3 shoulders = between(body.arms, heads), trunk = shoulders - between(body.legs, heads);
      if (across(body.arms, heads).norm() < kBroad * trunk.norm()) continue;
      above += (heads[bone] - shoulders).dot(trunk) / std::max(trunk.squaredNorm(), kNoTrunk);
      ++told;
    }
    return above / std::max(told, 1);
  }

  // An importer makes a last bone as long as the one before: it may be the head or mark the head's end.
  bool may_be_mark(const Chain& chain, std::size_t i) const {
    const double length = skeleton_.tips[chain[i]].norm(), before = i > 0 ? skeleton_.tips[chain[i - 1]].norm() : 0;
    return i > 1 && i + 1 == chain.size() && std::abs(length - before) < kCopied * length;
  }

  // The bones of a neck and beyond that begin where a head does: at rest and in the motion, where both tell.
  Chain possible_heads(const Body& body, const Chain& chain) const {
    const Chain rest = possible_heads(body, {rest_.data()}, chain);
    const Chain motion = possible_heads(body, poses_, chain);
    if (rest.empty() || motion.empty()) return rest.empty() ? motion : rest;
    Chain both;
    std::copy_if(rest.begin(), rest.end(), std::back_inserter(both),
                 [&](int bone) { return std::find(motion.begin(), motion.end(), bone) != motion.end(); });
    return both;
  }

  Chain possible_heads(const Body& body, const Poses& poses, const Chain& chain) const {
    Chain possible;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const double above = above_shoulders(body, poses, chain[i]);
      if (above < kHeadAbove || above > kHeadUnder) continue;
      if (possible.empty() && may_be_mark(chain, i)) possible.push_back(chain[i - 1]);
      possible.push_back(chain[i]);
    }
    return possible;
  }

  void find_head(const Pair& legs, const Pair& arms, Body& body) const {
    const auto whole = [](const std::array<Limb, 2>& limbs) { return limbs[0].whole() && limbs[1].whole(); };
    if (!whole(body.arms) || !whole(body.legs)) return;
    Chain chain = middle(arms, legs.node);
    for (std::size_t i = 1; i < chain.size(); ++i) {
      if (length(chain[i]) < kStub * size_) chain.resize(i);  // a face, in the head's place
    }
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (children_[chain[i]].size() > 1) chain.resize(i + 1);  // what carries a face
    }
    const Chain possible = possible_heads(body, chain);
    const int head = possible.empty() ? -1 : longest_of(possible);
    if (head < 0) return;
    body.head = possible[head];
    body.head_confidence = body.head != chain[0] ? sure_ - 0.1 : 0.5;
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

  // Which bones of limbs may be only parts of those before: in the motion they hardly bend against them.
  std::vector<bool> parts(const Pair& pair) const {
    const auto& [left, right] = pair.chains;
    std::vector<bool> parts(std::min(left.size(), right.size()), false);
    for (std::size_t i = 1; moves_ && i + 1 < parts.size(); ++i) {
      parts[i] = bends(left, i) < kStiff && bends(right, i) < kStiff;
    }
    return parts;
  }

  std::array<Limb, 2> limbs(const Pair& pair, bool arm) const {
    const bool collared = arm && begins_with_collars(pair);
    const Joints found = joints(pair.chains[0], parts(pair), collared ? 1 : 0);
    return {limb(pair.chains[0], found, arm, collared), limb(pair.chains[1], found, arm, collared)};
  }

  // Collar bones begin beside each other and lead apart; upper arms begin at both sides, and hang.
  bool begins_with_collars(const Pair& pair) const {
    const auto& [left, right] = pair.chains;
    const double between = (rest_[left[0]] - rest_[right[0]]).norm();
    const double across = between + length(left[1]) + length(right[1]);
    if (between < kNarrow * across) return true;
    if (between > kBroadest * across || (!moves_ && length(left[2]) < kLonger * length(left[1]))) return false;
    const double first = same_way(pair, 0);
    return first < -kApart && same_way(pair, 1) > first + kLessApart;
  }

  // The cosine between the left and the right bone of a pair, the mean over all poses.
  double same_way(const Pair& pair, std::size_t i) const {
    const auto& [left, right] = pair.chains;
    double cosines = 0;
    for (const Vector3* heads : poses_) {
      const Vector3 a = heads[left[i + 1]] - heads[left[i]], b = heads[right[i + 1]] - heads[right[i]];
      cosines += a.normalized().dot(b.normalized());
    }
    return cosines / static_cast<double>(poses_.size());
  }

  double way(const Chain& chain, int from, int to) const { return (rest_[chain[to]] - rest_[chain[from]]).norm(); }

  // Whether a bone carries fingers or toes.
  bool branches(int bone) const {
    const auto far = [&](int child) { return length(child) + reach_[child]; };
    const std::vector<int>& next = children_[bone];
    return std::count_if(next.begin(), next.end(), [&](int child) { return far(child) > reach_[bone] / 2; }) >=
           kFingers;
  }

  // Where the two longest bones that follow each other begin and end. Such a bone may have parts; but a wrist that is
  // held still is no part of a lower arm, and adds less to its length than a part does.
  Joints joints(const Chain& chain, const std::vector<bool>& part, int first) const {
    const int bones = static_cast<int>(part.size());
    Joints best{-1, -1, -1};
    double most = 0;
    for (int upper = first; upper + 2 < bones; ++upper) {
      for (int lower = upper + 1; lower + 1 < bones && !part[upper]; ++lower) {
        if (branches(chain[lower])) break;
        for (int end = lower + 1; end < bones && !part[lower]; ++end) {
          const int skipped = end - upper - 2;
          const double shorter = std::min(way(chain, upper, lower), way(chain, lower, end)) * std::pow(kPart, skipped);
          if (shorter > most) most = shorter, best = {upper, lower, end};
          if (!part[end] || branches(chain[end])) break;
        }
        if (!part[lower]) break;
      }
    }
    return best;
  }

  // Whether a bone leads ahead that a steep one leads down to.
  static bool is_foot(const Poses& poses, const Chain& chain, int shin, int foot) {
    return descent(poses, chain[shin], chain[foot]) > kSteep &&
           descent(poses, chain[foot], chain[foot + 1]) < kSlanting;
  }

  Limb limb(const Chain& chain, const Joints& joints, bool arm, bool collared) const {
    const auto [upper, lower, end] = joints;
    if (upper < 0) return {};
    if (arm && upper == 0 && lower > 1) return {};  // a shoulder against which the arm is held still looks like a part
    const int bones = static_cast<int>(chain.size());
    const double most = kSplit * std::min(way(chain, upper, lower), way(chain, lower, end));
    const bool hand = branches(chain[end]);  // whose lower arm and elbow are told, so what is before is a shoulder
    const bool in_parts = arm && !moves_ && !hand && way(chain, lower, end) < kShortArm * way(chain, upper, lower);
    if (in_parts) return {};  // or so it may be: motion would tell
    const bool shoulder = (hand && moves_) || (collared && upper == 1);
    const bool foot =
        !arm && end + 1 < bones && (is_foot({rest_.data()}, chain, lower, end) || is_foot(poses_, chain, lower, end));
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
      return other != toe && length(other) + reach_[other] > kSplit * (length(toe) + reach_[toe]);
    };
    const std::vector<int>& beside = children_[chain[foot]];
    if (std::any_of(beside.begin(), beside.end(), is_as_long)) return false;
    return foot + 2 < bones || skeleton_.tips[toe].norm() > kStub * size_;
  }

  // Where a foot's end is: the next bone's head, at rest also its tip; zero where neither is known.
  Vector3 pointing(const Limb& leg, const Vector3* heads) const {
    const int foot = leg.bones[Limb::kEnd];
    int next = leg.bones[Limb::kTip];
    if (next < 0 && !children_[foot].empty()) next = chain_from(foot)[1];
    if (next >= 0) return heads[next] - heads[foot];
    return heads == rest_.data() ? Vector3{rotations_[foot] * skeleton_.tips[foot]} : Vector3::Zero();
  }

  bool tell_sides(Body& body) const {
    if (!body.legs[0].whole() || !body.legs[1].whole()) return false;
    std::vector<PosedFeet> poses;
    for (const Vector3* heads : poses_) {
      poses.push_back({heads, {pointing(body.legs[0], heads), pointing(body.legs[1], heads)}});
    }
    return put_left_first(poses, body);
  }

  const Skeleton& skeleton_;
  const BodyTree& tree_;
  std::vector<Vector3> rest_;
  std::vector<Quaternion> rotations_;
  Poses poses_;
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
