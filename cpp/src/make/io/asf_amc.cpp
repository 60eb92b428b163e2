// SPDX-License-Identifier: MIT
#include "io/asf_amc.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "base/read_file.hpp"
#include "base/text_reader.hpp"
#include "base/utf8.hpp"
#include "io/asf.hpp"
#include "io/parse_text.hpp"
#include "io/y_up.hpp"
#include "motion/clip.hpp"

namespace fragmotion {
namespace {

class AmcReader {
 public:
  AmcReader(std::string text, const std::string& file, const AsfModel& model)
      : reader_(std::move(text), file, kAcclaimComment),
        model_(model),
        radians_(model.radians),
        seen_(model.bones.size(), 0) {
    for (const AsfBone& bone : model.bones) {
      indices_.emplace(bone.name, static_cast<int>(axes_.size()));
      axes_.push_back(bone.axis());
    }
  }

  void read_into(Take& take) {
    read_header();
    reserve(take);
    while (!reader_.peek().empty()) {
      read_frame_number(take.frames);
      append_rest_pose(take);
      ++take.frames;
      read_frame(take);
    }
    if (take.frames == 0) reader_.fail("no frames");
  }

 private:
  void read_header() {
    while (!reader_.peek().empty() && reader_.peek().front() == ':') {
      const std::string_view word = reader_.word();
      if (same_word(word, ":degrees")) radians_ = radians_from_degrees(1);
      if (same_word(word, ":radians")) radians_ = 1;
      reader_.skip_to_line_end();
    }
  }

  /// Frames tell nothing of bones without dofs: they are counted before memory is taken for all bones.
  void reserve(Take& take) {
    const TextReader::Place first = reader_.place();
    std::size_t frames = 0;
    for (auto word = reader_.word(); !word.empty(); word = reader_.word()) {
      if (parse_integer(word)) ++frames;
      reader_.skip_to_line_end();
    }
    reader_.go_back(first);
    reader_.check_poses(frames, model_.bones.size());
    take.translations.reserve(frames * model_.bones.size() * 3);
    take.rotations.reserve(frames * model_.bones.size() * 4);
  }

  /// Frames may begin at any number, but a gap would change the motion's speed.
  void read_frame_number(int frames_before) {
    const std::string_view word = reader_.word();
    const std::optional<long long> number = parse_integer(word);
    if (!number || *number < 0 || *number > std::numeric_limits<int>::max()) {
      reader_.fail("a frame's number expected, found " + reader_.quoted(word));
    }
    if (frames_before > 0 && *number != frame_number_ + 1LL) {
      reader_.fail("frame " + std::to_string(frame_number_ + 1LL) + " expected, found " + reader_.quoted(word));
    }
    frame_number_ = static_cast<int>(*number);
    frame_line_ = reader_.line();
    reader_.expect_line_end();
  }

  void append_rest_pose(Take& take) const {
    for (const Vector3& offset : model_.skeleton.offsets) {
      take.translations.insert(take.translations.end(), {offset.x(), offset.y(), offset.z()});
      take.rotations.insert(take.rotations.end(), {1, 0, 0, 0});
    }
  }

  void read_frame(Take& take) {
    const std::size_t first = (static_cast<std::size_t>(take.frames) - 1) * model_.bones.size();
    while (is_in_frame()) {
      const int bone = read_bone_name(take.frames);
      read_bone(bone, &take.translations[(first + bone) * 3], &take.rotations[(first + bone) * 4]);
    }
    for (std::size_t bone = 0; bone < model_.bones.size(); ++bone) {
      if (seen_[bone] == take.frames || model_.bones[bone].dofs.empty()) continue;
      reader_.fail_at(frame_line_,
                      "frame " + std::to_string(frame_number_) + " lacks bone '" + model_.bones[bone].name + "'");
    }
  }

  bool is_in_frame() {
    const std::string_view next = reader_.peek();
    return !next.empty() && !parse_integer(next);
  }

