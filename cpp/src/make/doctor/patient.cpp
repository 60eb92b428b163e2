// SPDX-License-Identifier: MIT
#include "doctor/patient.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr int kPoses = 256;     // that are kept: more than any check looks back
constexpr int kPerTick = 1024;  // poses that are worked out from one tick to the next

Take resting_take(const Skeleton& skeleton) {
  Take take{skeleton, "rest", 1, 1, {}, {}};
  take.translations.resize(std::size_t{3} * skeleton.size());
  take.rotations.resize(std::size_t{4} * skeleton.size());
  for (int b = 0; b < skeleton.size(); ++b) {
    store_vector(skeleton.offsets[b], &take.translations[std::size_t{3} * b]);
    store_quaternion(skeleton.rest_rotations[b], &take.rotations[std::size_t{4} * b]);
  }
  return take;
}

bool are_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

// A rotation's axis turns the other way in a mirror.
Quaternion changed(const Eigen::Matrix3d& basis, const Quaternion& q) {
  const Vector3 axis = basis.determinant() * (basis * q.vec());
  return {q.w(), axis.x(), axis.y(), axis.z()};
}

Local mix(const Local& a, const Local& b, double weight) {
  double from[4], to[4], mixed[4];
  store_quaternion(a.rotation, from);
  store_quaternion(b.rotation, to);
  blend_rotations(from, to, weight, 1, mixed);
  return {(1 - weight) * a.place + weight * b.place, load_quaternion(mixed)};
}

}  // namespace

Patient::Patient(const Take& take, Tick tick)
    : Patient(std::shared_ptr<const Take>(std::shared_ptr<void>(), &take), std::move(tick)) {}

Patient::Patient(const Skeleton& skeleton) : Patient(std::make_shared<const Take>(resting_take(skeleton)), {}) {}

Patient::Patient(std::shared_ptr<const Take> file, Tick tick)
    : file_(std::move(file)),
      tick_(std::move(tick)),
      skeleton_(file_->skeleton),
      rate_(file_->rate),
      unit_(file_->unit),
      finite_(are_finite(file_->translations) && are_finite(file_->rotations)),
      shown_(file_->frames),
      is_bridged_(file_->frames),
      poses_(kPoses) {
  for (int f = 0; f < frames(); ++f) shown_[f].frame = f;
  roles_ = find_role_map(skeleton_, nullptr, Sides::of_the_names);
  find_parts();
  find_size();
}

void Patient::find_size() {
  stature_ = fragmotion::stature(skeleton_);
  scale_ = stature_ > 0 ? standard_scale(skeleton_) : 0;
}

void Patient::find_parts() {
  for (const Side side : kSides) add_leg(side, Role::kThigh, Role::kShin, Role::kFoot, Role::kToe);
  for (int side = 0; side < 2; ++side) {
    const auto bone = [&](Role role) { return roles_.bone(role, kSides[side]); };
    arms[side] = {bone(Role::kUpperArm), bone(Role::kLowerArm), bone(Role::kHand)};
    if (bone(Role::kForeFoot) >= 0) add_leg(kSides[side], Role::kForeLeg, Role::kRoot, Role::kForeFoot, Role::kForeToe);
  }
  hips = roles_.bone(Role::kHips);
  for (const Role role : {Role::kSpine, Role::kNeck, Role::kHead}) {
    if (!roles_.chain(role).empty()) skull = roles_.chain(role).back();
  }
}

void Patient::add_leg(Side side, Role top, Role middle, Role end, Role toe) {
  legs.push_back({roles_.bone(top, side), roles_.bone(middle, side), roles_.bone(end, side)});
  toes.push_back(roles_.bone(toe, side));
  feet.emplace_back();
  for (int joint = 0; joint < bones(); ++joint) {
    if (skeleton_.is_below(joint, legs.back().end)) feet.back().push_back(joint);
  }
}

bool Patient::is_finite() const {
  const auto whole = [&](int f) { return are_finite(pose(f).places) && are_finite(pose(f).rotations); };
  if (!finite_) {
    int f = 0;
    while (f < frames() && whole(f)) ++f;
    finite_ = f == frames();
  }
  return *finite_;
}

Vector3 Patient::tip(int frame, int bone) const {
  return head(frame, bone) + load_quaternion(&posed(frame).turns[std::size_t{4} * bone]) * skeleton_.tips[bone];
}

Local Patient::local(int frame, int bone) const {
  const Pose& now = pose(frame);
  return {load_vector(&now.places[std::size_t{3} * bone]), load_quaternion(&now.rotations[std::size_t{4} * bone])};
}

bool Patient::repeats(int frame) const {
  if (frame == 0) return false;
  const Pose &before = pose(frame - 1), &now = pose(frame);
  return before.places == now.places && before.rotations == now.rotations;
}

Vector3 Patient::toe_direction(int frame, int leg) const {
  const int foot = legs[leg].end;
  return (toes[leg] >= 0 ? head(frame, toes[leg]) : tip(frame, foot)) - head(frame, foot);
}

double Patient::step(int frame) const {
  double sum = 0;
  for (int b = 0; b < bones(); ++b) sum += (head(frame, b) - head(frame - 1, b)).norm();
  return sum / bones();
}

const std::optional<Tracks>& Patient::tracks() const {
  if (tracks_ == nullptr) tracks_ = std::make_shared<std::optional<Tracks>>(tracks_of(*this));
  return *tracks_;
}

