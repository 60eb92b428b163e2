// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "character/character.hpp"
#include "character/policy_archive.hpp"
#include "skeleton/role_names.hpp"

namespace fragmotion {

/// Bytes of memory that a file may take beside what is in proportion to it.
constexpr std::size_t kPolicyRoom = 48000000;

/// Bits of one of a fragment's numbers at least, likewise, and how many it has.
constexpr int kFewestOfFragment = 4, kFragmentNumbers = 8;

template <typename Archive, typename V>
void exchange_vector(Archive& a, V& v) {
  for (int i = 0; i < 3; ++i) a.template number<double>(v[i]);
}

template <typename Archive, typename Q>
void exchange_quaternion(Archive& a, Q& q) {
  for (int i = 0; i < 4; ++i) a.template number<double>(q.coeffs()[i]);
}

template <typename Archive, typename S>
void exchange_skeleton(Archive& a, S& s) {
  a.list(s.names, 4, [&](auto& name) { a.text(name); });
  a.template numbers<std::int32_t>(s.parents);
  a.list(s.rest_rotations, 32, [&](auto& q) { exchange_quaternion(a, q); });
  a.list(s.offsets, 24, [&](auto& v) { exchange_vector(a, v); });
  a.list(s.tips, 24, [&](auto& v) { exchange_vector(a, v); });
  for (std::size_t i = 0; i < kRolesOfAll; ++i) a.template number<std::int32_t>(s.roles.*role_names()[i].second);
}

template <typename Archive, typename C>
void exchange_control(Archive& a, C& c) {
  for (auto* value : {&c.x, &c.y, &c.turn, &c.jump}) a.template number<double>(*value);
}

template <typename Archive>
void exchange_poses(Archive& a, PackedPoses& poses) {
  for (auto* values : {&poses.origin, &poses.steps}) {
    for (double& value : *values) a.template number<double>(value);
  }
  a.packed(poses.least);
  a.template numbers<std::uint8_t>(poses.bits);
  a.template numbers<std::uint8_t>(poses.bytes);
  poses.pose_bytes = bytes_for(poses.bits);
}

// The number of a clip's original, or -1 and what the clip has itself.
template <typename Archive>
void exchange_clip(Archive& a, PackedPool& pool, std::size_t number) {
  PackedClip& clip = pool.clips[number];
  a.text(clip.name);
  std::int32_t original = Archive::kReads ? -1 : original_of(pool.clips, number);
  if (a.version >= 4) a.template number<std::int32_t>(original);
  if (original < 0) {
    a.template number<double>(clip.rate);
    a.template number<std::int32_t>(clip.frames);
    PackedPoses poses = Archive::kReads ? PackedPoses() : *clip.poses;
    exchange_poses(a, poses);
    if (Archive::kReads) clip.poses = std::make_shared<const PackedPoses>(std::move(poses));
  } else if (Archive::kReads) {
    if (static_cast<std::size_t>(original) >= number || pool.clips[original].mirrored) {
      throw std::invalid_argument("its clips and their mirror images do not fit together");
    }
    clip = mirror_image(pool.clips[original], std::move(clip.name));
  }
}

// Of the pair of feet that begins with a left one, one byte a frame: 1 where that stands, and 2 where the right one
// does.
template <typename Archive>
void exchange_contacts(Archive& a, Contacts& contacts, int first = 0) {
  std::vector<bool>&left = contacts.feet[first], &right = contacts.feet[first + 1];
  std::vector<std::uint8_t> standing;
  for (std::size_t f = 0; f < left.size(); ++f) standing.push_back((left[f] ? 1 : 0) | (right[f] ? 2 : 0));
  a.packed(standing);
  for (const int foot : {first, first + 1}) {
    a.template number<double>(contacts.floors[foot].ball);
    a.template number<double>(contacts.floors[foot].heel);
  }
  if (!Archive::kReads) return;
  left.resize(standing.size());
  right.resize(standing.size());
  for (std::size_t f = 0; f < standing.size(); ++f) {
    left[f] = (standing[f] & 1) != 0;
    right[f] = (standing[f] & 2) != 0;
  }
}

template <typename Archive>
void exchange_clips(Archive& a, PackedPool& pool) {
  PoseGrid grid = pool.clips.empty() ? PoseGrid() : *pool.clips[0].grid;
  a.template number<std::int32_t>(grid.bones);
  a.template numbers<float>(grid.usual);
  a.template numbers<float>(grid.steps);
  if (a.version >= 4) {
    a.template numbers<std::int32_t>(grid.mirror.counterparts);
    a.template numbers<float>(grid.mirror.before);
    a.template numbers<float>(grid.mirror.after);
  }
  const auto shared = std::make_shared<const PoseGrid>(std::move(grid));
  a.list(pool.clips, 8, [&](auto& clip) {
    if (Archive::kReads) clip.grid = shared;
    exchange_clip(a, pool, &clip - pool.clips.data());
  });
}

// Of files of before version 5.
template <typename Archive>
void exchange_each_fragment(Archive& a, std::vector<Fragment>& fragments) {
  a.list(fragments, 45, [&](auto& f) {
    for (auto* value : {&f.clip, &f.begin, &f.end}) a.template number<std::int32_t>(*value);
    a.template number<std::uint8_t>(f.origin);
    exchange_control(a, f.evident);
  });
}

// One number of each fragment, which `get` tells and `set` takes.
template <typename Archive, typename Get, typename Set>
void exchange_column(Archive& a, std::vector<Fragment>& fragments, const Get& get, const Set& set) {
  std::vector<std::int32_t> column;
  if (!Archive::kReads) std::transform(fragments.begin(), fragments.end(), std::back_inserter(column), get);
  a.packed(column, kFewestOfFragment);
  if (column.size() != fragments.size()) throw std::invalid_argument("its fragments do not fit together");
  for (std::size_t i = 0; Archive::kReads && i < column.size(); ++i) set(fragments[i], column[i]);
}

// Of what is no number the least step.
inline std::int32_t steps_of(double value, double step) {
  constexpr double kLeast = std::numeric_limits<std::int32_t>::min(), kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::isnan(value) ? kLeast : std::clamp(std::round(value / step), kLeast, kMost));
}

