// SPDX-License-Identifier: MIT
#include <numeric>

#include "base/rounding.hpp"
#include "doctor/check.hpp"
#include "doctor/runs.hpp"

namespace fragmotion {
namespace {

constexpr double kEndShare = 0.1;  // of the take, that may be cut off an end unasked

bool lacks(const Patient& patient, int frame, int bone) {
  const Local local = patient.local(frame, bone);
  return !local.place.allFinite() || !local.rotation.coeffs().allFinite() || local.rotation.norm() < kFloatRounding;
}

int first_lacking(const Patient& patient, int frame) {
  for (int b = 0; b < patient.bones(); ++b) {
    if (lacks(patient, frame, b)) return b;
  }
  return -1;
}

std::vector<Run> lacking(const Patient& patient) {
  return runs(patient.frames(), [&](int f) { return first_lacking(patient, f) >= 0; });
}

bool is_at_end(const Patient& patient, const Run& run) { return run.begin == 0 || run.end == patient.frames() - 1; }

// Cut off rather than filled.
bool is_cut(const Patient& patient, const Run& run) {
  return is_at_end(patient, run) && run.length() <= patient.frames() - 2;
}

Finding missing(const Patient& patient, const Run& run) {
  const bool cut = is_cut(patient, run);
  const bool safe = cut ? run.length() <= kEndShare * patient.frames() : run.length() <= brief(patient.rate());
  const std::string bone = patient.skeleton().names[first_lacking(patient, run.begin)];
  const std::string mend = cut    ? "cut these frames off"
                           : safe ? "fill them in from the frames beside them"
                                  : "filling them in would invent motion: better cut the take here";
  return mendable(found("missing", Severity::kError, run.begin, run.end,
                        frames_text(run) + ": numbers are missing (NaN), first of bone '" + bone + "'; " + mend),
                  safe);
}

}  // namespace

Findings find_missing(const Patient& patient) {
  if (patient.is_finite()) return {};
  Findings findings;
  for (const Run& run : lacking(patient)) findings.push_back(missing(patient, run));
  return findings;
}

void fill_missing(Patient& patient, const Findings& findings) {
  Findings cut;
  for (const Finding& finding : findings) {
    const Run all{finding.begin, finding.end};
    if (is_cut(patient, all)) {
      cut.push_back(finding);
      continue;
    }
    for (int b = 0; b < patient.bones(); ++b) {
      for (const Run& run : runs(all, [&](int f) { return lacks(patient, f, b); })) patient.bridge(b, run);
    }
  }
  cut_ends(patient, cut);
}

}  // namespace fragmotion
