// SPDX-License-Identifier: MIT
#include "retarget/drives.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/decompositions.hpp"
#include "base/rounding.hpp"
#include "retarget/posture.hpp"
#include "skeleton/same_skeleton.hpp"

namespace fragmotion {
namespace {

// Bones along a chain that is driven as one, and where they are on it: 0 is where it begins, 1 its end.
struct Chain {
  std::vector<int> bones;
  std::vector<double> places;

  void add(int bone, double place) {
    bones.push_back(bone);
    places.push_back(place);
  }
};

double apart(const PosedBones& rest, int a, int b) { return (rest.heads[a] - rest.heads[b]).norm(); }

std::vector<double> shares(std::vector<double> lengths) {
  for (std::size_t i = 1; i < lengths.size(); ++i) lengths[i] += lengths[i - 1];
  const double whole = lengths.empty() ? 0 : lengths.back();
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    lengths[i] = whole > 0 ? lengths[i] / whole : (static_cast<double>(i) + 1) / static_cast<double>(lengths.size());
  }
  return lengths;
}

// From the hips, where it begins, to the head of the last bone of the spine.
Chain spine_of(const Body& body) {
  const PosedBones rest = rest_posture(body.skeleton());
  Chain chain;
  chain.bones = body.map.chain(Role::kSpine);
  std::vector<double> lengths;
  int last = body.map.bone(Role::kHips);
  for (const int bone : chain.bones) lengths.push_back(apart(rest, bone, std::exchange(last, bone)));
  chain.places = shares(lengths);
  return chain;
}

// From the first bone of the neck to the head, each bone where its middle is.
Chain neck_of(const Body& body) {
  const PosedBones rest = rest_posture(body.skeleton());
  const int head = body.map.bone(Role::kHead);
  Chain chain;
  chain.bones = body.map.chain(Role::kNeck);
  if (head < 0) return {};
  std::vector<double> lengths;
  for (std::size_t i = 0; i < chain.bones.size(); ++i) {
    lengths.push_back(apart(rest, chain.bones[i], i + 1 < chain.bones.size() ? chain.bones[i + 1] : head));
  }
  const std::vector<double> ends = shares(lengths);
  for (std::size_t i = 0; i < ends.size(); ++i) chain.places.push_back((ends[i] + (i > 0 ? ends[i - 1] : 0)) / 2);
  return chain;
}

Chain finger_of(const Body& body, Side side, int finger) {
  Chain chain;
  for (const RoleBone& bone : body.map.bones) {
    if (bone.role == Role::kFinger && bone.side == side && bone.finger == finger) chain.bones.push_back(bone.bone);
  }
  chain.places = shares(std::vector<double>(chain.bones.size(), 1));
  return chain;
}

// Puts each of some bones at the place of one of more, the nearest that leaves one for each: so that there and back
// again nothing is lost.
void snap(const Chain& more, Chain& some) {
  std::size_t end = more.places.size();
  for (std::size_t i = some.places.size(); i-- > 0;) {
    const auto off = [&](std::size_t k) { return std::abs(more.places[k] - some.places[i]); };
    std::size_t best = --end;
    for (std::size_t k = i; k < end; ++k) {
      if (off(k) < off(best)) best = k;
    }
    some.places[i] = more.places[best];
    end = best;
  }
}

class Drives {
 public:
  Drives(const Body& source, const Body& target) : source_(source), target_(target) {}

  std::vector<Drive> all() {
    single(Role::kHips, Side::kNone);
    spread(spine_of(source_), source_.map.bone(Role::kHips), spine_of(target_));
    necks();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      for (const Role role :
           {Role::kShoulder, Role::kUpperArm, Role::kLowerArm, Role::kHand, Role::kThigh, Role::kShin, Role::kFoot}) {
        single(role, side);
      }
      toes(side);
      for (int finger = 0; finger < 5; ++finger) fingers(side, finger);
    }
    std::sort(drives_.begin(), drives_.end(), [](const Drive& a, const Drive& b) { return a.bone < b.bone; });
    return std::move(drives_);
  }

 private:
  Lead lead(int from, int bone) const { return {from, source_.reference[from].conjugate() * target_.reference[bone]}; }

  void single(int from, int bone) {
    if (from >= 0 && bone >= 0) drives_.push_back({bone, lead(from, bone), {}, 0});
  }
  void single(Role role, Side side) { single(source_.map.bone(role, side), target_.map.bone(role, side)); }

  static Chain with_start(Chain chain, int start) {
    chain.bones.insert(chain.bones.begin(), start);
    chain.places.insert(chain.places.begin(), 0);
    return chain;
  }

  // The source's chain begins with a bone before it, which the target's has not.
  void spread(Chain from, int start, Chain to) {
    if (from.bones.size() > to.bones.size()) {
      snap(from, to);
    } else {
      snap(to, from);
    }
    if (from.bones.empty()) return;
    from = with_start(std::move(from), start);
    for (std::size_t i = 0; i < to.bones.size(); ++i) between(from, to.bones[i], to.places[i]);
  }

  void between(const Chain& from, int bone, double place) {
    std::size_t next = 1;
    while (next + 1 < from.places.size() && from.places[next] < place) ++next;
    const double begin = from.places[next - 1], length = from.places[next] - begin,
                 weight = length > 0 ? std::clamp((place - begin) / length, 0.0, 1.0) : 1;
    if (weight == 1) return single(from.bones[next], bone);
    drives_.push_back({bone, lead(from.bones[next - 1], bone), lead(from.bones[next], bone), weight});
  }