template <typename Archive>
void exchange_fragments(Archive& a, std::vector<Fragment>& fragments, const ControlSpace& space) {
  a.list(fragments, kFragmentNumbers * kFewestOfFragment / 8, [](auto&) {});
  for (int Fragment::*part : {&Fragment::clip, &Fragment::begin, &Fragment::end}) {
    exchange_column(
        a, fragments, [=](const auto& f) { return f.*part; }, [=](auto& f, int n) { f.*part = n; });
  }
  exchange_column(
      a, fragments, [](const auto& f) { return static_cast<int>(f.origin); },
      [](auto& f, int n) { f.origin = static_cast<Origin>(n); });
  for (double Control::*part : {&Control::x, &Control::y, &Control::turn, &Control::jump}) {
    const double step = space.steps().*part;
    exchange_column(
        a, fragments, [=](const auto& f) { return steps_of(f.evident.*part, step); },
        [=](auto& f, int n) { f.evident.*part = n * step; });
  }
}

// Dis(last pose of Q, first pose of Q'), as transition_distance() tells it, in place of the smoothness.
template <typename Archive>
void exchange_smoothness(Archive& a, std::vector<double>& smoothness) {
  std::vector<double> distances;
  for (const double value : smoothness) distances.push_back(1 / value - 1);
  a.singles(distances);
  if (!Archive::kReads) return;
  smoothness.clear();
  for (const double distance : distances) smoothness.push_back(1 / (1 + distance));
}

// The classes that are left out, which match nothing: what the others match follows from what they are evident of.
template <typename Archive>
void exchange_match(Archive& a, Character& c) {
  std::vector<std::int32_t> left_out;
  const std::size_t controls = c.quality.controls;
  for (std::size_t at = 0; at < c.quality.match.size(); at += controls) {
    if (c.quality.match[at] == 0) left_out.push_back(static_cast<std::int32_t>(at / controls));
  }
  a.packed(left_out);
  if (!Archive::kReads) return;
  const std::size_t classes = c.classes.representatives.size();
  const auto within = [](const std::vector<int>& numbers, std::size_t end) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [=](int n) { return n >= 0 && static_cast<std::size_t>(n) < end; });
  };
  if (c.quality.smoothness.size() != classes * classes || !within(left_out, classes) ||
      !within(c.classes.representatives, c.pool.fragments.size())) {
    throw std::invalid_argument("its classes do not fit together");
  }
  c.quality.match = control_matches(evident_of_classes(c), c.space);
  for (const int k : left_out) leave_out(k, c.quality);
}

