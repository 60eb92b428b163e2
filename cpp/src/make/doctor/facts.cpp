// SPDX-License-Identifier: MIT
#include "doctor/check.hpp"
#include "doctor/lengths.hpp"

namespace fragmotion {
namespace {

constexpr double kLeastRate = 15, kMostRate = 500;  // frames/s

void add_rate(const Patient& patient, Findings& findings) {
  if (patient.rate() >= kLeastRate && patient.rate() <= kMostRate) return;
  findings.push_back(found(patient, "rate", Severity::kWarning,
                           short_number(patient.rate()) + " frames a second: motion capture has some " +
                               short_number(kLeastRate) + " to " + short_number(kMostRate) +
                               "; look up the true rate, for speeds depend on it"));
}

void add_size(const Patient& patient, Findings& findings) {
  if (patient.stature() == 0)
    findings.push_back(
        found(patient, "size", Severity::kError, "the bones have no length: there is no body to learn from"));
  else if (patient.is_four_legged() && !patient.is_life_size())
    findings.push_back(found(patient, "size", Severity::kWarning,
                             "the body goes on four legs that are " + short_number(kLegOfStature * patient.stature()) +
                                 " m long, and no usual unit makes them an animal's; scale it to its true size"));
  else if (patient.has_legs() && !patient.is_life_size())
    findings.push_back(found(patient, "size", Severity::kWarning,
                             "the body is " + short_number(patient.stature()) +
                                 " m tall, and no usual unit makes it a person; scale it where it is meant to be one"));
}

void add_body(const Patient& patient, Findings& findings) {
  if (patient.bones() == 1)
    findings.push_back(found(patient, "body", Severity::kError, "there is one bone only: no body to learn from"));
  else if (!patient.has_legs())
    findings.push_back(found(patient, "body", Severity::kWarning,
                             "no two legs are told from the bones' names and shape: steps and the ground cannot be "
                             "found; say which bones they are"));
  else if (!patient.has_arms() && !patient.is_four_legged())
    findings.push_back(found(patient, "body", Severity::kInfo, "no two arms are told from the bones' names and shape"));
}

void add_length(const Patient& patient, Findings& findings) {
  const double seconds = patient.frames() / patient.rate();
  if (patient.frames() < 2)
    findings.push_back(found(patient, "short", Severity::kError, "there is one frame only: a pose, not a motion"));
  else if (seconds < kShortestStep)
    findings.push_back(found(patient, "short", Severity::kWarning,
                             "the take lasts " + short_number(seconds) + " s: too short for a step"));
}

}  // namespace

Findings find_plain_facts(const Patient& patient) {
  Findings findings;
  add_rate(patient, findings);
  add_size(patient, findings);
  add_body(patient, findings);
  add_length(patient, findings);
  return findings;
}

}  // namespace fragmotion
