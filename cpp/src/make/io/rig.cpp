// SPDX-License-Identifier: MIT
#include "io/rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/rounding.hpp"
#include "base/take_limits.hpp"
#include "io/rigid_matrix.hpp"
#include "io/shown_feet.hpp"
#include "skeleton/bone_names.hpp"
#include "skeleton/legs_to_ground.hpp"
#include "skeleton/likely_tips.hpp"
#include "skeleton/role_names.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {

namespace {

std::size_t offset_of(int frame, int bones, int bone) { return static_cast<std::size_t>(frame) * bones + bone; }

std::string frame_label(const std::string& clip, int frame) {
  return "clip '" + clip + "': frame " + std::to_string(frame);
}

Quaternion checked_rotation(const double* wxyz, const std::string& clip, int frame, const std::string& bone) {
  const Quaternion q = load_quaternion(wxyz);
  const double norm = q.norm();
  if (!std::isfinite(norm)) fail(frame_label(clip, frame) + ", " + bone, "the rotation is not finite");
  if (norm < kRounding) fail(frame_label(clip, frame) + ", " + bone, "the rotation is a zero quaternion");
  return q.normalized();
}

Vector3 checked_location(const double* xyz, const std::string& clip, int frame, const std::string& bone) {
  Vector3 location = load_vector(xyz);
  if (!location.allFinite()) fail(frame_label(clip, frame) + ", " + bone, "the location is not finite");
  return location;
}

void check_pose(const Skeleton& skeleton, const double* root_position, const double* rotations, int frame) {
  const std::string label = "pose " + std::to_string(frame);
  if (!(load_vector(root_position).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kFarthestBody))
    fail(label, "the root position is not finite, or more than 1000 km from the origin");
  for (int b = skeleton.roles.hips; b < skeleton.size(); ++b) {
    if (skeleton.is_below(b, skeleton.roles.hips) &&
        !(std::abs(load_quaternion(rotations + 4 * b).norm() - 1) < kFileRounding))
      fail(label + ", bone '" + skeleton.names[b] + "'", "the rotation is not a unit quaternion");
  }
}

/// Successive quaternions on the same side.
void align_rotations(int bones, Channels& channels) {
  for (int f = 1; f < channels.frames; ++f) {
    for (int b = 0; b < bones; ++b) {
      double* now = &channels.rotations[4 * offset_of(f, bones, b)];
      const Quaternion before = load_quaternion(&channels.rotations[4 * offset_of(f - 1, bones, b)]);
      Quaternion q = load_quaternion(now);
      if (q.dot(before) < 0) q.coeffs() *= -1;
      store_quaternion(q, now);
    }
  }
}

/// How much a tree looks like the character: how many of the roles that are given it has, and that its names tell.
std::array<int, 2> count_roles(const Armature& armature, const Skeleton& tree) {
  std::array<int, 2> count{};
  for (const auto& [role, bone] : armature.roles) count[0] += tree.find(bone) >= 0 ? 1 : 0;
  const Roles found = find_roles(tree);
  for (const auto& [name, member] : role_names()) count[1] += found.*member >= 0 ? 1 : 0;
  return count;
}

}  // namespace

// ---- Reading the armature

Rig::Rig(Armature armature)
    : armature_(checked_armature(std::move(armature))),
      rise_(stretch_upwards(armature_.world.data())),
      object_(parse_object(armature_.world.data(), "armature")),
      sizes_(parse_sizes(armature_)),
      rest_(sized(parse_rest(armature_), armature_, sizes_)),
      local_(in_parents(rest_, armature_.parents)),
      held_(parse_held(armature_)),
      hangs_(hanging(armature_)),
      order_(checked_order(armature_, hangs_)),
      kinematics_(make_body(skeleton_bones_)) {}

Rig::Object Rig::parse_object(const double* matrix, const std::string& label) const {
  std::array<double, 16> unstretched{};
  std::copy_n(matrix, unstretched.size(), unstretched.begin());
  for (int column = 0; column < 4; ++column) unstretched[8 + column] /= rise_;
  const RowMajor world(unstretched.data());
  const double scale = uniform_scale(world, column_lengths(RowMajor(matrix)), label);
  return {scale, column_lengths(world) / scale, {world.topRightCorner<3, 1>(), extract_rotation(world, label)}};
}

