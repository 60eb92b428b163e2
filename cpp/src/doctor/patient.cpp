// SPDX-License-Identifier: MIT
#include "doctor/patient.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace fragmotion {
namespace {

bool are_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

void append_row(const std::vector<double>& from, std::size_t row, std::size_t width, std::vector<double>& to) {
  const auto first = from.begin() + static_cast<std::ptrdiff_t>(row * width);
  to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(width));
}

}  // namespace

Patient::Patient(Take take) : take_(std::move(take)), sources_(take_.frames) {
  std::iota(sources_.begin(), sources_.end(), 0);
  roles_ = find_role_map(take_.skeleton, nullptr, Sides::of_the_names);
  find_parts();
  look();
}

void Patient::find_parts() {
  constexpr Side kSides[] = {Side::kLeft, Side::kRight};
  for (int side = 0; side < 2; ++side) {
    const auto bone = [&](Role role) { return roles_.bone(role, kSides[side]); };
    legs[side] = {bone(Role::kThigh), bone(Role::kShin), bone(Role::kFoot)};
    arms[side] = {bone(Role::kUpperArm), bone(Role::kLowerArm), bone(Role::kHand)};
    toes[side] = bone(Role::kToe);
    for (int joint = 0; joint < bones(); ++joint) {
      if (take_.skeleton.is_below(joint, legs[side].end)) feet[side].push_back(joint);
    }
  }
  hips = roles_.bone(Role::kHips);
  skull = roles_.bone(Role::kHead);
}

void Patient::look() {
  finite_ = are_finite(take_.translations) && are_finite(take_.rotations);
  stature_ = fragmotion::stature(take_.skeleton);
  world_transforms(take_, positions_, rotations_);
}

void Patient::become(Take take) {
  take_ = std::move(take);
  look();
}

void Patient::become(Take take, const std::vector<int>& frames) {
  std::vector<int> sources;
  for (const int frame : frames) sources.push_back(sources_[frame]);
  sources_ = std::move(sources);
  become(std::move(take));
}

Vector3 Patient::tip(int frame, int bone) const {
  return head(frame, bone) + load_quaternion(&rotations_[at(frame, bone) * 4]) * take_.skeleton.tips[bone];
}

Vector3 Patient::toe_direction(int frame, int side) const {
  const int foot = legs[side].end;
  return (toes[side] >= 0 ? head(frame, toes[side]) : tip(frame, foot)) - head(frame, foot);
}

double Patient::step(int frame) const {
  double sum = 0;
  for (int b = 0; b < bones(); ++b) sum += (head(frame, b) - head(frame - 1, b)).norm();
  return sum / bones();
}

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

Take frames_of(const Take& take, const std::vector<int>& frames) {
  const std::size_t bones = take.skeleton.names.size();
  Take result{take.skeleton, take.name, take.rate, static_cast<int>(frames.size()), {}, {}, take.unit};
  for (const int frame : frames) {
    append_row(take.translations, frame, 3 * bones, result.translations);
    append_row(take.rotations, frame, 4 * bones, result.rotations);
  }
  return result;
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