  /// `seen_` holds the last frame of each bone, so that nothing is cleared between frames.
  int read_bone_name(int frame) {
    const std::string_view word = reader_.word();
    const auto found = indices_.find(std::string(word));
    if (found == indices_.end()) reader_.fail("bone " + reader_.quoted(word) + " is not in the skeleton");
    if (seen_[found->second] == frame) reader_.fail("bone " + reader_.quoted(word) + " appears twice in a frame");
    seen_[found->second] = frame;
    return found->second;
  }

  /// L = C M C^-1: the bone's dofs M act in its axis frame C, the first listed about or along its axis first.
  void read_bone(int index, double* translation, double* rotation) {
    const AsfBone& bone = model_.bones[index];
    Vector3 moved = Vector3::Zero();
    Quaternion turned = Quaternion::Identity();
    for (std::size_t i = 0; i < bone.dofs.size(); ++i) {
      const double value = read_value(bone, i);
      const int dof = bone.dofs[i];
      if (dof < 3) {
        moved[dof] = value;
      } else {
        turned = axis_rotation(dof - 3, radians_ * value) * turned;
      }
    }
    if (!reader_.word_in_line().empty()) fail_values(bone, "more");
    const Quaternion& axis = axes_[index];
    // The root's position is told in the world's axes, not in its own.
    if (index > 0) moved = axis * moved;
    const Vector3 place = load_vector(translation) + model_.unit * z_up_from_y_up(moved);
    store_vector(place, translation);
    store_quaternion(z_up_from_y_up((axis * turned * axis.conjugate()).normalized()), rotation);
  }

  double read_value(const AsfBone& bone, std::size_t values_before) {
    const std::string_view word = reader_.word_in_line();
    if (word.empty()) fail_values(bone, std::to_string(values_before));
    return reader_.to_number(word, "a number");
  }

  [[noreturn]] void fail_values(const AsfBone& bone, const std::string& held) const {
    reader_.fail("bone '" + bone.name + "' holds " + held + " values, " + std::to_string(bone.dofs.size()) +
                 " expected");
  }

  TextReader reader_;
  const AsfModel& model_;
  double radians_;
  std::vector<Quaternion> axes_;
  std::unordered_map<std::string, int> indices_;
  std::vector<int> seen_;
  int frame_number_ = 0;
  int frame_line_ = 0;
};

AsfModel read_asf_model(const std::filesystem::path& path) {
  return parse_asf(read_file(path), path.filename().u8string());
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::string lower_stem(const std::filesystem::path& path) { return lower(path.stem().u8string()); }

std::vector<std::filesystem::path> skeletons_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::filesystem::path& path = entry.path();
    const bool hidden = path.filename().u8string().rfind('.', 0) == 0;
    if (!hidden && lower(path.extension().u8string()) == ".asf" && entry.is_regular_file(error)) found.push_back(path);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::filesystem::path find_asf(const std::filesystem::path& amc) {
  const std::vector<std::filesystem::path> skeletons = skeletons_in(amc.has_parent_path() ? amc.parent_path() : ".");
  const std::string whole = lower_stem(amc), subject = whole.substr(0, whole.find('_'));
  for (const std::filesystem::path& path : skeletons) {
    const std::string stem = lower_stem(path);
    if (stem == subject || stem == whole) return path;
  }
  if (skeletons.size() == 1) return skeletons.front();
  throw std::invalid_argument(as_utf8(amc.filename().u8string()) + ": its skeleton " + as_utf8(subject) +
                              ".asf is not in the folder");
}

Take parse_amc(std::string text, const std::string& file, const AsfModel& model, double rate) {
  Take take;
  take.skeleton = model.skeleton;
  take.unit = model.unit;
  take.rate = rate;
  AmcReader(std::move(text), file, model).read_into(take);
  return take;
}

Skeleton read_asf(const std::filesystem::path& path) { return read_asf_model(path).skeleton; }

Take read_asf_amc(const std::filesystem::path& asf, const std::filesystem::path& amc, double rate) {
  if (!(rate >= kLowestRate && rate <= kHighestRate))
    throw std::invalid_argument("rate: 0.1 to 10000 frames a second expected");
  const AsfModel model = read_asf_model(asf);
  Take take = parse_amc(read_file(amc), amc.filename().u8string(), model, rate);
  take.name = as_utf8(amc.stem().u8string());
  return take;
}

}  // namespace fragmotion
