// SPDX-License-Identifier: MIT
#include "doctor/check.hpp"

#include <algorithm>
#include <iterator>

namespace fragmotion {
namespace {

void leave(Patient&, const Findings&) {}

}  // namespace

const std::vector<Check>& checks() {
  static const std::vector<Check> all = {
      {find_missing, fill_missing, false},
      {find_unit, change_unit},
      {find_up, turn_up},
      {find_mirrored, mirror_back},
      {find_facing, turn_to_front},
      {find_spikes, fill_spikes},
      {find_doubled, leave_out_doubled},
      {find_held, fill_held},
      {find_calibration, cut_ends},
      {find_frozen_ends, cut_ends},
      {find_dropped, fill_dropped},
      {find_jumps, leave},
      {find_ground, put_on_ground},
      {find_slope, leave},
      {find_fixed_hips, leave},
      {find_slips, leave},
      {find_in_place, lead_by_feet},
      {find_noise, leave},
      {find_falls, leave},
      {find_plain_facts, leave},
  };
  return all;
}

Findings find(const Check& check, const Patient& patient) {
  return check.needs_numbers && !patient.is_finite() ? Findings{} : check.find(patient);
}

Finding in_take(const Patient& patient, Finding finding) {
  finding.begin = patient.source(finding.begin);
  finding.end = patient.source(finding.end);
  return finding;
}

void mend(const Check& check, const Findings& findings, Patient& patient) {
  Findings mendable;
  std::copy_if(findings.begin(), findings.end(), std::back_inserter(mendable),
               [](const Finding& finding) { return finding.mendable; });
  if (!mendable.empty()) check.mend(patient, mendable);
}

}  // namespace fragmotion
