// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "skeleton/body_tree.hpp"

namespace fragmotion {
namespace {

constexpr int kReach = 24;  // bones above an end that are looked at
constexpr double kSilent = 0.5, kMissing = 1, kSkipped = 0.5;
constexpr double kJointNamed = 1.5;  // where elbows and knees are named, wrists and ankles are the joints meant
constexpr double kClaims = 2.4, kCoherent = 0.7;
constexpr double kDeeper = 1e-3;  // of equals the bone nearest to the trunk

double confidence_of(double score) { return score >= 2.4 ? 0.95 : score >= 1.5 ? 0.9 : score > 0.3 ? 0.8 : 0.6; }

/// Finds a limb of one side: the chain of bones below each other that the names fit best. Of limbs named alike it is
/// the one whose hand or foot carries skin: MMD's models hang theirs on copies of the bones that their motions turn.
class LimbFinder {
 public:
  LimbFinder(const BodyTree& tree, int side, const LimbRoles& roles)
      : tree_(tree), side_(side), roles_(roles), joint_named_(names_joints()) {}

  Limb find() {
    for (int end = 0; end < tree_.size(); ++end) {
      const double score = fits(end, roles_[Limb::kEnd]);
      if (score > 0) try_end(end, score);
      try_without_end(end);
    }
    for (int bone = 0; bone < tree_.size() && best_.empty(); ++bone) try_alone(bone);
    drop_claimed_by_others(Limb::kUpper, roles_[Limb::kUpper]);
    drop_claimed_by_others(Limb::kLower, roles_[Limb::kLower]);
    find_first();
    find_tip();
    return best_;
  }

 private:
  // Of this limb a bone may be only what carries nothing of the other side.
  bool may_be(int bone) const { return tree_.in_body[bone] && !tree_.twist[bone] && !tree_.holds[bone][1 - side_]; }

  double fits(int bone, Role role) const {
    if (!may_be(bone)) return kContradicts;
    const double score = tree_.says(bone, role);
    const bool sided = tree_.names[bone].side != Side::kNone;
    if (score > 0 && !sided) return kContradicts;
    const bool is_joint = has_any_word(tree_.names[bone], {"wrist", "ankle"});
    return score > 0 && joint_named_ && is_joint && role == roles_[Limb::kEnd] ? score + kJointNamed : score;
  }

  bool names_joints() const {
    return std::any_of(tree_.names.begin(), tree_.names.end(), [&](const BoneName& name) {
      return name.side != Side::kNone && has_any_word(name, {"elbow", "knee"});
    });
  }

  /// The bones above that may be a part of the limb, from below.
  std::vector<int> above(int bone) const {
    std::vector<int> bones;
    for (int b = tree_.parents[bone]; b >= 0 && bones.size() < kReach && !tree_.holds[b][1 - side_];
         b = tree_.parents[b]) {
      if (may_be(b)) bones.push_back(b);
    }
    return bones;
  }

  /// What it costs to leave out the bones between: a second part of the upper bone costs nothing.
  double skipped(int upper, int lower) const {
    double cost = 0;
    for (int b = tree_.parents[lower]; b >= 0 && b != upper; b = tree_.parents[b]) {
      const bool is_part = tree_.names[b].words == tree_.names[upper].words;
      if (may_be(b) && !is_part) cost += kSkipped;
    }
    return cost;
  }

  static double cost_of_silence(double score) { return score == 0 ? -kSilent : score; }

  void try_end(int end, double end_score) {
    take(end_score - 2 * kMissing, {-1, -1, -1, end, -1}, {0, 0, 0, end_score, 0});
    const std::vector<int> bones = above(end);
    for (std::size_t i = 0; i < bones.size(); ++i) {
      const int lower = bones[i];
      const double upper_alone = fits(lower, roles_[Limb::kUpper]);
      const double cost = skipped(lower, end);
      if (upper_alone >= 0 && cost <= kSkipped) {
        take(end_score + cost_of_silence(upper_alone) - kMissing - cost, {-1, lower, -1, end, -1},
             {0, upper_alone, 0, end_score, 0});
      }
      const double lower_score = fits(lower, roles_[Limb::kLower]);
      if (lower_score < 0) continue;
      for (std::size_t j = i + 1; j < bones.size(); ++j) {
        const double upper_score = fits(bones[j], roles_[Limb::kUpper]);
        if (upper_score < 0) continue;
        const double score =
            end_score + cost_of_silence(lower_score) + cost_of_silence(upper_score) - cost - skipped(bones[j], lower);
        take(score, {-1, bones[j], lower, end, -1}, {0, upper_score, lower_score, end_score, 0});
      }
    }
  }

