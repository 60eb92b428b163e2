// SPDX-License-Identifier: MIT
#include "io/bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "base/read_file.hpp"
#include "base/rounding.hpp"
#include "base/text_reader.hpp"
#include "base/utf8.hpp"
#include "io/file_unit.hpp"
#include "io/parse_text.hpp"
#include "io/y_up.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {
namespace {

constexpr double kEndSiteShare = 0.3;  // Of a bone's own offset: the length of a bone whose End Site has none.

constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

/// A joint as the file tells it: y up, in file units. Channels are indices into kChannelNames.
struct Joint {
  std::string name;
  int parent = -1;
  std::optional<Vector3> offset;
  std::optional<std::vector<int>> channels;
  std::optional<Vector3> end_site;
};

/// The common frame rate nearest to 1/frame_time where it is within the rounding of a file, else 1/frame_time.
double frame_rate(double frame_time) {
  constexpr std::array kRates = {10.0, 12.0, 12.5, 15.0, 20.0, 24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 72.0, 75.0, 80.0,
                                 90.0, 100.0, 120.0, 125.0, 144.0, 150.0, 160.0, 180.0, 200.0, 240.0, 250.0, 300.0,
                                 360.0, 400.0, 480.0, 500.0, 960.0, 1000.0,
                                 // The rates of television: 23.976, 29.97, ...
                                 24.0 / 1.001, 30.0 / 1.001, 48.0 / 1.001, 60.0 / 1.001, 120.0 / 1.001, 240.0 / 1.001};
  const double rate = 1 / frame_time;
  const double nearest = *std::min_element(
      kRates.begin(), kRates.end(), [rate](double a, double b) { return std::abs(a - rate) < std::abs(b - rate); });
  return std::abs(nearest - rate) <= kFileRounding * nearest ? nearest : rate;
}

class BvhReader {
 public:
  BvhReader(std::string text, const std::string& file, double unit) : reader_(std::move(text), file), unit_(unit) {}

  Take read() {
    read_hierarchy();
    Take take;
    take.skeleton = build_skeleton();
    take.unit = unit_;
    read_motion(take);
    return take;
  }

 private:
  void read_hierarchy() {
    reader_.expect("HIERARCHY");
    reader_.expect("ROOT");
    open_joint();
    while (current_ >= 0) read_joint_entry();
    if (same_word(reader_.peek(), "ROOT")) {
      reader_.fail("more than one ROOT: one skeleton a file is expected, so put each into a file of its own");
    }
  }

  void open_joint() {
    reader_.check_bones(joints_.size());
    Joint joint;
    joint.name = read_joint_name();
    joint.parent = current_;
    if (!names_.insert(joint.name).second) {
      reader_.fail("joint '" + joint.name + "' appears twice: give one of them another name");
    }
    reader_.expect("{");
    current_ = static_cast<int>(joints_.size());
    joints_.push_back(std::move(joint));
  }

  /// The words up to the line's end or its brace: Biped's names hold blanks.
  std::string read_joint_name() {
    std::string name;
    while (!reader_.peek_in_line().empty() && reader_.peek_in_line() != "{") {
      if (!name.empty()) name += ' ';
      name += reader_.word_in_line();
    }
    reader_.check_name(name);
    if (name.empty()) reader_.fail("a joint's name expected, found " + reader_.quoted(reader_.peek_in_line()));
    return name;
  }

  void read_joint_entry() {
    const std::string_view word = reader_.word();
    if (same_word(word, "OFFSET")) {
      joints_[current_].offset = reader_.vector("a number of the OFFSET");
    } else if (same_word(word, "CHANNELS")) {
      read_channels(joints_[current_]);
    } else if (same_word(word, "JOINT")) {
      open_joint();
    } else if (same_word(word, "End")) {
      read_end_site();
    } else if (word == "}") {
      close_joint();
    } else if (word.empty()) {
      reader_.fail("the file ends inside joint '" + joints_[current_].name + "', '}' expected");
    } else {
      reader_.fail("OFFSET, CHANNELS, JOINT, End Site or '}' expected, found " + reader_.quoted(word));
    }
  }

  void close_joint() {
    const Joint& joint = joints_[current_];
    if (!joint.offset) reader_.fail("joint '" + joint.name + "' has no OFFSET");
    if (!joint.channels) reader_.fail("joint '" + joint.name + "' has no CHANNELS");
    current_ = joint.parent;
  }

  void read_end_site() {
    read_joint_name();  // "Site"
    reader_.expect("{");
    reader_.expect("OFFSET");
    joints_[current_].end_site = reader_.vector("a number of the OFFSET");
    reader_.expect("}");
  }

  void read_channels(Joint& joint) {
    if (joint.channels) reader_.fail("joint '" + joint.name + "' has CHANNELS twice");
    const std::string_view announced = reader_.word_in_line();
    const std::optional<long long> count = parse_integer(announced);
    if (!count || *count < 0 || *count > 6) {
      reader_.fail("a number of channels from 0 to 6 expected, found " + reader_.quoted(announced));
    }
    std::vector<int> channels;
    while (!reader_.peek_in_line().empty()) channels.push_back(read_channel());
    if (static_cast<long long>(channels.size()) != *count) {
      reader_.fail("joint '" + joint.name + "' announces " + std::to_string(*count) + " channels and names " +
                   std::to_string(channels.size()));
    }
    channel_count_ += channels.size();
    joint.channels = std::move(channels);
  }

  int read_channel() {
    const std::string_view word = reader_.word_in_line();
    for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
      if (same_word(word, kChannelNames[i])) return static_cast<int>(i);
    }
    reader_.fail("unknown channel " + reader_.quoted(word) + ", Xposition or Zrotation or the like expected");
  }