std::vector<Rig::Rigid> Rig::parse_rest(const Armature& armature) {
  std::vector<Rigid> rest(armature.names.size());
  for (int b = 0; b < static_cast<int>(rest.size()); ++b) {
    const RowMajor matrix(&armature.rest[16 * static_cast<std::size_t>(b)]);
    const std::string label = bone_label(armature, b) + " at rest";
    rest[b] = {matrix.topRightCorner<3, 1>(), extract_rotation(matrix, label)};
    if ((column_lengths(matrix).array() - 1).abs().maxCoeff() > kFileRounding || !is_square(matrix, kFileRounding))
      fail(label, "the matrix scales by " + print_scale(column_lengths(matrix)) + " or shears, expected a rotation");
  }
  return rest;
}

std::vector<Rig::Rigid> Rig::parse_held(const Armature& armature) {
  std::vector<Rigid> held(armature.names.size());
  for (std::size_t b = 0; b < held.size(); ++b) {
    const auto found = armature.held.find(armature.names[b]);
    if (found == armature.held.end()) continue;
    const std::string label = bone_label(armature, static_cast<int>(b));
    held[b] = {checked_location(found->second.data(), "held", 0, label),
               checked_rotation(found->second.data() + 3, "held", 0, label)};
  }
  return held;
}

std::vector<double> Rig::parse_sizes(const Armature& armature) {
  std::vector<double> sizes;
  for (std::size_t b = 0; b < armature.names.size(); ++b) {
    const auto found = armature.sizes.find(armature.names[b]);
    const double own = found == armature.sizes.end() ? 1 : found->second;
    sizes.push_back(armature.parents[b] < 0 ? own : own * sizes[armature.parents[b]]);
  }
  return sizes;
}

/// Bones at rest, each as far from its parent as that is large.
std::vector<Rig::Rigid> Rig::sized(const std::vector<Rigid>& rest, const Armature& armature,
                                   const std::vector<double>& sizes) {
  if (armature.sizes.empty()) return rest;
  std::vector<Rigid> sized = rest;
  for (std::size_t b = 0; b < rest.size(); ++b) {
    const int parent = armature.parents[b];
    if (parent >= 0) sized[b].head = sized[parent].head + sizes[parent] * (rest[b].head - rest[parent].head);
  }
  return sized;
}

std::vector<Rig::Rigid> Rig::in_parents(const std::vector<Rigid>& rest, const std::vector<int>& parents) {
  std::vector<Rigid> local = rest;
  for (std::size_t b = 0; b < rest.size(); ++b) {
    const int parent = parents[b];
    if (parent < 0) continue;
    const Quaternion inverse = rest[parent].rotation.conjugate();
    local[b] = {inverse * (rest[b].head - rest[parent].head), inverse * rest[b].rotation};
  }
  return local;
}

/// The tree below `root` as a skeleton; `members` are its bones.
Skeleton Rig::make_tree(int root, const std::vector<Rigid>& rest, std::vector<int>& members) const {
  Skeleton tree;
  const std::vector<Rigid> local = in_parents(rest, hangs_);
  std::vector<int> index(bones(), -1);
  members.clear();
  for (const int b : order_) {
    const int parent = hangs_[b];
    if (b != root && (parent < 0 || index[parent] < 0)) continue;
    index[b] = tree.size();
    members.push_back(b);
    tree.names.push_back(armature_.names[b]);
    tree.parents.push_back(b == root ? -1 : index[parent]);
    tree.rest_rotations.push_back(local[b].rotation);
    tree.offsets.emplace_back(object_.scale * local[b].head);
    tree.tips.emplace_back(0, object_.scale * sizes_[b] * armature_.lengths[b], 0);
  }
  tree.offsets[0] = object_.rigid.head + object_.rigid.rotation * tree.offsets[0];
  tree.rest_rotations[0] = object_.rigid.rotation * tree.rest_rotations[0];
  return tree;
}