  /// Hands and feet that controls carry hang elsewhere.
  void try_without_end(int lower) {
    const double lower_score = fits(lower, roles_[Limb::kLower]);
    if (lower_score <= 0) return;
    for (const int upper : above(lower)) {
      const double upper_score = fits(upper, roles_[Limb::kUpper]);
      if (upper_score <= 0) continue;
      take(lower_score + upper_score - kMissing - skipped(upper, lower), {-1, upper, lower, -1, -1},
           {0, upper_score, lower_score, 0, 0});
    }
  }

  /// A limb of a single bone.
  void try_alone(int upper) {
    const double score = fits(upper, roles_[Limb::kUpper]);
    for (int b = upper + 1; b < tree_.size(); ++b) {
      if (tree_.in_body[b] && tree_.parents[b] == upper) return;
    }
    if (score > 0) take(score - 2 * kMissing, {-1, upper, -1, -1, -1}, {0, score, 0, 0, 0});
  }

  void take(double score, const std::array<int, 5>& bones, const std::array<double, 5>& scores) {
    for (const int bone : bones) {
      if (bone >= 0) score -= kDeeper * tree_.depth[bone];
    }
    if (bones[Limb::kEnd] >= 0 && tree_.bare[bones[Limb::kEnd]]) score -= kMissing;
    if (score <= best_score_) return;
    best_score_ = score;
    best_.bones = bones;
    for (std::size_t i = 0; i < bones.size(); ++i) best_.confidence[i] = bones[i] < 0 ? 0 : confidence_of(scores[i]);
  }

  /// Where another bone's name says a role clearly, but it hangs elsewhere than on it, a bone that hardly says it has
  /// it not.
  void drop_claimed_by_others(int part, Role role) {
    if (best_.bones[part] < 0 || fits(best_.bones[part], role) >= kClaims) return;
    for (int b = 0; b < tree_.size(); ++b) {
      const bool here = tree_.names[b].side == (side_ == 0 ? Side::kLeft : Side::kRight);
      const bool hangs_on_it = tree_.parents[b] == best_.bones[part];
      if (here && !hangs_on_it && tree_.in_body[b] && !tree_.twist[b] && tree_.says(b, role) >= kClaims) {
        best_.bones[part] = -1;
        return;
      }
    }
  }

  /// The bone between the trunk and the arm, if its name does not say that it is something else.
  void find_first() {
    if (roles_[Limb::kFirst] == roles_[Limb::kUpper] || best_.bones[Limb::kUpper] < 0) return;
    double most = -1;
    for (const int b : above(best_.bones[Limb::kUpper])) {
      const double score = fits(b, roles_[Limb::kFirst]);
      if (score <= most) continue;
      most = score;
      best_.bones[Limb::kFirst] = b;
      best_.confidence[Limb::kFirst] = confidence_of(score);
    }
  }

  void find_tip() {
    if (roles_[Limb::kTip] == Role::kFinger || best_.bones[Limb::kEnd] < 0) return;
    double most = 0;
    for (int b = best_.bones[Limb::kEnd] + 1; b < tree_.size(); ++b) {
      const double score = fits(b, roles_[Limb::kTip]);
      if (score <= most || !tree_.is_below(b, best_.bones[Limb::kEnd])) continue;
      most = score;
      best_.bones[Limb::kTip] = b;
      best_.confidence[Limb::kTip] = confidence_of(score);
    }
    begin_with_ball();
  }

  /// Below an ankle a foot is what begins at the ball, and its toes go on from there.
  void begin_with_ball() {
    if (best_.bones[Limb::kTip] < 0) return;
    const int above = tree_.parents[best_.bones[Limb::kTip]];
    if (above != best_.bones[Limb::kEnd] && fits(above, roles_[Limb::kTip]) > 0) best_.bones[Limb::kTip] = above;
  }

