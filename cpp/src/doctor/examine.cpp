// SPDX-License-Identifier: MIT
#include "fragmotion/doctor/examine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "doctor/basis.hpp"
#include "doctor/check.hpp"
#include "doctor/duplicates.hpp"
#include "fragmotion/base/parallel.hpp"

namespace fragmotion {
namespace {

std::string rest_pose_name(const Patient& rest) {
  if (!rest.has_arms()) return "";
  const Vector3 up = standing_axis(rest);
  if (up.isZero(0)) return "other";
  double rise = 0;
  for (const Limb3& arm : rest.arms) {
    const Vector3 way = rest.head(0, arm.end) - rest.head(0, arm.top);
    rise += 0.5 * std::asin(std::clamp(way.normalized().dot(up), -1.0, 1.0)) * 180 / kPi;
  }
  return rise > 20 ? "other" : rise > -20 ? "T" : rise > -65 ? "A" : "down";
}

Examination described(const Patient& patient) {
  const Patient rest(resting_take(patient.take().skeleton));
  Examination told;
  told.up = axis_name(up_axis(patient));
  told.facing = axis_name(front_axis(rest));
  told.rate = patient.rate();
  told.rest_pose = rest_pose_name(rest);
  told.roles = named_bones(patient.take().skeleton, patient.roles());
  return told;
}

/// Finds and tells, and mends the patient as far as it can be, so that the next check sees no fault but its own.
void apply(const Check& check, Patient& patient, Findings& told) {
  const Findings findings = find(check, patient);
  for (const Finding& finding : findings) told.push_back(in_take(patient, finding));
  mend(check, findings, patient);
}

Examination examine(Patient& patient) {
  Findings findings;
  apply(checks().front(), patient, findings);
  Examination told = described(patient);
  const double unit = patient.take().unit;
  for (std::size_t i = 1; i < checks().size(); ++i) apply(checks()[i], patient, findings);
  told.stature = patient.stature();
  told.scale = patient.take().unit / unit;
  told.root_motion =
      std::none_of(findings.begin(), findings.end(), [](const Finding& f) { return f.code == "in_place"; });
  told.findings = std::move(findings);
  return told;
}

}  // namespace

const std::vector<std::string>& finding_codes() {
  static const std::vector<std::string> codes = {
      "missing", "unit", "up",     "mirrored", "facing",   "flip", "spike", "doubled", "frozen", "calibration",
      "dropped", "jump", "ground", "slope",    "in_place", "rate", "size",  "body",    "short",  "duplicate"};
  return codes;
}

std::vector<Examination> examine(const std::vector<Take>& takes, int threads) {
  const int count = static_cast<int>(takes.size());
  std::vector<Examination> told(count);
  std::vector<Outline> outlines(count);
  parallel_for(count, thread_count(threads), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Patient patient(takes[i]);
      told[i] = examine(patient);
      outlines[i] = outline_of(patient);
    }
  });
  find_duplicates(takes, outlines, thread_count(threads), told);
  return told;
}

}  // namespace fragmotion
