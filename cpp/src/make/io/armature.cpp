// SPDX-License-Identifier: MIT
#include "io/armature.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_set>
#include <utility>

#include "base/quantile.hpp"
#include "base/rounding.hpp"
#include "io/hanging.hpp"
#include "io/rigid_matrix.hpp"

namespace fragmotion {
namespace {

constexpr double kOverlong = 3;  // times as long as the way to the next bone: no lengths of this body

void check_size(std::size_t found, std::size_t expected, const char* what) {
  if (found != expected)
    fail("armature", "has " + std::to_string(found) + " " + what + ", expected " + std::to_string(expected));
}

void check_bones(const Armature& armature) {
  std::unordered_set<std::string> seen;
  for (int b = 0; b < static_cast<int>(armature.names.size()); ++b) {
    const int parent = armature.parents[b];
    if (!seen.insert(armature.names[b]).second) fail(bone_label(armature, b), "the name appears twice");
    if (parent < -1 || parent >= b)
      fail(bone_label(armature, b), "has parent " + std::to_string(parent) + "; parents must come before children");
    if (!std::isfinite(armature.lengths[b])) fail(bone_label(armature, b), "the length is not finite");
  }
  for (const auto& [role, bone] : armature.roles) {
    if (seen.count(bone) == 0) fail("role '" + role + "'", "the armature has no bone '" + bone + "'");
  }
  for (const auto& [bone, on] : armature.hangs) {
    if (seen.count(bone) == 0 || seen.count(on) == 0)
      fail("bone '" + bone + "' hangs on '" + on + "'", "the armature has not both");
  }
  for (const auto& [bone, place] : armature.held) {
    if (seen.count(bone) == 0) fail("held bone '" + bone + "'", "the armature has no such bone");
  }
  for (const auto& [bone, size] : armature.sizes) {
    if (seen.count(bone) == 0) fail("size of bone '" + bone + "'", "the armature has no such bone");
    if (!(size > kRounding) || !std::isfinite(size))
      fail("bone '" + bone + "'", "is " + std::to_string(size) + " times as large");
  }
}

/// By how much bones are too long: the median over those with one child, of their lengths in ways to the child.
double overlength(const Armature& armature) {
  const auto head = [&](std::size_t b) -> Vector3 { return RowMajor(&armature.rest[16 * b]).topRightCorner<3, 1>(); };
  std::vector<int> children(armature.names.size(), 0);
  for (const int parent : armature.parents) {
    if (parent >= 0) ++children[parent];
  }
  std::vector<double> ratios;
  for (std::size_t b = 0; b < armature.names.size(); ++b) {
    const int parent = armature.parents[b];
    if (parent < 0 || children[parent] != 1) continue;
    const double way = (head(b) - head(parent)).norm();
    if (way > 0) ratios.push_back(armature.lengths[parent] / way);
  }
  return ratios.empty() ? 1 : median(std::move(ratios));
}

/// Blender's importer of glTF makes all bones a hundred times too long where the file's armature is scaled by 0.01.
void shorten_bones(Armature& armature) {
  const double times = overlength(armature);
  if (!(times > kOverlong)) return;
  for (double& length : armature.lengths) length /= times;
}

}  // namespace

Armature checked_armature(Armature armature) {
  const std::size_t bones = armature.names.size();
  if (bones == 0) fail("armature", "has no bones");
  if (armature.inherit_rotation.empty()) armature.inherit_rotation.assign(bones, true);
  if (armature.local_location.empty()) armature.local_location.assign(bones, true);
  check_size(armature.parents.size(), bones, "parents");
  check_size(armature.rest.size(), bones * 16, "values in rest matrices");
  check_size(armature.lengths.size(), bones, "lengths");
  check_size(armature.world.size(), 16, "values in the world matrix");
  check_size(armature.inherit_rotation.size(), bones, "inherit_rotation flags");
  check_size(armature.local_location.size(), bones, "local_location flags");
  check_bones(armature);
  shorten_bones(armature);
  return armature;
}

std::string bone_label(const Armature& armature, int bone) { return "bone '" + armature.names[bone] + "'"; }

std::vector<int> hanging(const Armature& armature) {
  const auto number = [&](const std::string& name) {
    return static_cast<int>(std::find(armature.names.begin(), armature.names.end(), name) - armature.names.begin());
  };
  std::vector<int> hangs = armature.parents;
  for (const auto& [bone, on] : armature.hangs) hangs[number(bone)] = number(on);
  return hangs;
}

std::vector<int> checked_order(const Armature& armature, const std::vector<int>& hangs) {
  std::vector<int> order = ordered_bones(armature.parents, hangs);
  for (int b = 0; b < static_cast<int>(hangs.size()); ++b) {
    if (std::find(order.begin(), order.end(), b) == order.end())
      fail(bone_label(armature, b), "hangs on a bone that it moves");
  }
  return order;
}

}  // namespace fragmotion
