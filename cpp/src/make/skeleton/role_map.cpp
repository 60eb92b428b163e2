// SPDX-License-Identifier: MIT
#include "skeleton/role_map.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "skeleton/body_tree.hpp"
#include "skeleton/named_legs.hpp"

namespace fragmotion {
namespace {

constexpr int kLooks = 200;
constexpr double kTold = 0.5;   // the least confidence of a role
constexpr int kMostJoints = 4;  // of a finger

constexpr LimbRoles kForeLegRoles = {Role::kForeLeg, Role::kForeLeg, Role::kForeLeg, Role::kForeFoot, Role::kForeToe};
constexpr std::string_view kFingerNames[] = {"thumb", "index", "middle", "ring", "pinky"};

double agreed(double confidence) { return 1 - (1 - confidence) / 2; }

/// What names tell, made surer by the shape where it agrees; else what the shape tells.
Limb merged(const Limb& named, const Limb& shaped, const Limb& shaped_other) {
  if (named.empty() || (named.alone() && shaped.whole())) return shaped;
  Limb limb = named;
  if (limb.bones[Limb::kEnd] < 0 && limb.bones[Limb::kLower] == shaped.bones[Limb::kLower]) {
    for (const int part : {Limb::kEnd, Limb::kTip}) {
      limb.bones[part] = shaped.bones[part], limb.confidence[part] = shaped.confidence[part];
    }
  }
  const bool other_side = shaped_other.whole() && named.bones[Limb::kEnd] == shaped_other.bones[Limb::kEnd];
  for (std::size_t i = 0; i < limb.bones.size(); ++i) {
    if (other_side) limb.confidence[i] = std::min(limb.confidence[i], kTold);
    if (limb.bones[i] >= 0 && limb.bones[i] == shaped.bones[i]) limb.confidence[i] = agreed(limb.confidence[i]);
  }
  return limb;
}

void merge_bone(int shaped, double shaped_confidence, int& bone, double& confidence) {
  if (bone < 0)
    bone = shaped, confidence = shaped_confidence;
  else if (bone == shaped)
    confidence = agreed(confidence);
}

/// What the shape tells of a limb and names do not contradict: nothing where they say the other side.
Limb uncontradicted(const BodyTree& tree, Limb limb, const LimbRoles& roles, Side side) {
  for (std::size_t i = 0; i < limb.bones.size(); ++i) {
    int& bone = limb.bones[i];
    if (bone < 0) continue;
    const Side said = tree.names[bone].side;
    if (said != Side::kNone && said != side) return {};
    if (tree.says(bone, roles[i]) < 0) bone = -1;
  }
  return limb;
}

BodyJoints uncontradicted(const BodyTree& tree, BodyJoints shaped) {
  for (int side = 0; side < 2; ++side) {
    shaped.arms[side] = uncontradicted(tree, shaped.arms[side], kArmRoles, kSides[side]);
    shaped.legs[side] = uncontradicted(tree, shaped.legs[side], kLegRoles, kSides[side]);
  }
  return shaped;
}

/// Whether the names say left where feet and knees say right, of both arms and both legs of a man.
bool is_mirrored(const BodyJoints& named, const BodyJoints& shaped) {
  const auto crossed = [](const std::array<Limb, 2>& names, const std::array<Limb, 2>& shapes, int side) {
    const int end = names[side].bones[Limb::kEnd];
    return end >= 0 && end == shapes[1 - side].bones[Limb::kEnd] && names[side].bones[Limb::kLower] >= 0;
  };
  for (const int side : {0, 1}) {
    if (!crossed(named.legs, shaped.legs, side) || !crossed(named.arms, shaped.arms, side)) return false;
  }
  return true;
}

BodyJoints merged(const BodyJoints& named, const BodyJoints& shaped) {
  BodyJoints body = named;
  merge_bone(shaped.hips, shaped.hips_confidence, body.hips, body.hips_confidence);
  body.chest = shaped.chest;
  merge_bone(shaped.head, shaped.head_confidence, body.head, body.head_confidence);
  for (int side = 0; side < 2; ++side) {
    body.arms[side] = merged(named.arms[side], shaped.arms[side], shaped.arms[1 - side]);
    body.legs[side] = merged(named.legs[side], shaped.legs[side], shaped.legs[1 - side]);
  }
  return body;
}

/// Writes the roles of a body into a map.
class MapMaker {
 public:
  MapMaker(const BodyTree& tree, const BodyJoints& body) : tree_(tree), body_(body) {}

