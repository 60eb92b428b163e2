// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "doctor/basis.hpp"
#include "doctor/check.hpp"
#include "doctor/runs.hpp"

namespace fragmotion {
namespace {

constexpr double kOutOfLine = 5;  // times the steps beside
constexpr double kAtEnd = 3;      // s: where a calibration is looked for
constexpr int kFrameOrTwo = 2;    // of another pose at an end: no motion whatever they are

bool is_torn(const Patient& patient, int frame) {
  const double step = patient.step(frame) * patient.scale();
  double beside = 0;
  for (const int f : {frame - 1, frame + 1}) {
    if (f > 0 && f < patient.frames()) beside = std::max(beside, patient.step(f));
  }
  return step > kOutOfLine * beside * patient.scale() && step * patient.rate() > kOutOfLine * kStill;
}

/// The frames that no body gets to from the one before.
std::vector<int> jumps_of(const Patient& patient) {
  std::set<int> frames;
  if (patient.scale() > 0) {
    for (int f = 1; f < patient.frames(); ++f) {
      if (is_torn(patient, f)) frames.insert(f);
    }
  }
  if (patient.tracks()) frames.insert(patient.tracks()->torn.begin(), patient.tracks()->torn.end());
  return {frames.begin(), frames.end()};
}

/// Whether somebody holds a pose, or the frames are too few to be motion.
bool is_held(const Patient& patient, const Run& run) {
  if (run.length() <= kFrameOrTwo) return true;
  double fastest = 0;
  for (int f = run.begin + 1; f <= run.end; ++f) fastest = std::max(fastest, patient.step(f));
  return fastest * patient.rate() * patient.scale() < kStill;
}

bool is_calibration(const Patient& patient, const Run& run) {
  return run.length() <= kAtEnd * patient.rate() && run.length() < patient.frames() / 2 && is_held(patient, run);
}

bool has_arms_out(const Patient& patient, int frame) {
  Vector3 right = patient.head(frame, patient.arms[1].top) - patient.head(frame, patient.arms[0].top);
  right.normalize();
  for (int side = 0; side < 2; ++side) {
    const Vector3 arm = patient.head(frame, patient.arms[side].end) - patient.head(frame, patient.arms[side].top);
    if (!(arm.normalized().dot(side == 0 ? -right : right) > kNearAxis)) return false;
  }
  return true;
}

bool hips_stand(const Patient& patient, const Run& run) {
  if (patient.hips < 0) return false;
  const Vector3 way = patient.head(run.end, patient.hips) - patient.head(run.begin, patient.hips);
  return way.norm() * patient.scale() < kStill * run.length() / patient.rate();
}

/// The frames at the start, or from the end on, in which the arms are held out.
Run arms_out(const Patient& patient, bool at_start) {
  const int last = patient.frames() - 1;
  int count = 0;
  while (patient.has_arms() && count <= last && has_arms_out(patient, at_start ? count : last - count)) ++count;
  return at_start ? Run{0, count - 1} : Run{last - count + 1, last};
}

Finding calibration(const Run& run, const std::string& why) {
  return mendable(
      found("calibration", Severity::kWarning, run.begin, run.end,
            frames_text(run) + ": " + why + " at this end of the take, not motion to learn from; cut it off"));
}

void add_held_poses(const Patient& patient, Findings& findings) {
  const std::vector<int> jumps = jumps_of(patient);
  if (jumps.empty()) return;
  const Run first{0, jumps.front() - 1}, last{jumps.back(), patient.frames() - 1};
  if (is_calibration(patient, first)) findings.push_back(calibration(first, "a pose for calibration"));
  if (is_calibration(patient, last)) findings.push_back(calibration(last, "a pose for calibration"));
}

void add_arms_out(const Patient& patient, Findings& findings) {
  for (const bool at_start : {true, false}) {
    const Run run = arms_out(patient, at_start);
    const bool told = covers(findings, at_start ? Run{0, 0} : Run{patient.frames() - 1, patient.frames() - 1});
    if (!told && run.length() >= kShortestStep * patient.rate() && run.length() < patient.frames() / 2 &&
        hips_stand(patient, run))
      findings.push_back(calibration(run, "a T pose"));
  }
}

}  // namespace

Findings find_calibration(const Patient& patient) {
  Findings findings;
  add_held_poses(patient, findings);
  add_arms_out(patient, findings);
  return findings;
}

Findings find_jumps(const Patient& patient) {
  std::vector<Run> together;
  for (const int f : jumps_of(patient)) {
    if (f > 1 && patient.step(f - 1) == 0) continue;  // after a standstill that is told
    if (together.empty() || f - together.back().end > kShortestStep * patient.rate()) together.push_back({f - 1, f});
    together.back().end = f;
  }
  Findings findings;
  for (const Run& run : together) {
    findings.push_back(found("jump", Severity::kWarning, run.begin, run.end,
                             frames_text(run) + ": no body moves so from one frame to the next; leave them out of what "
                                                "is learned, or cut the take in two here"));
  }
  return findings;
}

}  // namespace fragmotion
