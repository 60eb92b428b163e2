// SPDX-License-Identifier: MIT
#include "io/asf.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/take_limits.hpp"
#include "base/text_reader.hpp"
#include "io/parse_text.hpp"
#include "io/y_up.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {
namespace {

/// The words of AsfBone::dofs.
constexpr std::array<std::string_view, 6> kDofNames = {"tx", "ty", "tz", "rx", "ry", "rz"};

class AsfReader {
 public:
  AsfReader(std::string text, const std::string& file) : reader_(std::move(text), file, kAcclaimComment) {}

  AsfModel read() {
    bones_.resize(1);
    bones_[0].name = "root";
    indices_["root"] = 0;
    while (!reader_.peek().empty()) read_section();
    if (bones_.size() == 1) reader_.fail("no bones: a :bonedata section expected");
    check_connected();
    return build_model();
  }

 private:
  void read_section() {
    const std::string_view section = reader_.word();
    if (same_word(section, ":units")) {
      read_units();
    } else if (same_word(section, ":root")) {
      read_root();
    } else if (same_word(section, ":bonedata")) {
      read_bones();
    } else if (same_word(section, ":hierarchy")) {
      read_hierarchy();
    } else if (section.front() == ':') {
      skip_section();
    } else {
      reader_.fail("a section such as :bonedata expected, found " + reader_.quoted(section));
    }
  }

  bool is_in_section() {
    const std::string_view next = reader_.peek();
    return !next.empty() && next.front() != ':';
  }

  /// Version, name, documentation and skin say nothing about the motion.
  void skip_section() {
    reader_.skip_to_line_end();
    while (is_in_section()) reader_.skip_to_line_end();
  }

  void read_units() {
    while (is_in_section()) {
      const std::string_view word = reader_.word();
      if (same_word(word, "length")) {
        read_length_unit();
      } else if (same_word(word, "angle")) {
        read_angle_unit();
      } else {
        reader_.skip_to_line_end();
      }
    }
  }

  void read_length_unit() {
    const double length = reader_.number("a length");
    unit_ = kInch / length;
    if (length <= 0) reader_.fail("a length above 0 expected");
    if (length < 1 / kLargestNumber) reader_.fail("a length from 1e-12 on expected");
  }

  void read_angle_unit() {
    const std::string_view word = reader_.word_in_line();
    if (same_word(word, "rad") || same_word(word, "radians")) {
      radians_ = 1;
    } else if (!same_word(word, "deg") && !same_word(word, "degrees")) {
      reader_.fail("angle deg or rad expected, found " + reader_.quoted(word));
    }
  }

  void read_root() {
    AsfBone& root = bones_[0];
    while (is_in_section()) {
      const std::string_view word = reader_.word();
      if (same_word(word, "order")) {
        read_dofs(root);
      } else if (same_word(word, "axis")) {
        read_axis_order(root);
      } else if (same_word(word, "position")) {
        root.position = reader_.vector("a number of the position");
      } else if (same_word(word, "orientation")) {
        root.axis_angles = radians_ * reader_.vector("a number of the orientation");
      } else {
        reader_.fail("order, axis, position or orientation expected, found " + reader_.quoted(word));
      }
    }
  }

  void read_bones() {
    while (is_in_section()) {
      reader_.expect("begin");
      reader_.check_bones(bones_.size());
      AsfBone bone;
      while (read_bone_entry(bone)) continue;
      if (bone.name.empty()) reader_.fail("a bone without a name");
      if (!indices_.emplace(bone.name, bones_.size()).second) reader_.fail("bone '" + bone.name + "' appears twice");
      bones_.push_back(std::move(bone));
    }
  }

  /// False at the bone's end.
  bool read_bone_entry(AsfBone& bone) {
    const std::string_view word = reader_.word();
    if (same_word(word, "end")) return false;
    if (same_word(word, "name")) {
      bone.name = reader_.word_in_line();
      reader_.check_name(bone.name);
    } else if (same_word(word, "direction")) {
      bone.direction = reader_.vector("a number of the direction");
    } else if (same_word(word, "length")) {
      bone.length = reader_.number("a length");
    } else if (same_word(word, "axis")) {
      bone.axis_angles = radians_ * reader_.vector("an angle of the axis");
      read_axis_order(bone);
    } else if (same_word(word, "dof")) {
      read_dofs(bone);
    } else {
      skip_bone_entry(bone, word);
    }
    return true;
  }

  void skip_bone_entry(const AsfBone& bone, std::string_view word) {
    if (word.empty()) reader_.fail("the file ends inside bone '" + bone.name + "', 'end' expected");
    // Limits go on over lines that begin with a bracket.
    bool is_known = word.front() == '(';
    for (const std::string_view known : {"id", "limits", "bodymass", "cofmass"}) {
      is_known = is_known || same_word(word, known);
    }
    if (!is_known) reader_.fail("an entry of a bone or 'end' expected, found " + reader_.quoted(word));
    reader_.skip_to_line_end();
  }

