// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/rounding.hpp"
#include "base/take_limits.hpp"
#include "base/write_file.hpp"
#include "io/bvh.hpp"
#include "io/file_unit.hpp"
#include "io/rotation.hpp"
#include "io/y_up.hpp"

namespace fragmotion {
namespace {

constexpr int kDecimals = 6;
constexpr const char* kOrder = "YXZ";  // of euler_to_quaternion: Rz Rx Ry
constexpr const char* kRotations = " Zrotation Xrotation Yrotation";
constexpr const char* kPositions = " Xposition Yposition Zposition";

bool is_odd(unsigned char c) { return c < ' ' || c == 127 || c == '{' || c == '}'; }

// Whether a reader that parts lines at their blanks gets the name back: as Biped's, with one between two words.
bool is_read_back(const std::string& name) {
  return std::none_of(name.begin(), name.end(), is_odd) && name.front() != ' ' && name.back() != ' ' &&
         name.find("  ") == std::string::npos;
}

void check_names(const Skeleton& skeleton) {
  for (const std::string& name : skeleton.names) {
    if (name.empty()) throw std::invalid_argument("a bone has no name, and a BVH file needs one for each: name it");
    if (is_read_back(name)) continue;
    throw std::invalid_argument("bone '" + name +
                                "': no brace, and no blank but one between words, may be in a name of a BVH file: "
                                "rename it");
  }
}

void check_numbers(const Take& take, double unit) {
  const std::size_t bones = take.skeleton.names.size();
  for (std::size_t at = 0; at < bones * take.frames; ++at) {
    const Vector3 place = load_vector(&take.translations[3 * at]);
    const bool known = place.allFinite() && load_quaternion(&take.rotations[4 * at]).coeffs().allFinite();
    if (known && place.cwiseAbs().maxCoeff() <= kLargestNumber * unit) continue;
    throw std::invalid_argument(
        "take '" + take.name + "', frame " + std::to_string(at / bones) + ", bone '" + take.skeleton.names[at % bones] +
        "': " +
        (known ? "it is over 1e12 units away: choose a larger unit" : "a number is missing: mend the take first"));
  }
}

class BvhWriter {
 public:
  BvhWriter(const Take& take, double unit) : take_(take), unit_(unit), children_(take.skeleton.size()) {
    text_.imbue(std::locale::classic());
    text_ << std::fixed;
    text_.precision(kDecimals);
    std::vector<Vector3> heads;
    rest_pose(take.skeleton, heads, rests_);
    for (int bone = 1; bone < take.skeleton.size(); ++bone) children_[take.skeleton.parents[bone]].push_back(bone);
  }

  std::string write() {
    text_ << "HIERARCHY\n";
    write_joint(0, "");
    text_ << "MOTION\nFrames: " << take_.frames << "\nFrame Time: ";
    write_frame_time();
    write_frames();
    return text_.str();
  }

 private:
  /// A joint as it moves: whether it has positions, and its angles [frames, 3] about X, Y and Z.
  struct Track {
    int bone = 0;
    bool moves = false;
    std::vector<double> angles;
  };

  void write_joint(int bone, const std::string& indent) {
    const std::string inner = indent + "  ";
    tracks_.push_back({bone, leaves_offset(bone), angles_of(bone)});
    text_ << indent << (bone == 0 ? "ROOT " : "JOINT ") << take_.skeleton.names[bone] << "\n" << indent << "{\n";
    write_offset(inner, in_parent(bone, take_.skeleton.offsets[bone]));
    text_ << inner << "CHANNELS " << (tracks_.back().moves ? 6 : 3) << (tracks_.back().moves ? kPositions : "")
          << kRotations << "\n";
    for (const int child : children_[bone]) write_joint(child, inner);
    if (children_[bone].empty()) write_end_site(bone, inner);
    text_ << indent << "}\n";
  }

  void write_end_site(int bone, const std::string& indent) {
    text_ << indent << "End Site\n" << indent << "{\n";
    write_offset(indent + "  ", rests_[bone] * take_.skeleton.tips[bone]);
    text_ << indent << "}\n";
  }

  void write_offset(const std::string& indent, const Vector3& offset) {
    text_ << indent << "OFFSET";
    write_place(offset);
    text_ << "\n";
  }

  /// The time is small: six decimals would change rates over 100 a second.
  void write_frame_time() {
    text_.precision(2 * kDecimals);
    text_ << 1 / take_.rate << "\n";
    text_.precision(kDecimals);
  }

  void write_frames() {
    for (int frame = 0; frame < take_.frames; ++frame) {
      for (const Track& track : tracks_) write_pose(track, frame);
      text_ << "\n";
    }
  }

  void write_pose(const Track& track, int frame) {
    if (track.moves) write_place(in_parent(track.bone, translation(track.bone, frame)));
    const Vector3 degrees = load_vector(&track.angles[3 * static_cast<std::size_t>(frame)]) * (180 / kPi);
    for (const int axis : {2, 0, 1}) write_number(degrees[axis]);
  }

  void write_place(const Vector3& place) {
    for (const double value : y_up_from_z_up(place)) write_number(value / unit_);
  }

  /// Never "-0.000000".
  void write_number(double value) { text_ << " " << (std::abs(value) < 0.5e-6 ? 0.0 : value); }

  /// A place in the parent's frame, along the world's axes at rest.
  Vector3 in_parent(int bone, const Vector3& place) const { return parent_rest(bone) * place; }

  Quaternion parent_rest(int bone) const {
    return bone == 0 ? Quaternion::Identity() : rests_[take_.skeleton.parents[bone]];
  }

  std::size_t index(int bone, int frame) const {
    return static_cast<std::size_t>(frame) * take_.skeleton.size() + bone;
  }

  Vector3 translation(int bone, int frame) const { return load_vector(&take_.translations[3 * index(bone, frame)]); }

  bool leaves_offset(int bone) const {
    if (bone == 0) return true;
    for (int frame = 0; frame < take_.frames; ++frame) {
      if ((translation(bone, frame) - take_.skeleton.offsets[bone]).norm() > kFloatRounding) return true;
    }
    return false;
  }

  /// Of the rotations away from rest, in the file's axes.
  std::vector<double> angles_of(int bone) const {
    std::vector<double> rotations(4 * static_cast<std::size_t>(take_.frames));
    for (int frame = 0; frame < take_.frames; ++frame) {
      const Quaternion local = load_quaternion(&take_.rotations[4 * index(bone, frame)]);
      const Quaternion turned = parent_rest(bone) * local * rests_[bone].conjugate();
      store_quaternion(y_up_from_z_up(turned), &rotations[4 * static_cast<std::size_t>(frame)]);
    }
    return quaternion_to_euler(kOrder, rotations.data(), take_.frames);
  }

  const Take& take_;
  double unit_;
  std::vector<std::vector<int>> children_;
  std::vector<Quaternion> rests_;  ///< In the world.
  std::vector<Track> tracks_;      ///< In the file's order.
  std::ostringstream text_;
};

}  // namespace

void write_bvh(const Take& take, const std::filesystem::path& path, double unit) {
  check_unit(unit);
  check_names(take.skeleton);
  check_numbers(take, unit);
  write_file(path, BvhWriter(take, unit).write());
}

}  // namespace fragmotion
