// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "doctor/basis.hpp"
#include "doctor/check.hpp"
#include "doctor/runs.hpp"
#include "motion/arms_out.hpp"

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

double arms_out_in(const Patient& patient, int frame) {
  const auto& [left, right] = patient.arms;
  const auto head = [&](int bone) { return patient.head(frame, bone); };
  return arms_out(head(left.top), head(left.end), head(right.top), head(right.end));
}

bool hips_stand(const Patient& patient, const Run& run) {
  if (patient.hips < 0) return false;
  const Vector3 way = patient.head(run.end, patient.hips) - patient.head(run.begin, patient.hips);
  return way.norm() * patient.scale() < kStill * run.length() / patient.rate();
}

/// How many frames, from one end of the take on, hold the arms so far out.
int held_out(const Patient& patient, bool at_start, double least) {
  const int last = patient.frames() - 1;
  int count = 0;
  while (patient.has_arms() && count <= last && arms_out_in(patient, at_start ? count : last - count) > least) ++count;
  return count;
}

/// The frames of a T pose at an end of the take, with the swing of the arms to it or back.
Run t_pose(const Patient& patient, bool at_start) {
  const bool is_held = held_out(patient, at_start, kArmsOut) >= kShortestStep * patient.rate();
  const int count = is_held ? held_out(patient, at_start, kArmsHalfOut) : 0, last = patient.frames() - 1;
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
    const Run run = t_pose(patient, at_start);
    const bool told = covers(findings, at_start ? Run{0, 0} : Run{patient.frames() - 1, patient.frames() - 1});
    if (!told && run.length() > 0 && run.length() < patient.frames() / 2 && hips_stand(patient, run))
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
