// SPDX-License-Identifier: MIT
#include <cmath>
#include <numeric>

#include "doctor/check.hpp"
#include "doctor/runs.hpp"

namespace fragmotion {
namespace {

constexpr double kDropped = 1.75;  // times the steps beside: a frame has been left out
constexpr double kAlike = 0.75;    // cosine of the steps beside

using Step = Eigen::VectorXd;

Step step_to(const Patient& patient, int frame) {
  Step step(3 * patient.bones());
  for (int b = 0; b < patient.bones(); ++b)
    step.segment<3>(3 * b) = patient.head(frame, b) - patient.head(frame - 1, b);
  return step;
}

/// How many frames are missing before a frame, told from the steps beside it.
int dropped_between(const Patient& patient, const Step& before, const Step& step, const Step& after) {
  const Step usual = 0.5 * (before + after);
  const double speed = usual.norm() / std::sqrt(patient.bones()) * patient.rate() * patient.scale();
  if (!(speed > kWalking && before.dot(after) > kAlike * before.norm() * after.norm())) return 0;
  const double times = step.dot(usual) / usual.squaredNorm();
  if (times < kDropped || (step - times * usual).norm() > kLeft * step.norm()) return 0;
  const int count = static_cast<int>(std::lround(times)) - 1;
  return count <= brief(patient.rate()) ? count : 0;
}

/// For each frame how many are missing before it.
std::vector<int> dropped_before(const Patient& patient) {
  std::vector<int> counts(patient.frames(), 0);
  if (patient.frames() < 4 || patient.scale() == 0) return counts;
  Step before = step_to(patient, 1), step = step_to(patient, 2);
  for (int f = 2; f + 1 < patient.frames(); ++f) {
    const Step after = step_to(patient, f + 1);
    counts[f] = dropped_between(patient, before, step, after);
    before = step;
    step = after;
  }
  return counts;
}

}  // namespace

Findings find_dropped(const Patient& patient) {
  const std::vector<int> counts = dropped_before(patient);
  Findings findings;
  for (int f = 1; f < patient.frames(); ++f) {
    if (counts[f] == 0) continue;
    const std::string what = counts[f] == 1 ? "a frame is" : std::to_string(counts[f]) + " frames are";
    findings.push_back(mendable(
        found("dropped", Severity::kWarning, f - 1, f,
              frames_text(Run{f - 1, f}) + ": " + what + " missing between them, the body goes on too far; fill in")));
  }
  return findings;
}

void fill_dropped(Patient& patient, const Findings& findings) {
  std::vector<int> counts = dropped_before(patient);
  for (int f = 1; f < patient.frames(); ++f) {
    if (!covers(findings, {f - 1, f})) counts[f] = 0;
  }
  patient.fill_in(counts);
}

}  // namespace fragmotion