  RoleMap make() {
    if (body_.hips > 0) add(Role::kRoot, Side::kNone, 0, 0.9);
    add(Role::kHips, Side::kNone, body_.hips, body_.hips_confidence);
    add_trunk();
    for (int side = 0; side < 2; ++side) {
      add_limb(body_.arms[side], body_.four_legged ? kForeLegRoles : kArmRoles, kSides[side]);
      add_limb(body_.legs[side], kLegRoles, kSides[side]);
      if (!body_.four_legged) add_fingers(side);
      add_toes(side);
    }
    return std::move(map_);
  }

 private:
  void add(Role role, Side side, int bone, double confidence, int order = 0, int finger = -1) {
    if (bone < 0 || confidence < kTold || !used_.insert(bone).second) return;
    map_.bones.push_back({role, side, finger, order, bone, confidence});
  }

  void add_limb(const Limb& limb, const LimbRoles& roles, Side side) {
    for (int i = 0; i < 5; ++i) {
      if (roles[i] != Role::kFinger) add(roles[i], side, limb.bones[i], limb.confidence[i]);
    }
  }

  static int top(const Limb& limb) {
    for (const int bone : limb.bones) {
      if (bone >= 0) return bone;
    }
    return -1;
  }

  // The bones between the hips and the head, from below.
  void add_trunk() {
    const int common = tree_.common(top(body_.arms[0]), top(body_.arms[1]));
    const int arms = common >= 0 ? common : body_.chest;
    const int end = body_.head >= 0 ? body_.head : arms;
    if (!tree_.is_below(end, body_.hips)) return add(Role::kHead, Side::kNone, body_.head, body_.head_confidence);
    std::vector<int> path;
    for (int b = body_.head >= 0 ? tree_.parents[end] : end; b >= 0 && b != body_.hips; b = tree_.parents[b]) {
      if (tree_.in_body[b]) path.insert(path.begin(), b);
    }
    const bool head_named = body_.head >= 0 && tree_.says(body_.head, Role::kHead) > 0;
    const bool chest = arms >= 0 && arms != body_.hips;  // arms on the hips tell no spine from a neck
    bool neck = false;
    int spines = 0, necks = 0;
    for (const int b : path) {
      const double spine_said = tree_.says(b, Role::kSpine), neck_said = tree_.says(b, Role::kNeck);
      const bool beyond_arms = chest && b != arms && tree_.is_below(b, arms);
      neck = neck || neck_said > 0 || (beyond_arms && (spine_said <= 0 || !head_named));
      const bool said = (neck ? neck_said : spine_said) > 0;
      const double confidence = said ? kNamed : chest ? kByPlace : 0;
      add(neck ? Role::kNeck : Role::kSpine, Side::kNone, b, confidence, neck ? necks++ : spines++);
    }
    add(Role::kHead, Side::kNone, body_.head, body_.head_confidence);
  }

  FingerNumbers finger_numbers() const {
    FingerNumbers usual;
    for (const BoneName& name : tree_.names) {
      const std::vector<NameNumber> numbers = numbers_from(name, {"finger"});
      if (name.side == Side::kNone || numbers.empty()) continue;
      usual.first = std::min(usual.first, numbers[0].value);
      usual.one_digit = usual.one_digit || numbers[0].digits == 1;
    }
    return usual;
  }

  // CMU's thumbs hang on the wrist beside the hand.
  void add_fingers(int side) {
    const Limb& arm = body_.arms[side];
    const int from = arm.bones[Limb::kLower] >= 0 ? arm.bones[Limb::kLower] : arm.bones[Limb::kEnd];
    if (from < 0) return;
    const FingerNumbers usual = finger_numbers();
    std::array<std::vector<int>, 5> fingers;
    for (const bool bare : {false, true}) {  // what carries no skin begins a finger where nothing else does
      for (int b = from + 1; b < tree_.size(); ++b) {
        if (!tree_.in_body[b] || tree_.names[b].side != kSides[side] || !tree_.is_below(b, from)) continue;
        const int finger = finger_of(tree_.names[b], usual);
        if (finger < 0 || fingers[finger].size() >= kMostJoints) continue;
        const bool begins = fingers[finger].empty() && tree_.bare[b] == bare;
        if (begins || (!fingers[finger].empty() && tree_.is_below(b, fingers[finger].back())))
          fingers[finger].push_back(b);
      }
    }
    for (int finger = 0; finger < 5; ++finger) {
      for (std::size_t i = 0; i < fingers[finger].size(); ++i) {
        add(Role::kFinger, kSides[side], fingers[finger][i], kNamed, static_cast<int>(i), finger);
      }
    }
  }

