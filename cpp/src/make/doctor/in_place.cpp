// SPDX-License-Identifier: MIT
#include "motion/in_place.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "doctor/check.hpp"
#include "doctor/lengths.hpp"

namespace fragmotion {
namespace {

struct Shown {
  Kinematics kinematics;
  Clip clip;
};

// Whether the hips go farther than the body is tall: a long take that does is not looked at whole.
bool travels(const Patient& patient) {
  const std::vector<Vector3>& hips = patient.tracks()->hips;
  return std::any_of(hips.begin(), hips.end(),
                     [&](const Vector3& place) { return (place - hips.front()).head<2>().norm() > patient.stature(); });
}

// The patient as a clip; nothing where it can be none.
std::optional<Shown> shown(const Patient& patient) {
  if (!patient.has_legs() || patient.frames() < 3 || !patient.tracks() || travels(patient)) return std::nullopt;
  return Shown{Kinematics(patient.skeleton()), clip_from_take(patient.skeleton(), patient.take())};
}

std::optional<FeetWay> way_of(const std::optional<Shown>& shown) {
  return shown ? find_feet_way(shown->kinematics, shown->clip) : std::nullopt;
}

std::string degrees(double radians) { return short_number(std::round(radians * 180 / kPi)); }

std::string told(const FeetWay& way) {
  std::string text = short_number(way.mean.norm()) + " m/s";
  if (way.turn != 0)
    text += std::string(", turning ") + (way.turn > 0 ? "left" : "right") + " by " + degrees(std::abs(way.turn)) +
            " degrees/s";
  return text;
}

}  // namespace

Findings find_in_place(const Patient& patient) {
  const std::optional<FeetWay> way = way_of(shown(patient));
  if (!way) return {};
  return {mendable(found(patient, "in_place", Severity::kWarning,
                         "on the spot: its feet go at " + told(*way) + "; the body can go so, too"))};
}

void lead_by_feet(Patient& patient, const Findings&) {
  const std::optional<Shown> now = shown(patient);
  patient.place(placements(way_of(now).value(), now->clip));
}

}  // namespace fragmotion