  Skeleton build_skeleton() const {
    Skeleton skeleton;
    for (const Joint& joint : joints_) {
      skeleton.names.push_back(joint.name);
      skeleton.parents.push_back(joint.parent);
      skeleton.rest_rotations.push_back(Quaternion::Identity());
      skeleton.offsets.emplace_back(unit_ * z_up_from_y_up(*joint.offset));
    }
    skeleton.tips = find_tips(skeleton);
    return make_skeleton(std::move(skeleton));
  }

  std::vector<Vector3> find_tips(const Skeleton& skeleton) const {
    std::vector<Vector3> tips(joints_.size(), Vector3::Zero());
    std::vector<int> children(joints_.size(), 0);
    for (std::size_t i = 1; i < joints_.size(); ++i) {
      tips[joints_[i].parent] += skeleton.offsets[i];
      ++children[joints_[i].parent];
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      tips[i] = children[i] > 0 ? Vector3(tips[i] / children[i]) : end_tip(joints_[i], skeleton.offsets[i]);
    }
    return tips;
  }

  /// A bone without children ends at its End Site; where that has no length, the bone goes on in the direction from its
  /// parent's head to its own, which at rest is its offset, since all frames are the world's axes.
  Vector3 end_tip(const Joint& joint, const Vector3& offset) const {
    if (!joint.end_site || joint.end_site->isZero(0)) return kEndSiteShare * offset;
    return unit_ * z_up_from_y_up(*joint.end_site);
  }

  void read_motion(Take& take) {
    reader_.expect("MOTION");
    reader_.expect("Frames:");
    const long long announced = read_frame_count();
    reader_.expect("Frame");
    reader_.expect("Time:");
    take.rate = read_rate();
    reserve(take, announced);
    std::vector<double> values(channel_count_);
    for (long long frame = 1; frame <= announced; ++frame) {
      if (reader_.peek().empty()) {
        reader_.fail("the file ends after " + std::to_string(frame - 1) + " frames, " + std::to_string(announced) +
                     " expected: it was cut off, or 'Frames:' tells too many");
      }
      read_frame(frame, values);
      append_frame(values, take);
    }
    take.frames = static_cast<int>(announced);
    if (!reader_.peek().empty()) {
      reader_.fail("more frames than the " + std::to_string(announced) + " expected: 'Frames:' tells too few");
    }
  }

  long long read_frame_count() {
    const std::string_view word = reader_.word_in_line();
    const std::optional<long long> count = parse_integer(word);
    if (!count || *count < 1) reader_.fail("a number of frames from 1 on expected, found " + reader_.quoted(word));
    reader_.expect_line_end();
    return *count;
  }

  double read_rate() {
    const double frame_time = reader_.number("a frame time in seconds");
    if (frame_time <= 0) reader_.fail("a frame time above 0 expected");
    if (frame_time < kShortestFrame || frame_time > kLongestFrame) {
      reader_.fail("a frame time from 0.0001 to 1000 seconds expected");
    }
    reader_.expect_line_end();
    return frame_rate(frame_time);
  }

  /// The announced count may be anything: the bytes that are left bound what the frames can need.
  void reserve(Take& take, long long announced) const {
    const std::size_t bytes_a_frame = 2 * std::max<std::size_t>(channel_count_, 1);
    const std::size_t frames = std::min<unsigned long long>(announced, reader_.bytes_left() / bytes_a_frame + 1);
    reader_.check_poses(frames, joints_.size());
    take.translations.reserve(frames * joints_.size() * 3);
    take.rotations.reserve(frames * joints_.size() * 4);
  }

  void read_frame(long long frame, std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string_view word = reader_.word_in_line();
      if (word.empty()) fail_frame(frame, std::to_string(i));
      values[i] = reader_.to_number(word, "a number");
    }
    if (!reader_.word_in_line().empty()) fail_frame(frame, "more");
  }

  [[noreturn]] void fail_frame(long long frame, const std::string& held) const {
    reader_.fail("frame " + std::to_string(frame) + " holds " + held + " values, " + std::to_string(channel_count_) +
                 " expected" + (reader_.bytes_left() == 0 ? ": the file was cut off in it" : ""));
  }

  void append_frame(const std::vector<double>& values, Take& take) const {
    const double* value = values.data();
    for (const Joint& joint : joints_) {
      Vector3 position = *joint.offset;
      Quaternion rotation = Quaternion::Identity();
      for (const int channel : *joint.channels) {
        if (channel < 3) {
          position[channel] = *value++;
        } else {
          rotation = rotation * axis_rotation(channel - 3, radians_from_degrees(*value++));
        }
      }
      append(unit_ * z_up_from_y_up(position), z_up_from_y_up(rotation.normalized()), take);
    }
  }

  static void append(const Vector3& position, const Quaternion& rotation, Take& take) {
    take.translations.insert(take.translations.end(), {position.x(), position.y(), position.z()});
    take.rotations.insert(take.rotations.end(), {rotation.w(), rotation.x(), rotation.y(), rotation.z()});
  }

  TextReader reader_;
  double unit_;
  std::vector<Joint> joints_;
  std::unordered_set<std::string> names_;
  std::size_t channel_count_ = 0;
  int current_ = -1;  ///< The joint whose braces are open.
};

}  // namespace

Take parse_bvh(std::string text, const std::string& file, double unit) {
  return BvhReader(std::move(text), file, unit).read();
}

Take read_bvh(const std::filesystem::path& path, double unit) {
  check_unit(unit);
  Take take = parse_bvh(read_file(path), path.filename().u8string(), unit);
  take.name = as_utf8(path.stem().u8string());
  return take;
}

}  // namespace fragmotion