template <typename Archive>
void exchange_quality(Archive& a, Character& c) {
  a.template number<std::int32_t>(c.quality.classes);
  if (Archive::kReads) c.quality.controls = c.space.size();
  if (a.version < 5) {
    a.template numbers<double>(c.quality.smoothness);
    a.template numbers<double>(c.quality.match);
  } else {
    exchange_smoothness(a, c.quality.smoothness);
    exchange_match(a, c);
  }
}

// Of a space that is not the paper's, whose two speeds are before it.
template <typename Archive>
void exchange_layout(Archive& a, ControlLayout& layout, std::vector<double>& speeds) {
  a.template numbers<double>(speeds);
  layout.speeds = static_cast<int>(std::min<std::size_t>(speeds.size(), kMostSpeeds + 1));  // more are refused
  a.template number<std::uint8_t>(layout.directions);
  for (bool* part : {&layout.turn, &layout.jump}) a.template number<std::uint8_t>(*part);
}

template <typename Archive>
void exchange_space(Archive& a, ControlSpace& space) {
  ControlLayout layout = space.layout();
  double values[] = {space.slowest(),          space.run(),          space.turn_rate(),   space.scale(),
                     space.weights().velocity, space.weights().turn, space.weights().jump};
  for (double& value : values) a.template number<double>(value);
  std::vector<double> speeds = Archive::kReads ? std::vector{values[0], values[1]} : space.speeds();
  if (a.section("controls", layout != ControlLayout())) exchange_layout(a, layout, speeds);
  if (Archive::kReads) {
    space = ControlSpace(layout, speeds, values[2], values[3], {values[4], values[5], values[6]});
  }
}

template <typename Archive>
void exchange_moves(Archive& a, std::vector<Move>& moves) {
  const auto exchange_move = [&](auto& move) {
    a.text(move.name);
    a.template number<std::int32_t>(move.clip);
    a.template number<std::uint8_t>(move.upper_body);
    a.template number<double>(move.wait);
    a.template number<std::int32_t>(move.loop_begin);
    a.template number<std::int32_t>(move.loop_end);
  };
  a.list(moves, 25, exchange_move, kMostMoves);
}

// Of the pair of legs that begins with a left one; the bones are found anew by their roles.
template <typename Archive>
void exchange_hinges(Archive& a, Legs& legs, int first = 0) {
  for (const int leg : {first, first + 1}) exchange_vector(a, legs[leg].hinge);
}

// All of a style but its skeleton.
template <typename Archive>
void exchange_style(Archive& a, Character& c) {
  exchange_clips(a, c.pool);
  if (a.version < 5) exchange_each_fragment(a, c.pool.fragments);
  exchange_space(a, c.space);
  if (a.version < 5) {
    for (Fragment& f : c.pool.fragments) f.evident = c.space.rounded(f.evident);
  } else {
    exchange_fragments(a, c.pool.fragments, c.space);
  }
  a.template number<std::int32_t>(c.classes.count);
  a.packed(c.classes.labels);
  a.packed(c.classes.representatives);
  a.template number<double>(c.classes.inertia);
  exchange_quality(a, c);
  a.list(c.policies, 16, [&](auto& policy) {
    a.text(policy.name);
    a.template number<std::int32_t>(policy.classes);
    a.packed(policy.next);
    if (Archive::kReads) policy.controls = c.space.size();
  });
  a.packed(c.bridges);
  a.singles(c.control_model);
  a.list(c.contacts, 40, [&](auto& contacts) { exchange_contacts(a, contacts); });
  exchange_hinges(a, c.legs);
}