  // From the chest to the head, which the source must have, beyond the neck.
  void necks() {
    const int head = source_.map.bone(Role::kHead);
    if (head < 0) return;
    const std::vector<int> spine = source_.map.chain(Role::kSpine);
    Chain from = neck_of(source_), to = neck_of(target_);
    from.add(head, 1);
    to.add(target_.map.bone(Role::kHead), 1);
    if (to.bones.back() >= 0) spread(from, spine.empty() ? source_.map.bone(Role::kHips) : spine.back(), to);
  }

  void toes(Side side) {
    const std::vector<int> from = source_.map.chain(Role::kToe, side), to = target_.map.chain(Role::kToe, side);
    for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) single(from[i], to[i]);
  }

  void fingers(Side side, int finger) {
    const int hand = source_.map.bone(Role::kHand, side);
    if (hand >= 0) spread(finger_of(source_, side, finger), hand, finger_of(target_, side, finger));
  }

  const Body& source_;
  const Body& target_;
  std::vector<Drive> drives_;
};

// Where the bones that have roles hang on each other: in the frame of each, what hangs on it.
class Shape {
 public:
  explicit Shape(const Body& body) : rest_(rest_posture(body.skeleton())) {
    for (const RoleBone& bone : body.map.bones) {
      if (bone.role != Role::kRoot) names_.emplace_back(role_label(bone), bone.bone);
    }
    std::sort(names_.begin(), names_.end());
    hung_.resize(names_.size());
    for (std::size_t i = 0; i < names_.size(); ++i) hang(body.skeleton(), i);
  }

  bool alike(const Shape& other, double scale, double tolerance) const {
    if (names_.size() != other.names_.size()) return false;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i].first != other.names_[i].first || !alike(i, other, scale, tolerance)) return false;
    }
    return true;
  }

  /// The source's bone as the target's sees it, by what hangs on them; near a guess where that leaves a choice.
  Quaternion turn(int bone, const Shape& other, const Quaternion& guess) const {
    const auto named = [&](const auto& name) { return name.second == bone; };
    const std::size_t i = std::find_if(names_.begin(), names_.end(), named) - names_.begin();
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < hung_[i].size(); ++k) sum += place(i, k) * other.place(i, k).transpose();
    sum += 1e-6 * sum.norm() * guess.toRotationMatrix();
    if (sum.norm() == 0) return guess;
    return nearest_rotation(sum);
  }

  /// Whether the bodies also rest alike.
  bool rest_alike(const Shape& other, double scale, double tolerance) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const Vector3 mine = rest_.heads[names_[i].second] - rest_.heads[names_[0].second],
                    theirs = other.rest_.heads[other.names_[i].second] - other.rest_.heads[other.names_[0].second];
      if ((scale * mine - theirs).norm() > tolerance) return false;
    }
    return true;
  }
  const Quaternion& rest(int bone) const { return rest_.rotations[bone]; }

 private:
  void hang(const Skeleton& skeleton, std::size_t i) {
    int above = skeleton.parents[names_[i].second];
    const auto named = [&](const auto& name) { return name.second == above; };
    while (above >= 0) {
      const auto found = std::find_if(names_.begin(), names_.end(), named);
      if (found != names_.end()) return hung_[found - names_.begin()].push_back(i);
      above = skeleton.parents[above];
    }
  }

  Vector3 place(std::size_t i, std::size_t k) const {
    const int bone = names_[i].second, child = names_[hung_[i][k]].second;
    return rest_.rotations[bone].conjugate() * (rest_.heads[child] - rest_.heads[bone]);
  }

  bool alike(std::size_t i, const Shape& other, double scale, double tolerance) const {
    if (hung_[i] != other.hung_[i]) return false;
    for (std::size_t k = 0; k < hung_[i].size(); ++k) {
      if (std::abs(scale * place(i, k).norm() - other.place(i, k).norm()) > tolerance) return false;
      for (std::size_t l = 0; l < k; ++l) {
        const double mine = scale * (place(i, k) - place(i, l)).norm(),
                     theirs = (other.place(i, k) - other.place(i, l)).norm();
        if (std::abs(mine - theirs) > tolerance) return false;
      }
    }
    return true;
  }

  PosedBones rest_;
  std::vector<std::pair<std::string, int>> names_;  // of roles, and their bones
  std::vector<std::vector<std::size_t>> hung_;      // which of the names hang on each
};

}  // namespace

bool same_body(const Body& source, const Body& target) {
  return Shape(source).alike(Shape(target), target.leg / source.leg, kFileRounding * target.leg);
}

std::vector<Drive> find_drives(const Body& source, const Body& target) {
  std::vector<Drive> drives = Drives(source, target).all();
  if (!same_body(source, target)) return drives;
  const Shape from(source), to(target);
  const bool rest_alike = from.rest_alike(to, target.leg / source.leg, kFileRounding * target.leg);
  for (Drive& drive : drives) {
    Lead& lead = drive.first;
    if (rest_alike) lead.turn = from.rest(lead.bone).conjugate() * to.rest(drive.bone);
    lead.turn = from.turn(lead.bone, to, lead.turn);
  }
  return drives;
}

}  // namespace fragmotion