  void read_axis_order(AsfBone& bone) {
    const std::string_view word = reader_.word_in_line();
    std::array<bool, 3> seen = {};
    for (std::size_t i = 0; i < word.size() && i < 3; ++i) {
      const int axis = ascii_lower(word[i]) - 'x';
      if (axis < 0 || axis > 2) break;
      bone.axis_order[i] = axis;
      seen[axis] = true;
    }
    if (word.size() != 3 || !(seen[0] && seen[1] && seen[2])) {
      reader_.fail("an axis order such as XYZ expected, found " + reader_.quoted(word));
    }
  }

  void read_dofs(AsfBone& bone) {
    bone.dofs.clear();
    for (auto word = reader_.word_in_line(); !word.empty(); word = reader_.word_in_line()) {
      bone.dofs.push_back(find_dof(word));
      if (bone.dofs.size() > kDofNames.size()) reader_.fail("more than 6 dofs");
    }
  }

  int find_dof(std::string_view word) const {
    for (std::size_t i = 0; i < kDofNames.size(); ++i) {
      if (same_word(word, kDofNames[i])) return static_cast<int>(i);
    }
    if (same_word(word, "l")) reader_.fail("dof 'l' (a bone that changes its length) is not supported");
    reader_.fail("dof tx, ty, tz, rx, ry or rz expected, found " + reader_.quoted(word));
  }

  void read_hierarchy() {
    reader_.expect("begin");
    for (auto word = reader_.word(); !same_word(word, "end"); word = reader_.word()) {
      if (word.empty()) reader_.fail("the file ends inside :hierarchy, 'end' expected");
      const int parent = find_bone(word);
      for (auto child = reader_.word_in_line(); !child.empty(); child = reader_.word_in_line()) {
        connect(parent, find_bone(child));
      }
    }
  }

  int find_bone(std::string_view name) const {
    const auto found = indices_.find(std::string(name));
    if (found == indices_.end()) reader_.fail("unknown bone " + reader_.quoted(name) + " in :hierarchy");
    return found->second;
  }

  void connect(int parent, int child) {
    const std::string label = "bone '" + bones_[child].name + "'";
    if (bones_[child].parent >= 0) reader_.fail(label + " has two parents");
    for (int above = parent; above >= 0; above = bones_[above].parent) {
      if (above == child) reader_.fail(label + " is above itself: the hierarchy is cyclic");
    }
    bones_[child].parent = parent;
  }

  void check_connected() const {
    for (std::size_t i = 1; i < bones_.size(); ++i) {
      if (bones_[i].parent < 0) reader_.fail("bone '" + bones_[i].name + "' has no parent in :hierarchy");
    }
  }

  /// Bones in depth-first order, as parents may stand after their children in the file.
  std::vector<int> depth_first_order() const {
    std::vector<std::vector<int>> children(bones_.size());
    for (std::size_t i = bones_.size() - 1; i > 0; --i) children[bones_[i].parent].push_back(static_cast<int>(i));
    std::vector<int> order, open = {0};
    while (!open.empty()) {
      const int bone = open.back();
      open.pop_back();
      order.push_back(bone);
      open.insert(open.end(), children[bone].begin(), children[bone].end());
    }
    return order;
  }

  AsfModel build_model() const {
    AsfModel model;
    model.unit = unit_;
    model.radians = radians_;
    std::vector<int> places(bones_.size());
    for (const int index : depth_first_order()) {
      places[index] = static_cast<int>(model.bones.size());
      model.bones.push_back(bones_[index]);
      if (index > 0) model.bones.back().parent = places[bones_[index].parent];
    }
    model.skeleton = build_skeleton(model.bones);
    return model;
  }

  Skeleton build_skeleton(const std::vector<AsfBone>& bones) const {
    Skeleton skeleton;
    Vector3 sum = Vector3::Zero();
    int root_children = 0;
    for (const AsfBone& bone : bones) {
      // A bone begins where its parent ends; the root is a point, and its tip here only shows where it leads.
      const Vector3 head = bone.parent < 0    ? bone.position
                           : bone.parent == 0 ? Vector3(0, 0, 0)
                                              : bones[bone.parent].tip();
      skeleton.names.push_back(bone.name);
      skeleton.parents.push_back(bone.parent);
      skeleton.rest_rotations.push_back(Quaternion::Identity());
      skeleton.offsets.emplace_back(unit_ * z_up_from_y_up(head));
      skeleton.tips.emplace_back(unit_ * z_up_from_y_up(bone.tip()));
      if (bone.parent != 0) continue;
      sum += skeleton.tips.back();
      ++root_children;
    }
    skeleton.tips[0] = sum / root_children;
    return make_skeleton(std::move(skeleton));
  }

  TextReader reader_;
  std::vector<AsfBone> bones_;
  std::unordered_map<std::string, int> indices_;
  double unit_ = kInch;
  double radians_ = radians_from_degrees(1);
};

}  // namespace

Quaternion AsfBone::axis() const {
  Quaternion rotation = Quaternion::Identity();
  for (const int axis : axis_order) rotation = axis_rotation(axis, axis_angles[axis]) * rotation;
  return rotation;
}

AsfModel parse_asf(std::string text, const std::string& file) { return AsfReader(std::move(text), file).read(); }

}  // namespace fragmotion