// One of `copies`, made only where the file has poses of as many bones, which are its share of the memory.
inline void give_skeleton(const Skeleton& skeleton, std::size_t copies, PackedPool& pool) {
  std::size_t names = 0;
  for (const std::string& name : skeleton.names) names += name.size();
  if (names > kPolicyRoom / copies) throw std::invalid_argument("its bones' names are too long for so many styles");
  const std::size_t rotations = pool.clips.empty() ? 0 : pool.clips[0].grid->usual.size();
  for (const std::size_t bones : {skeleton.names.size(), skeleton.parents.size(), skeleton.rest_rotations.size(),
                                  skeleton.offsets.size(), skeleton.tips.size()}) {
    if (rotations < 4 * bones) throw std::invalid_argument("its styles do not fit together");
  }
  pool.skeleton = skeleton;
}

// What the other styles are of a character that has its skeleton.
template <typename Archive>
void exchange_styles(Archive& a, Character& c) {
  a.text(c.style);
  a.list(
      c.styles, 200,
      [&](auto& style) {
        const auto other = Archive::kReads ? std::make_shared<Character>() : std::const_pointer_cast<Character>(style);
        a.text(other->style);
        exchange_style(a, *other);
        if (Archive::kReads) give_skeleton(c.pool.skeleton, c.styles.size(), other->pool);
        style = other;
      },
      kMostStyles - 1);
}

// Of each style's clips but mirror images, which have their originals'.
template <typename Archive>
void exchange_markers(Archive& a, Character& c) {
  for (int style = 0; style < c.style_count(); ++style) {
    std::vector<PackedClip>& clips = const_cast<Character&>(c.in_style(style)).pool.clips;
    for (std::size_t number = 0; number < clips.size(); ++number) {
      std::vector<Marker>& markers = clips[number].markers;
      const int original = original_of(clips, number);
      if (original >= 0) {
        markers = clips[original].markers;
      } else {
        a.list(markers, 12, [&](auto& marker) {
          a.text(marker.name);
          a.template number<double>(marker.frame);
        });
      }
    }
  }
}

// What four-legged bodies have beside their hind legs.
template <typename Archive>
void exchange_fore_legs(Archive& a, Character& c) {
  Roles& roles = c.pool.skeleton.roles;
  for (std::size_t i = kRolesOfAll; i < role_names().size(); ++i)
    a.template number<std::int32_t>(roles.*role_names()[i].second);
  for (int style = 0; style < c.style_count(); ++style) {
    auto& styled = const_cast<Character&>(c.in_style(style));
    styled.pool.skeleton.roles = roles;
    for (Contacts& contacts : styled.contacts) exchange_contacts(a, contacts, 2);
    exchange_hinges(a, styled.legs, 2);
  }
}

// The bones are found anew by their roles.
template <typename Archive>
void exchange_looks_and_arms(Archive& a, Character& c) {
  GazeRange& gaze = c.looks.gaze;
  a.template numbers<float>(c.looks.fastest);
  exchange_vector(a, gaze.forward);
  for (double* angle : {&gaze.turn, &gaze.chest, &gaze.down, &gaze.up}) a.template number<double>(*angle);
  for (ArmRange& range : c.arms) {
    exchange_vector(a, range.arm.hinge);
    a.template number<double>(range.widest);
  }
}

inline bool has_markers(const Character& c) {
  for (int style = 0; style < c.style_count(); ++style) {
    for (const PackedClip& clip : c.in_style(style).pool.clips) {
      if (!clip.markers.empty()) return true;
    }
  }
  return false;
}

/// All that a file holds, in its order.
template <typename Archive>
void exchange(Archive& a, Character& c) {
  exchange_skeleton(a, c.pool.skeleton);
  exchange_style(a, c);
  if (a.version >= 6) exchange_looks_and_arms(a, c);
  if (a.section("moves", !c.moves.empty())) exchange_moves(a, c.moves);
  if (a.section("styles", !c.style.empty())) exchange_styles(a, c);
  if (a.section("markers", has_markers(c))) exchange_markers(a, c);
  if (a.section("fore legs", legs_with_feet(c.pool.skeleton.roles).size() == kMostLegs)) exchange_fore_legs(a, c);
}

}  // namespace fragmotion