/// The tree with the most roles, given ones first; the one with more bones, or else the first, of equals. A limb of two
/// beside the body is none while there are others.
Skeleton Rig::choose_tree(std::vector<int>& members) const {
  Skeleton best;
  std::tuple best_of(-1, false, -1, -1);
  const std::vector<BoneName> read = read_names(armature_.names);
  for (int root = 0; root < bones(); ++root) {
    if (armature_.parents[root] >= 0) continue;
    std::vector<int> tree_members;
    Skeleton tree = make_tree(root, rest_, tree_members);
    const auto [given, named] = count_roles(armature_, tree);
    const int twin = read[root].counterpart;
    const std::tuple of(given, twin < 0 || armature_.parents[twin] >= 0, named, tree.size());
    if (of <= best_of) continue;
    best = std::move(tree);
    best_of = of;
    members = std::move(tree_members);
  }
  for (const auto& [role, bone] : armature_.roles) {
    if (best.find(bone) < 0)
      fail("role '" + role + "'", "bone '" + bone + "' does not hang on '" + best.names[0] + "'");
  }
  assign_roles(armature_.roles, best);
  return make_skeleton(std::move(best));
}

Skeleton Rig::make_body(std::vector<int>& members) const {
  Skeleton body = choose_tree(members);
  if (!armature_.held.empty()) {
    body = make_tree(members.front(), held_pose(body), members);
    assign_roles(armature_.roles, body);
    body = make_skeleton(std::move(body));
  }
  return with_short_feet(with_legs_to_ground(std::move(body), object_.rigid.head.z()));
}

/// At rest, in the armature's space, but as bones are held; those below the hips are not turned.
std::vector<Rig::Rigid> Rig::held_pose(const Skeleton& skeleton) const {
  std::vector<Rigid> pose(bones());
  for (int b = 0; b < bones(); ++b) {
    const int member = skeleton.find(armature_.names[b]), hips = skeleton.roles.hips;
    const bool turns = member >= 0 && (member == hips || !skeleton.is_below(member, hips));
    pose[b] = moved(b, pose.data(), held_[b].head, turns ? held_[b].rotation : Quaternion::Identity());
  }
  return pose;
}

std::array<double, 16> Rig::carried() const {
  const int hips = skeleton_bones_[skeleton().roles.hips];
  const Rigid held = held_pose(skeleton())[hips];
  const Quaternion turn = held.rotation * rest_[hips].rotation.conjugate();
  const Vector3 head = RowMajor(&armature_.rest[16 * static_cast<std::size_t>(hips)]).topRightCorner<3, 1>();
  std::array<double, 16> matrix{};
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> carried(matrix.data());
  carried.topLeftCorner<3, 3>() = sizes_[hips] * turn.toRotationMatrix();
  carried.topRightCorner<3, 1>() = held.head - sizes_[hips] * (turn * head);
  carried(3, 3) = 1;
  return matrix;
}

// ---- Spaces

Rig::Object Rig::object_at(const std::string& clip, const double* worlds, int frame) const {
  if (worlds == nullptr) return object_;
  const std::string label = frame_label(clip, frame);
  Object object = parse_object(worlds + 16 * static_cast<std::size_t>(frame), label);
  if (std::abs(object.scale - object_.scale) > kFileRounding * object_.scale)
    fail(label, "the object's scale is " + std::to_string(object.scale) + ", at rest it is " +
                    std::to_string(object_.scale) + ": remove the keys on the object's scale");
  return object;
}

Rig::Rigid Rig::to_armature(const Vector3& head, const Quaternion& rotation) const {
  const Quaternion inverse = object_.rigid.rotation.conjugate();
  const Vector3 scaled = inverse * (head - object_.rigid.head) / object_.scale;
  return {scaled.cwiseQuotient(object_.uneven), inverse * rotation};
}

// ---- Forward kinematics as Blender does it (BKE_bone_parent_transform_calc_from_matrices)

/// Where the bone is when its own channels are zero.
Rig::Rigid Rig::unmoved(int bone, const Rigid* pose) const {
  const int parent = armature_.parents[bone];
  if (parent < 0) return rest_[bone];
  return {pose[parent].head + pose[parent].rotation * local_[bone].head,
          armature_.inherit_rotation[bone] ? pose[parent].rotation * local_[bone].rotation : rest_[bone].rotation};
}

/// Local locations follow the parent even where the rotation is not inherited; others are along the parent's own axes,
/// without a parent along the armature's.
Quaternion Rig::location_axes(int bone, const Rigid* pose) const {
  const int parent = armature_.parents[bone];
  const Quaternion above = parent < 0 ? Quaternion::Identity() : pose[parent].rotation;
  return armature_.local_location[bone] ? above * local_[bone].rotation : above;
}