  void add_toes(int side) {
    int last = body_.legs[side].bones[Limb::kTip], order = 1;
    for (int b = last + 1; last >= 0 && b < tree_.size(); ++b) {
      const bool goes_on = tree_.in_body[b] && tree_.parents[b] == last && tree_.names[b].side == kSides[side] &&
                           tree_.says(b, Role::kToe) > 0 && order < kMostJoints;
      if (!goes_on) continue;
      add(Role::kToe, kSides[side], b, kNamed, order++);
      last = b;
    }
  }

  const BodyTree& tree_;
  const BodyJoints& body_;
  RoleMap map_;
  std::set<int> used_;
};

/// The next bone of a limb, where a bone with a role ends.
Role next_role(Role role) {
  switch (role) {
    case Role::kUpperArm:
      return Role::kLowerArm;
    case Role::kLowerArm:
      return Role::kHand;
    case Role::kThigh:
      return Role::kShin;
    case Role::kShin:
      return Role::kFoot;
    default:
      return Role::kRoot;
  }
}

double share_along(const std::vector<Vector3>& heads, int limb, int next, int bone) {
  const Vector3 way = heads[next] - heads[limb];
  const double length = way.squaredNorm();
  return length > 0 ? std::clamp(way.dot(heads[bone] - heads[limb]) / length, 0.0, 1.0) : 0;
}

void find_twists(const Skeleton& skeleton, const BodyTree& tree, RoleMap& map) {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  std::set<int> used;
  for (const RoleBone& bone : map.bones) used.insert(bone.bone);
  for (const RoleBone& limb : map.bones) {
    const int next = map.bone(next_role(limb.role), limb.side);
    if (next_role(limb.role) == Role::kRoot || next < 0) continue;
    for (int b = 0; b < tree.size(); ++b) {
      if (used.count(b) || !tree.is_below(b, limb.bone) || tree.is_below(b, next)) continue;
      if (tree.is_below(next, b) || tree.twist[b]) {
        map.twists.push_back({b, limb.bone, share_along(heads, limb.bone, next, b)});
        used.insert(b);
      }
    }
  }
}

std::string role_word(Role role) {
  constexpr std::string_view kNames[] = {"root",      "hips",      "spine",    "neck",      "head",    "shoulder",
                                         "upper_arm", "lower_arm", "hand",     "finger",    "thigh",   "shin",
                                         "foot",      "toe",       "fore_leg", "fore_foot", "fore_toe"};
  return std::string(kNames[static_cast<int>(role)]);
}

bool is_many(Role role) { return role == Role::kSpine || role == Role::kNeck || role == Role::kFinger; }

/// Every role that a user may give, the many ones with as many bones as any rig has.
std::map<std::string, RoleBone> known_roles() {
  constexpr int kMostInTrunk = 32;
  std::map<std::string, RoleBone> known;
  const auto add = [&](const RoleBone& bone) { known.emplace(role_label(bone), bone); };
  for (const Role role : {Role::kRoot, Role::kHips, Role::kHead}) add({role, Side::kNone, -1, 0, -1, 1});
  for (int i = 0; i < kMostInTrunk; ++i) {
    for (const Role role : {Role::kSpine, Role::kNeck}) add({role, Side::kNone, -1, i, -1, 1});
  }
  for (const Side side : kSides) {
    for (int role = static_cast<int>(Role::kShoulder); role <= static_cast<int>(Role::kForeToe); ++role) {
      const auto what = static_cast<Role>(role);
      const bool finger = what == Role::kFinger;
      for (int i = 0; i < (finger || what == Role::kToe ? kMostJoints : 1); ++i) {
        for (int f = finger ? 0 : -1; f < (finger ? 5 : 0); ++f) add({what, side, f, i, -1, 1});
      }
    }
  }
  return known;
}

}  // namespace

int frames_between_looks(int frames) { return std::max(1, frames / kLooks); }

int RoleMap::bone(Role role, Side side) const {
  for (const RoleBone& b : bones) {
    if (b.role == role && b.side == side && b.order == 0) return b.bone;
  }
  return -1;
}

std::vector<int> RoleMap::chain(Role role, Side side) const {
  std::vector<std::pair<int, int>> found;
  for (const RoleBone& b : bones) {
    if (b.role == role && b.side == side) found.emplace_back(b.order, b.bone);
  }
  std::sort(found.begin(), found.end());
  std::vector<int> chain;
  for (const auto& [order, bone] : found) chain.push_back(bone);
  return chain;
}

double RoleMap::confidence(Role role, Side side) const {
  double least = 0;
  for (const RoleBone& b : bones) {
    if (b.role == role && b.side == side) least = least > 0 ? std::min(least, b.confidence) : b.confidence;
  }
  return least;
}

RoleMap find_role_map(const Skeleton& skeleton, const ObservedPoses* motion, Sides sides, const Skin* skin) {
  BodyTree tree(skeleton, skin);
  if (const std::optional<BodyJoints> beast = four_legged_body(skeleton, tree, motion))
    return MapMaker(tree, *beast).make();
  std::optional<BodyJoints> named = named_body(tree);
  if (!named) tree.forget_names();
  const BodyJoints shaped = shaped_body(skeleton, tree, motion);
  if (named) mend_named_legs(skeleton, tree, *named);
  const auto is_swapped = [&] {
    return shaped.legs[0].whole() ? is_mirrored(*named, shaped) : points_to_wrong_sides(skeleton, tree, motion, *named);
  };
  if (named && sides == Sides::of_the_body && is_swapped()) {
    tree.swap_sides();
    named = named_body(tree);
    if (named) mend_named_legs(skeleton, tree, *named);
  }
  BodyJoints body = merged(named.value_or(BodyJoints{}), uncontradicted(tree, shaped));
  forget_shins_of_beasts(skeleton, tree, body);
  RoleMap map = MapMaker(tree, body).make();
  find_twists(skeleton, tree, map);
  return map;
}

std::string role_label(const RoleBone& bone) {
  std::string label = bone.side == Side::kLeft ? "left_" : bone.side == Side::kRight ? "right_" : "";
  label +=
      bone.role == Role::kFinger && bone.finger >= 0 ? std::string(kFingerNames[bone.finger]) : role_word(bone.role);
  if (is_many(bone.role) || bone.order > 0) label += "_" + std::to_string(bone.order + 1);
  return label;
}

std::string role_label(Role role, Side side) {
  RoleBone bone;
  bone.role = role;
  bone.side = side;
  return role_label(bone);
}

std::map<std::string, std::string> named_bones(const Skeleton& skeleton, const RoleMap& map) {
  std::map<std::string, std::string> named;
  for (const RoleBone& bone : map.bones) named[role_label(bone)] = skeleton.names[bone.bone];
  return named;
}

RoleMap role_map_of(const Skeleton& skeleton, const std::map<std::string, std::string>& bones) {
  static const std::map<std::string, RoleBone> known = known_roles();
  RoleMap map;
  std::map<int, std::string> used;
  for (const auto& [label, name] : bones) {
    const auto role = known.find(label);
    if (role == known.end()) {
      throw std::invalid_argument("no role '" + label +
                                  "'; the roles are root, hips, spine_1 ..., neck_1 ..., head, and with left_ or "
                                  "right_ shoulder, upper_arm, lower_arm, hand, thumb_1 ..., index_1 ..., "
                                  "middle_1 ..., ring_1 ..., pinky_1 ..., thigh, shin, foot, toe, fore_leg, fore_foot, "
                                  "fore_toe");
    }
    RoleBone bone = role->second;
    bone.bone = skeleton.find(name);
    if (bone.bone < 0) throw std::invalid_argument("role '" + label + "': there is no bone '" + name + "'");
    const auto [first, fresh] = used.emplace(bone.bone, label);
    if (!fresh) {
      throw std::invalid_argument("bone '" + name + "' has two roles, '" + first->second + "' and '" + label + "'");
    }
    map.bones.push_back(bone);
  }
  find_twists(skeleton, BodyTree(skeleton), map);
  return map;
}

RoleMap with_told(const Skeleton& skeleton, const RoleMap& found, const std::map<std::string, std::string>& told) {
  std::set<std::string> taken;
  for (const auto& [label, name] : told) taken.insert(name);
  std::map<std::string, std::string> bones = told;
  for (const auto& [label, name] : named_bones(skeleton, found)) {
    if (!taken.count(name)) bones.emplace(label, name);
  }
  return role_map_of(skeleton, bones);
}

}  // namespace fragmotion