Take Patient::part(const Run& run) const {
  Take part{skeleton_, file_->name, rate_, run.length(), {}, {}, unit_};
  part.translations.reserve(3 * at(run.length(), 0));
  part.rotations.reserve(4 * at(run.length(), 0));
  for (int f = run.begin; f <= run.end; ++f) {
    const Pose& now = pose(f);
    part.translations.insert(part.translations.end(), now.places.begin(), now.places.end());
    part.rotations.insert(part.rotations.end(), now.rotations.begin(), now.rotations.end());
  }
  return part;
}

void Patient::change_basis(const Eigen::Matrix3d& basis, double scale) {
  const Eigen::Matrix3d matrix = scale * basis;
  const auto change = [&](Vector3& v) { v = matrix * v; };
  for (Vector3& offset : skeleton_.offsets) change(offset);
  for (Vector3& tip : skeleton_.tips) change(tip);
  for (Quaternion& rest : skeleton_.rest_rotations) rest = changed(basis, rest);
  for (auto& [key, value] : bridged_) value = {matrix * value.place, changed(basis, value.rotation)};
  change(way_);
  basis_ = basis * basis_;
  matrix_ = matrix * matrix_;
  turned_ = true;
  unit_ *= scale;
  find_size();
  forget();
}

void Patient::bridge(int bone, const Run& run) {
  const bool before = run.begin > 0, after = run.end + 1 < frames();
  const Local rest{skeleton_.offsets[bone], skeleton_.rest_rotations[bone]};
  const Local a = before ? local(run.begin - 1, bone) : after ? local(run.end + 1, bone) : rest;
  const Local b = after ? local(run.end + 1, bone) : a;
  for (int f = run.begin; f <= run.end; ++f) {
    assert(shown_[f].weight == 1);
    const int frame = source(f);
    is_bridged_[frame] = 1;
    bridged_[at(frame, bone)] = mix(a, b, static_cast<double>(f - run.begin + 1) / (run.length() + 1));
  }
  forget();
}

void Patient::keep(const std::vector<int>& frames, int copies) {
  std::vector<Shown> kept;
  for (const int f : frames) kept.push_back(shown_[f]);
  shown_ = std::move(kept);
  rate_ /= copies;
  forget();
}

void Patient::fill_in(const std::vector<int>& counts) {
  std::vector<Shown> filled = {shown_[0]};
  for (int f = 1; f < frames(); ++f) {
    const int steps = counts[f] + 1;
    for (int i = 1; i < steps; ++i) filled.push_back({source(f), source(f - 1), static_cast<double>(i) / steps});
    filled.push_back(shown_[f]);
  }
  shown_ = std::move(filled);
  forget();
}

void Patient::move(const Vector3& way) {
  way_ += way;
  forget();
}

void Patient::place(std::vector<CharacterFrame> places) {
  assert(places_.empty() && places.size() == shown_.size());
  places_ = std::move(places);
  forget();
}

// What was worked out of the take as it was.
void Patient::forget() {
  for (Pose& pose : poses_) pose.frame = -1;
  tracks_ = nullptr;
  if (finite_ == false) finite_.reset();
}

const Patient::Pose& Patient::pose(int frame) const {
  Pose& pose = poses_[frame % kPoses];
  if (pose.frame == frame) return pose;
  pose.frame = frame;
  pose.posed = false;
  pose.places.resize(std::size_t{3} * bones());
  pose.rotations.resize(std::size_t{4} * bones());
  for (int b = 0; b < bones(); ++b) {
    const Local local = shown(frame, b);
    store_vector(local.place, &pose.places[std::size_t{3} * b]);
    store_quaternion(local.rotation, &pose.rotations[std::size_t{4} * b]);
  }
  worked_out_ = (worked_out_ + 1) % kPerTick;
  if (worked_out_ == 0 && tick_) tick_();
  return pose;
}

const Patient::Pose& Patient::posed(int frame) const {
  const Pose& pose = this->pose(frame);
  if (pose.posed) return pose;
  Pose& posed = poses_[frame % kPoses];
  posed.heads.resize(pose.places.size());
  posed.turns.resize(pose.rotations.size());
  world_transforms(skeleton_, pose.places.data(), pose.rotations.data(), posed.heads.data(), posed.turns.data());
  posed.posed = true;
  return posed;
}

Local Patient::shown(int frame, int bone) const {
  const Shown& shown = shown_[frame];
  Local local = in_file(shown.frame, bone);
  if (shown.weight < 1) local = mix(in_file(shown.before, bone), local, shown.weight);
  if (bone != 0) return local;
  local.place += way_;
  if (places_.empty()) return local;
  const CharacterFrame& place = places_[frame];
  const Vector2 ground = place.position + Eigen::Rotation2Dd(place.heading) * local.place.head<2>();
  return {{ground.x(), ground.y(), local.place.z()}, place.rotation() * local.rotation};
}

// A bone in a frame of the file, as it is now.
Local Patient::in_file(int frame, int bone) const {
  if (is_bridged_[frame] != 0) {
    const auto found = bridged_.find(at(frame, bone));
    if (found != bridged_.end()) return found->second;
  }
  const Local local{load_vector(&file_->translations[3 * at(frame, bone)]),
                    load_quaternion(&file_->rotations[4 * at(frame, bone)])};
  return turned_ ? Local{matrix_ * local.place, changed(basis_, local.rotation)} : local;
}

Finding found(const char* code, Severity severity, int begin, int end, std::string text) {
  return {code, severity, begin, end, std::move(text), false, false, -1};
}

Finding found(const Patient& patient, const char* code, Severity severity, std::string text) {
  return found(code, severity, 0, patient.frames() - 1, std::move(text));
}

Finding mendable(Finding finding, bool safe) {
  finding.mendable = true;
  finding.safe = safe;
  return finding;
}

}  // namespace fragmotion