/// Locations are as large as the parent.
double Rig::location_unit(int bone) const {
  const int parent = armature_.parents[bone];
  return parent < 0 ? 1 : sizes_[parent];
}

Rig::Rigid Rig::moved(int bone, const Rigid* pose, const Vector3& location, const Quaternion& rotation) const {
  const Rigid base = unmoved(bone, pose);
  return {base.head + location_unit(bone) * (location_axes(bone, pose) * location),
          (base.rotation * rotation).normalized()};
}

// ---- To clips

Clip Rig::empty_clip(const std::string& name, double rate, int frames) const {
  Clip clip{name, rate, frames, {}, {}, {}};
  clip.root_positions.resize(3 * offset_of(frames, 1, 0));
  clip.rotations.resize(4 * offset_of(frames, skeleton().size(), 0));
  return clip;
}

void Rig::store_pose(const Object& object, const Rigid* pose, int frame, Clip& clip, ShownFeet& feet) const {
  const int hips = skeleton().roles.hips;
  for (int b = hips; b < skeleton().size(); ++b) {
    if (!skeleton().is_below(b, hips)) continue;
    const int bone = skeleton_bones_[b];
    const Quaternion above = b == hips ? object.rigid.rotation : pose[hangs_[bone]].rotation.conjugate();
    store_quaternion(above * pose[bone].rotation, &clip.rotations[4 * offset_of(frame, skeleton().size(), b)]);
  }
  const auto place = [&](const Rigid& bone) {
    return Vector3{object.rigid.head + object.scale * (object.rigid.rotation * bone.head.cwiseProduct(object.uneven))};
  };
  store_vector(place(pose[skeleton_bones_[hips]]), &clip.root_positions[3 * offset_of(frame, 1, 0)]);
  for (int leg = 0; leg < feet.legs().count(); ++leg) {
    const Rigid& foot = pose[skeleton_bones_[feet.legs()[leg].foot]];
    feet.show(frame, leg, place(foot) + object.rigid.rotation * (foot.rotation * feet.legs()[leg].ankle));
  }
}

Clip Rig::clip(const std::string& name, double rate, int frames, const double* locations, const double* rotations,
               const double* worlds) const {
  Clip clip = empty_clip(name, rate, frames);
  ShownFeet feet(kinematics_, frames);
  std::vector<Rigid> pose(bones());
  for (int f = 0; f < frames; ++f) {
    for (const int b : skeleton_bones_) {
      const std::string label = bone_label(armature_, b);
      const std::size_t at = offset_of(f, bones(), b);
      pose[b] = moved(b, pose.data(), checked_location(locations + 3 * at, name, f, label),
                      checked_rotation(rotations + 4 * at, name, f, label));
    }
    store_pose(object_at(name, worlds, f), pose.data(), f, clip, feet);
  }
  feet.keep(clip);
  return make_clip(skeleton(), std::move(clip));
}

Clip Rig::clip_from_matrices(const std::string& name, double rate, int frames, const double* matrices,
                             const double* worlds) const {
  Clip clip = empty_clip(name, rate, frames);
  ShownFeet feet(kinematics_, frames);
  std::vector<Rigid> pose(bones());
  std::vector<Quaternion> turned(bones(), Quaternion::Identity());  // away from rest, as last seen
  std::vector<bool> carries(bones(), false);
  for (const int b : skeleton_bones_) {
    if (hangs_[b] >= 0) carries[hangs_[b]] = true;
  }
  for (int f = 0; f < frames; ++f) {
    for (const int b : skeleton_bones_) {
      const RowMajor matrix(matrices + 16 * offset_of(f, bones(), b));
      const std::string label = frame_label(name, f) + ", " + bone_label(armature_, b);
      const Quaternion above = unmoved(b, pose.data()).rotation;
      if (carries[b] || !is_squashed(matrix)) turned[b] = above.conjugate() * extract_rotation(matrix, label);
      pose[b] = {matrix.topRightCorner<3, 1>(), (above * turned[b]).normalized()};
    }
    store_pose(object_at(name, worlds, f), pose.data(), f, clip, feet);
  }
  feet.keep(clip);
  return make_clip(skeleton(), std::move(clip));
}

// ---- To channels

