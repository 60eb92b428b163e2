// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "character/character.hpp"
#include "skeleton/role_names.hpp"

namespace fragmotion {

/// Makes of a character, that was read, what a stranger's file may hold: all but the part that is changed fits together
/// still, so that most are read again and played.
class Forger {
 public:
  explicit Forger(unsigned seed) : random_(seed) {}

  /// Changes one part.
  void forge(Character& c) {
    switch (below(8)) {
      case 0:
        return forge_skeleton(c);
      case 1:
        return forge_moves(c);
      case 2:
        return forge_styles(c);
      default:
        break;
    }
    const int style = below(c.style_count());
    if (style == 0) return forge_style(c);
    const auto other = std::make_shared<Character>(c.in_style(style));
    forge_style(*other);
    c.styles[style - 1] = other;
  }

 private:
  int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }

  template <typename T>
  T& one_of(std::vector<T>& values) {
    return values[below(static_cast<int>(values.size()))];
  }

  // An index of one of so many, sometimes just outside, seldom far outside.
  void index(int& value, int end) {
    constexpr int kFar[] = {std::numeric_limits<int>::min(), -1000000, 1000000, std::numeric_limits<int>::max()};
    value = below(16) == 0 ? kFar[below(4)] : below(end + 2) - 1;
  }

  void number(double& value) {
    constexpr double kStrange[] = {std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity(),
                                   -1.7e308,
                                   1e150,
                                   1e9,
                                   1e-9,
                                   1e-300,
                                   0};
    constexpr double kTimes[] = {-1, 0.1, 0.5, 0.9, 1.1, 2, 10, 1000};
    if (below(4) == 0) {
      value = kStrange[below(8)];
    } else {
      value = (value == 0 ? 1 : value) * kTimes[below(8)];
    }
  }

  void turn(Vector3& axis) {
    for (int i = 0; i < 3; ++i) axis[i] = below(5) - 2;
    axis = axis.isZero(0) ? Vector3::UnitX() : axis.normalized();
  }

  void forge_skeleton(Character& c) {
    Skeleton& s = c.pool.skeleton;
    const int bone = below(s.size());
    Vector3 axis;
    switch (below(5)) {
      case 0:
        s.parents[bone] = below(bone + 1) - (bone == 0 ? 1 : 0);
        break;
      case 1:
        number((below(2) == 0 ? s.offsets : s.tips)[bone][below(3)]);
        break;
      case 2:
        turn(axis);
        s.rest_rotations[bone] = Eigen::AngleAxisd(below(7), axis);
        break;
      default:
        index(s.roles.*role_names()[below(static_cast<int>(role_names().size()))].second, s.size());
    }
  }

  void forge_moves(Character& c) {
    if (c.moves.empty()) return;
    Move& move = one_of(c.moves);
    const int frames = c.pool.clips[move.clip].frames;
    switch (below(6)) {
      case 0:  // once more
        c.pool.clips.push_back(c.pool.clips[move.clip]);
        c.contacts.push_back(c.contacts[move.clip]);
        c.moves.push_back(Move(move));
        c.moves.back().clip = static_cast<int>(c.pool.clips.size()) - 1;
        break;
      case 1:
        index(move.clip, static_cast<int>(c.pool.clips.size()));
        break;
      case 2:
        move.upper_body = !move.upper_body;
        break;
      case 3:
        number(move.wait);
        break;
      default:
        index(move.loop_end, frames);
        index(move.loop_begin, move.loop_end > 0 && move.loop_end < frames ? move.loop_end : frames);
    }
  }

  void forge_styles(Character& c) {
    if (below(4) == 0 && !c.styles.empty()) {
      c.styles.pop_back();
      return;
    }
    auto other = std::make_shared<Character>(c.in_style(below(c.style_count())));
    other->pool.clips.resize(other->takes());
    other->contacts.resize(other->pool.clips.size());
    other->moves.clear();
    other->styles.clear();
    other->style = std::string("style ") + static_cast<char>('a' + below(8));
    if (c.style.empty()) c.style = "own";
    if (c.styles.size() < 3) c.styles.push_back(other);
  }

  void forge_style(Character& c) {
    switch (below(6)) {
      case 0:
        return forge_clip(c);
      case 1:
        return forge_fragment(c);
      case 2:
        return forge_classes(c);
      case 3:
        return turn(c.legs[below(2)].hinge);
      default:
        return forge_contacts(c);
    }
  }

  void forge_clip(Character& c) {
    PackedClip& clip = one_of(c.pool.clips);
    switch (below(4)) {
      case 0:
        return number(clip.rate);
      case 1:
        clip.mirrored = !clip.mirrored;
        return;
      default:
        return forge_poses(c, clip.poses);
    }
  }

  // Of all clips that share them.
  void forge_poses(Character& c, std::shared_ptr<const PackedPoses> shared) {
    PackedPoses poses = *shared;
    switch (below(4)) {
      case 0:
        number(poses.origin[below(4)]);
        break;
      case 1:
        number(poses.steps[below(4)]);
        break;
      case 2:
        one_of(poses.least) += below(2001) - 1000;
        break;
      default:
        one_of(poses.bytes) = static_cast<std::uint8_t>(below(256));
    }
    const auto forged = std::make_shared<const PackedPoses>(std::move(poses));
    for (PackedClip& clip : c.pool.clips) {
      if (clip.poses == shared) clip.poses = forged;
    }
  }

  void forge_fragment(Character& c) {
    Fragment& f = one_of(c.pool.fragments);
    double* evident[] = {&f.evident.x, &f.evident.y, &f.evident.turn, &f.evident.jump};
    switch (below(3)) {
      case 0:
        return index(f.clip, static_cast<int>(c.pool.clips.size()));
      case 1:
        return index(below(2) == 0 ? f.begin : f.end, c.pool.clips[f.clip].frames);
      default:
        return number(*evident[below(4)]);
    }
  }

  void forge_classes(Character& c) {
    switch (below(5)) {
      case 0:
        return index(one_of(c.classes.labels), c.classes.count);
      case 1:
        return index(one_of(c.policies[0].next), c.classes.count);
      case 2:
        return index(one_of(c.bridges), c.classes.count);
      case 3:
        return number(one_of(c.quality.smoothness));
      default:
        c.policies.push_back(c.policies[0]);
    }
  }

  // Feet that stand for some frames, or that are not.
  void forge_contacts(Character& c) {
    Contacts& contacts = one_of(c.contacts);
    FootHeights& floor = contacts.floors[below(2)];
    const int clip = static_cast<int>(&contacts - c.contacts.data()), frames = c.pool.clips[clip].frames;
    if (below(3) == 0) return number(below(2) == 0 ? floor.ball : floor.heel);
    const int kept = below(8) == 0 ? 0 : frames;  // of both: a file has one number for them
    for (std::vector<bool>& foot : contacts.feet) {
      const int begin = below(frames + 1), end = below(frames + 1);
      foot.assign(kept, below(2) == 0);
      for (int f = begin; f < std::min(end, kept); ++f) foot[f] = !foot[f];
    }
  }

  std::minstd_rand random_;
};

}  // namespace fragmotion