  const BodyTree& tree_;
  int side_;
  LimbRoles roles_;
  bool joint_named_;
  Limb best_;
  double best_score_ = -std::numeric_limits<double>::infinity();
};

int best_unsided(const BodyTree& tree, Role role, double& score) {
  int best = -1;
  score = 0;
  for (int b = 0; b < tree.size(); ++b) {
    if (!tree.in_body[b] || tree.twist[b] || tree.names[b].side != Side::kNone) continue;
    const double said = tree.says(b, role);
    if (said > score) best = b, score = said;
  }
  return best;
}

/// A bone of each leg and the topmost one told of the trunk hang on it.
int carrier_of_legs(const BodyTree& tree, const BodyJoints& body) {
  int carrier = -1;
  for (const Limb& leg : body.legs) {
    const int top = leg.bones[Limb::kUpper] >= 0 ? leg.bones[Limb::kUpper] : leg.bones[Limb::kEnd];
    if (top < 0) return -1;
    carrier = carrier < 0 ? top : tree.common(carrier, top);
  }
  for (const int other : {body.head, body.arms[0].bones[Limb::kEnd]}) {
    if (other >= 0) return tree.common(carrier, other);
  }
  return carrier;
}

void find_hips(const BodyTree& tree, BodyJoints& body) {
  const int carrier = carrier_of_legs(tree, body);
  double score = 0;
  const int named = best_unsided(tree, Role::kHips, score);
  // Where both stand in one rig (Daz, Reallusion), the hip is above the pelvis and carries the body.
  if (named >= 0 && score >= 2 && (carrier < 0 || tree.is_below(carrier, named))) {
    body.hips = named;
    body.hips_confidence = confidence_of(score);
  } else if (named >= 0 && score >= 2) {  // told only where a leg hangs on them
    const bool carries = std::any_of(body.legs.begin(), body.legs.end(),
                                     [&](const Limb& leg) { return tree.is_below(leg.bones[Limb::kEnd], named); });
    const bool hangs = carrier >= 0 && tree.parents[named] == carrier;
    if (hangs && (!carries || tree.parents[carrier] >= 0)) {  // beside the legs or the torso they do not move the body
      body.hips = carrier, body.hips_confidence = 0.8;
    } else if (carries) {
      body.hips = named, body.hips_confidence = 0.6;
    }
  } else {
    body.hips = carrier >= 0 ? carrier : named;
    body.hips_confidence = carrier >= 0 ? 0.85 : 0.6;
  }
}

/// Rigify calls the whole column "spine", from the hips to the head ("spine.006").
int end_of_column(const BodyTree& tree, int from) {
  int end = from;
  for (int b = from + 1; from >= 0 && b < tree.size(); ++b) {
    const bool goes_on = tree.in_body[b] && tree.names[b].side == Side::kNone &&
                         tree.names[b].words == tree.names[from].words && tree.says(b, Role::kSpine) > 2;
    if (goes_on && tree.parents[b] == end) end = b;
  }
  return end;
}

void find_head(const BodyTree& tree, BodyJoints& body) {
  double score = 0;
  body.head = best_unsided(tree, Role::kHead, score);
  while (body.head >= 0 && tree.parents[body.head] >= 0 && tree.says(tree.parents[body.head], Role::kHead) >= kClaims)
    body.head = tree.parents[body.head];  // of heads that hang on each other the first
  body.head_confidence = body.head < 0 ? 0 : confidence_of(score);
  if (body.head >= 0) return;
  const int arms = tree.common(body.arms[0].bones[Limb::kEnd], body.arms[1].bones[Limb::kEnd]);
  const int hips = carrier_of_legs(tree, body), from = arms >= 0 ? arms : hips;
  const int end = end_of_column(tree, from);
  if (end == from) return;
  body.head = end;
  body.head_confidence = 0.85;
}

/// The share of the limbs' roles told by some bone's name whose bones fit into a limb: few where names were mixed up.
double coherence(const BodyTree& tree, const BodyJoints& body) {
  int claimed = 0, kept = 0;
  const auto count = [&](int side, const Limb& limb, int part, Role role) {
    const auto claims = [&](int b) {
      const bool here = tree.in_body[b] && !tree.twist[b] && tree.names[b].side != Side::kNone;
      return here && (tree.names[b].side == Side::kLeft) == (side == 0) && tree.says(b, role) >= kClaims;
    };
    bool claim = false;
    for (int b = 0; b < tree.size() && !claim; ++b) claim = claims(b);
    if (!claim) return;
    ++claimed;
    if (limb.bones[part] >= 0 && tree.says(limb.bones[part], role) > 0) ++kept;
  };
  for (int side = 0; side < 2; ++side) {
    for (const auto& [limb, roles] :
         {std::pair{&body.arms[side], &kArmRoles}, std::pair{&body.legs[side], &kLegRoles}}) {
      for (const int part : {Limb::kUpper, Limb::kLower, Limb::kEnd}) count(side, *limb, part, (*roles)[part]);
    }
  }
  return claimed == 0 ? 1 : static_cast<double>(kept) / claimed;
}

/// A limb that carries the hips.
bool contradicts(const BodyTree& tree, const BodyJoints& body) {
  for (const auto* limbs : {&body.arms, &body.legs}) {
    for (const Limb& limb : *limbs) {
      if (std::any_of(limb.bones.begin(), limb.bones.end(), [&](int b) { return tree.is_below(body.hips, b); })) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::optional<BodyJoints> named_body(const BodyTree& tree) {
  BodyJoints body;
  for (int side = 0; side < 2; ++side) {
    body.arms[side] = LimbFinder(tree, side, kArmRoles).find();
    body.legs[side] = LimbFinder(tree, side, kLegRoles).find();
  }
  find_head(tree, body);
  find_hips(tree, body);
  if (tree.is_below(body.hips, body.head)) body.head = -1;
  if (contradicts(tree, body) || coherence(tree, body) < kCoherent) return std::nullopt;
  return body;
}

}  // namespace fragmotion
