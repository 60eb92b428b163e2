// SPDX-License-Identifier: MIT
#include "skeleton/body_tree.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace fragmotion {
namespace {

constexpr int kFewest = 8;  // bones of a layer

enum class Layer { kControl, kDeform, kOriginal, kMechanism };

Layer layer_of(const std::string& name) {
  if (name.rfind("DEF-", 0) == 0) return Layer::kDeform;
  if (name.rfind("ORG-", 0) == 0) return Layer::kOriginal;
  if (name.rfind("MCH-", 0) == 0) return Layer::kMechanism;
  return Layer::kControl;
}

std::string without_layer(const std::string& name) { return layer_of(name) == Layer::kControl ? name : name.substr(4); }

/// The layer that moves the mesh, else the one that the others were made of; all bones of a plain skeleton.
std::vector<bool> body_layer(const Skeleton& skeleton) {
  std::map<Layer, int> count;
  for (const std::string& name : skeleton.names) ++count[layer_of(name)];
  std::vector<bool> in(skeleton.size(), true);
  for (const Layer layer : {Layer::kDeform, Layer::kOriginal}) {
    if (count[layer] < kFewest) continue;
    for (int b = 0; b < skeleton.size(); ++b) in[b] = layer_of(skeleton.names[b]) == layer;
    break;
  }
  return in;
}

/// The next bone of the layer above; what stands between may belong to another layer's bone of the same name.
std::vector<int> layer_parents(const Skeleton& skeleton, const std::vector<bool>& in) {
  std::map<std::string, int> by_name;
  for (int b = 0; b < skeleton.size(); ++b) {
    if (in[b]) by_name.emplace(without_layer(skeleton.names[b]), b);
  }
  std::vector<int> standing(skeleton.size());  // the layer's bone that each bone is or serves, or that is above
  std::vector<int> parents(skeleton.size(), -1);
  for (int b = 0; b < skeleton.size(); ++b) {
    const int above = skeleton.parents[b] < 0 ? -1 : standing[skeleton.parents[b]];
    const auto same = by_name.find(without_layer(skeleton.names[b]));
    standing[b] = in[b] ? b : same != by_name.end() && same->second < b ? same->second : above;
    if (in[b]) parents[b] = above;
  }
  return parents;
}

}  // namespace

BodyTree::BodyTree(const Skeleton& skeleton)
    : names(read_names(skeleton)),
      in_layer(body_layer(skeleton)),
      in_body(in_layer),
      parents(layer_parents(skeleton, in_layer)) {
  depth.assign(size(), 0);
  holds.assign(size(), {});
  twist.assign(size(), false);
  for (const BoneName& name : names) said.push_back(fragmotion::says(name));
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
