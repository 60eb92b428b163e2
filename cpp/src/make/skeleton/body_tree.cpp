// SPDX-License-Identifier: MIT
#include "skeleton/body_tree.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace fragmotion {
namespace {

enum class Layer { kControl, kDeform, kOriginal, kMechanism };

using Names = std::vector<std::string>;

/// Where "_" and the number begin that a name ends with; its length where it has none.
std::size_t end_of_name(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  return last != std::string::npos && last + 1 < name.size() && name[last] == '_' ? last : name.size();
}

/// The names without the numbers of nodes that exporters add, no two alike: "LeftArm_012", "Hips_02".
Names without_node_numbers(const Names& names) {
  std::set<std::string> numbers;
  Names shorter;
  for (const std::string& name : names) {
    const std::size_t end = end_of_name(name);
    if (end < name.size()) numbers.insert(name.substr(end));
    shorter.push_back(name.substr(0, end));
  }
  return 2 * numbers.size() > names.size() ? shorter : names;  // of most
}

Layer layer_of(const std::string& name) {
  if (name.rfind("DEF-", 0) == 0) return Layer::kDeform;
  if (name.rfind("ORG-", 0) == 0) return Layer::kOriginal;
  if (name.rfind("MCH-", 0) == 0) return Layer::kMechanism;
  return Layer::kControl;
}

std::string without_layer(const std::string& name) { return layer_of(name) == Layer::kControl ? name : name.substr(4); }

/// The layer that moves the mesh, else the one that the others were made of; all bones of a plain skeleton.
std::vector<bool> body_layer(const Names& names) {
  std::map<Layer, int> count;
  for (const std::string& name : names) ++count[layer_of(name)];
  std::vector<bool> in(names.size(), true);
  for (const Layer layer : {Layer::kDeform, Layer::kOriginal}) {
    if (count[layer] <= static_cast<int>(2 * kLimbJoints)) continue;  // no two legs, and what carries them
    for (std::size_t b = 0; b < names.size(); ++b) in[b] = layer_of(names[b]) == layer;
    break;
  }
  return in;
}

/// The next bone of the layer above; what stands between may belong to another layer's bone of the same name.
std::vector<int> layer_parents(const Skeleton& skeleton, const Names& names, const std::vector<bool>& in) {
  std::map<std::string, int> by_name;
  for (int b = 0; b < skeleton.size(); ++b) {
    if (in[b]) by_name.emplace(without_layer(names[b]), b);
  }
  std::vector<int> standing(skeleton.size());  // the layer's bone that each bone is or serves, or that is above
  std::vector<int> parents(skeleton.size(), -1);
  for (int b = 0; b < skeleton.size(); ++b) {
    const int above = skeleton.parents[b] < 0 ? -1 : standing[skeleton.parents[b]];
    const auto same = by_name.find(without_layer(names[b]));
    standing[b] = in[b] ? b : same != by_name.end() && same->second < b ? same->second : above;
    if (in[b]) parents[b] = above;
  }
  return parents;
}

}  // namespace

BodyTree::BodyTree(const Skeleton& skeleton, const Skin* skin) {
  const Names plain = without_node_numbers(skeleton.names);
  names = read_names(plain);
  in_layer = in_body = body_layer(plain);
  parents = layer_parents(skeleton, plain, in_layer);
  depth.assign(size(), 0);
  holds.assign(size(), {});
  twist.assign(size(), false);
  bare = skin ? bare_bones(skeleton, *skin) : std::vector<bool>(size(), false);
  for (const BoneName& name : names) said.push_back(fragmotion::says(name));
  silence_numbered_limbs();
  contradict_fore_legs();
  for (int b = 0; b < size(); ++b) {
    depth[b] = parents[b] < 0 ? 0 : depth[parents[b]] + 1;
    twist[b] = in_body[b] && says_twist(names[b]);
    if (says_helper(names[b])) in_body[b] = false;
  }
  for (int b = size() - 1; b >= 0; --b) {
    if (in_body[b] && names[b].side != Side::kNone) holds[b][names[b].side == Side::kLeft ? 0 : 1] = true;
    if (parents[b] < 0) continue;
    for (int side = 0; side < 2; ++side) holds[parents[b]][side] = holds[parents[b]][side] || holds[b][side];
  }
}

void BodyTree::forget_names() {
  names.assign(names.size(), {});
  said.assign(names.size(), {});
  in_body = in_layer;
  twist.assign(size(), false);
}

void BodyTree::swap_sides() {
  for (BoneName& name : names) {
    if (name.side != Side::kNone) name.side = name.side == Side::kLeft ? Side::kRight : Side::kLeft;
  }
  for (std::array<bool, 2>& held : holds) std::swap(held[0], held[1]);
}

/// "leg_joint_L_1", "leg_joint_L_2", "leg_joint_L_3" say of which limb they are, not which of its bones.
void BodyTree::silence_numbered_limbs() {
  const auto silence = [&](int bone, const LimbRoles& roles) {
    for (const Role role : roles) said[bone][static_cast<int>(role)] = 0;
  };
  for (int b = 0; b < size(); ++b) {
    std::vector<int> chain{b};
    for (int p = parents[b]; p >= 0 && names[p].words == names[b].words; p = parents[p]) chain.push_back(p);
    if (chain.size() < kLimbJoints) continue;
    const bool arm = says(b, Role::kUpperArm) > 0 && says(b, Role::kLowerArm) > 0;
    const bool leg = says(b, Role::kThigh) > 0 && says(b, Role::kShin) > 0;
    for (const int bone : chain) {
      if (arm) silence(bone, kArmRoles);
      if (leg) silence(bone, kLegRoles);
    }
  }
}

/// Of a beast whose names tell hind legs and others, the others are no legs of the two that carry it.
void BodyTree::contradict_fore_legs() {
  const auto is_leg = [&](int bone) {
    return has_any_word(names[bone], {"leg", "foot"}) && names[bone].side != Side::kNone;
  };
  const auto is_hind = [&](int bone) { return is_leg(bone) && has_any_word(names[bone], {"back", "hind", "rear"}); };
  std::vector<int> bones(size());
  std::iota(bones.begin(), bones.end(), 0);
  if (std::none_of(bones.begin(), bones.end(), is_hind)) return;
  for (const int bone : bones) {
    if (!is_leg(bone) || !has_any_word(names[bone], {"front", "fore", "mid"})) continue;
    for (const Role role : {Role::kThigh, Role::kShin, Role::kFoot, Role::kToe})
      said[bone][static_cast<int>(role)] = kContradicts;
  }
}

bool BodyTree::is_below(int bone, int ancestor) const {
  if (bone < 0 || ancestor < 0) return false;
  while (bone >= 0 && depth[bone] > depth[ancestor]) bone = parents[bone];
  return bone == ancestor;
}

int BodyTree::common(int a, int b) const {
  while (a != b) {
    if (a < 0 || b < 0) return -1;
    int& lower = depth[a] > depth[b] ? a : b;
    lower = parents[lower];
  }
  return a;
}

}  // namespace fragmotion
