// SPDX-License-Identifier: MIT
#pragma once

#include "doctor/patient.hpp"

namespace fragmotion {

/// What finds one kind of fault, in the patient's own frames, and puts right those of its findings that it is given.
struct Check {
  Findings (*find)(const Patient&) = nullptr;
  void (*mend)(Patient&, const Findings&) = nullptr;  ///< None where nothing is mendable.
  bool needs_numbers = true;                          ///< Whether every number must be there.
};

/// In order: each check sees the take without what those before it have mended.
const std::vector<Check>& checks();

/// What a check finds in a patient that it can look at.
Findings find(const Check& check, const Patient& patient);

/// The finding in the frames of the take as it was.
Finding in_take(const Patient& patient, Finding finding);

/// Puts right those of a check's findings that are mendable.
void mend(const Check& check, const Findings& findings, Patient& patient);

Findings find_missing(const Patient& patient);
void fill_missing(Patient& patient, const Findings& findings);

Findings find_unit(const Patient& patient);
void change_unit(Patient& patient, const Findings& findings);

Findings find_up(const Patient& patient);
void turn_up(Patient& patient, const Findings& findings);

Findings find_mirrored(const Patient& patient);
void mirror_back(Patient& patient, const Findings& findings);

Findings find_facing(const Patient& patient);
void turn_to_front(Patient& patient, const Findings& findings);

Findings find_spikes(const Patient& patient);
void fill_spikes(Patient& patient, const Findings& findings);

Findings find_doubled(const Patient& patient);
void leave_out_doubled(Patient& patient, const Findings& findings);

Findings find_held(const Patient& patient);
void fill_held(Patient& patient, const Findings& findings);

Findings find_dropped(const Patient& patient);
void fill_dropped(Patient& patient, const Findings& findings);

Findings find_jumps(const Patient& patient);
Findings find_calibration(const Patient& patient);
Findings find_frozen_ends(const Patient& patient);
/// Cuts off frames at the ends.
void cut_ends(Patient& patient, const Findings& findings);

Findings find_ground(const Patient& patient);
void put_on_ground(Patient& patient, const Findings& findings);
Findings find_slope(const Patient& patient);
/// Of a body whose hips have no height of their own, and whose feet go up and down under them.
Findings find_fixed_hips(const Patient& patient);
/// Of feet that stand: other axes of the root's way by which they would, or a drift.
Findings find_slips(const Patient& patient);
Findings find_in_place(const Patient& patient);
void lead_by_feet(Patient& patient, const Findings& findings);

Findings find_noise(const Patient& patient);
/// A rate by which the body falls as no body does.
Findings find_falls(const Patient& patient);
/// Rate, size, missing parts of the body, too few frames.
Findings find_plain_facts(const Patient& patient);

}  // namespace fragmotion