Channels Rig::resting_channels(int frames) const {
  Channels channels{frames, {}, {}};
  channels.locations.resize(3 * offset_of(frames, bones(), 0));
  channels.rotations.resize(4 * offset_of(frames, bones(), 0));
  for (std::size_t at = 0; at < channels.locations.size() / 3; ++at) {
    const Rigid& held = held_[at % held_.size()];
    store_vector(held.head, &channels.locations[3 * at]);
    store_quaternion(held.rotation, &channels.rotations[4 * at]);
  }
  return channels;
}

void Rig::store_rotation(int bone, const Rigid* pose, int frame, Channels& channels) const {
  const Quaternion q = unmoved(bone, pose).rotation.conjugate() * pose[bone].rotation;
  store_quaternion(q.normalized(), &channels.rotations[4 * offset_of(frame, bones(), bone)]);
}

void Rig::store_location(int bone, const Rigid* pose, int frame, Channels& channels) const {
  const Vector3 shift = (pose[bone].head - unmoved(bone, pose).head) / location_unit(bone);
  store_vector(location_axes(bone, pose).conjugate() * shift, &channels.locations[3 * offset_of(frame, bones(), bone)]);
}

Channels Rig::channels(int frames, const double* root_positions, const double* rotations) const {
  Channels channels = resting_channels(frames);
  const int size = skeleton().size();
  std::vector<Vector3> heads(size);
  std::vector<Quaternion> orientations(size);
  std::vector<Rigid> pose(bones());
  for (int f = 0; f < frames; ++f) {
    const double* root_position = root_positions + 3 * offset_of(f, 1, 0);
    const double* local = rotations + 4 * offset_of(f, size, 0);
    check_pose(skeleton(), root_position, local, f);
    kinematics_.world(load_vector(root_position), local, heads.data(), orientations.data());
    for (int b = 0; b < size; ++b) {
      const int bone = skeleton_bones_[b];
      pose[bone] = to_armature(heads[b], orientations[b]);
      store_rotation(bone, pose.data(), f, channels);
      const bool is_moved = hangs_[bone] != armature_.parents[bone] || !held_[bone].head.isZero(0);
      if (b == 0 || b == skeleton().roles.hips || is_moved)
        store_location(bone, pose.data(), f, channels);
      else
        pose[bone].head = unmoved(bone, pose.data()).head;
    }
  }
  align_rotations(bones(), channels);
  return channels;
}

/// For each of the armature's bones the take's of the same name, or -1.
std::vector<int> Rig::match_take(const Take& take) const {
  std::vector<int> found(bones(), -1);
  std::string missing;
  for (int b = 0; b < take.skeleton.size(); ++b) {
    const auto name = std::find(armature_.names.begin(), armature_.names.end(), take.skeleton.names[b]);
    if (name != armature_.names.end())
      found[name - armature_.names.begin()] = b;
    else
      missing += (missing.empty() ? "'" : ", '") + take.skeleton.names[b] + "'";
  }
  if (!missing.empty()) fail("take '" + take.name + "'", "the armature lacks its bones " + missing);
  return found;
}

Channels Rig::take_channels(const Take& take) const {
  const std::vector<int> found = match_take(take);
  std::vector<Vector3> rest_heads;
  std::vector<Quaternion> take_rest;
  rest_pose(take.skeleton, rest_heads, take_rest);
  std::vector<double> positions, rotations;
  world_transforms(take, positions, rotations);

  const std::vector<Rigid> rest = armature_.held.empty() ? rest_ : held_pose(skeleton());
  Channels channels = resting_channels(take.frames);
  std::vector<Rigid> pose(bones());
  for (int f = 0; f < take.frames; ++f) {
    for (int b = 0; b < bones(); ++b) {
      pose[b] = unmoved(b, pose.data());
      if (found[b] < 0) continue;
      const std::size_t at = offset_of(f, take.skeleton.size(), found[b]);
      const Quaternion away = load_quaternion(&rotations[4 * at]) * take_rest[found[b]].conjugate();
      pose[b] = to_armature(load_vector(&positions[3 * at]), away * object_.rigid.rotation * rest[b].rotation);
      store_rotation(b, pose.data(), f, channels);
      store_location(b, pose.data(), f, channels);
    }
  }
  align_rotations(bones(), channels);
  return channels;
}

}  // namespace fragmotion
