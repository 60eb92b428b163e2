// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "doctor/basis.hpp"
#include "doctor/check.hpp"
#include "doctor/lengths.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

const Eigen::Matrix3d kAsItIs = Eigen::Matrix3d::Identity();
const Eigen::Matrix3d kMirror = Vector3{-1, 1, 1}.asDiagonal();

constexpr double kLeastBody = 1.3, kMostBody = 2.2;    // m: what a unit must make of a grown person
constexpr double kLeastAnimal = 0.3, kMostAnimal = 5;  // m: of an animal on four legs, a cat to an elephant

struct Unit {
  const char* name;
  double metres;
};

constexpr std::array<Unit, 7> kUnits = {{{"metres", 1},
                                         {"decimetres", 0.1},
                                         {"centimetres", 0.01},
                                         {"millimetres", 0.001},
                                         {"inches", kInch},
                                         {"feet", 12 * kInch},
                                         {"CMU's units of 1/0.45 inch", kInch / 0.45}}};

/// Exactly.
Eigen::Matrix3d quarter_turns(const Vector3& axis, int count) {
  return Eigen::AngleAxisd(count * kPi / 2, axis).toRotationMatrix().array().round();
}

bool is_body(const Patient& patient, double stature) {
  return patient.is_four_legged() ? stature >= kLeastAnimal && stature <= kMostAnimal
                                  : stature >= kLeastBody && stature <= kMostBody;
}

/// Of a body on four legs their length, which is all that tells its size.
std::string size_text(const Patient& patient, double stature) {
  return short_number(patient.is_four_legged() ? kLegOfStature * stature : stature) + " m";
}

std::string body_text(const Patient& patient) {
  const std::string size = size_text(patient, patient.stature());
  return patient.is_four_legged() ? "the body goes on four legs that are " + size + " long"
                                  : "the body is " + size + " tall";
}

/// The unit of the file in which the body has the stature of a person, or of an animal on four legs, told from what was
/// taken for it.
std::optional<Unit> told_unit(const Patient& patient) {
  const double in_file = patient.stature() / patient.unit();
  for (const Unit& unit : kUnits) {
    if (is_body(patient, in_file * unit.metres)) return Unit{unit.name, unit.metres / patient.unit()};
  }
  for (int power = -6; power <= 6; ++power) {
    const double scale = std::pow(10.0, power);
    if (is_body(patient, patient.stature() * scale)) return Unit{nullptr, scale};
  }
  return std::nullopt;
}

/// Whether the body goes its own length and more where the ground would be: who lies does not.
bool walks_across(const Patient& patient, const Vector3& up) {
  const int seen = patient.skull >= 0 ? patient.skull : patient.legs[0].top;
  for (int f = 1; f < patient.frames(); ++f) {
    const Vector3 way = patient.head(f, seen) - patient.head(0, seen);
    if ((way - way.dot(up) * up).norm() > patient.stature()) return true;
  }
  return false;
}

/// The lowest place of a joint along an axis, m.
double lowest(const Patient& patient, const Vector3& up) {
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < patient.frames(); f += frames_between_looks(patient.frames())) {
    for (int bone = 0; bone < patient.bones(); ++bone) least = std::min(least, up.dot(patient.head(f, bone)));
  }
  return least;
}

/// Whether the body stands on the ground of its file, and would go under it as it is: who lies is over the ground.
bool stands_on_ground(const Patient& patient, const Vector3& up) {
  return std::abs(lowest(patient, up)) < -lowest(patient, Vector3::UnitZ());
}

/// How far feet and knees point to the front that the sides tell: -1 to 1, and lengths of a leg.
struct Front {
  double feet = 0, knees = 0;
};

void add_front(const Patient& patient, int frame, Front& front) {
  const Vector3 right = patient.head(frame, patient.legs[1].top) - patient.head(frame, patient.legs[0].top);
  const Vector3 ahead = Vector3::UnitZ().cross(right).normalized();
  for (int side = 0; side < 2; ++side) {
    const Limb3& leg = patient.legs[side];
    Vector3 toe = patient.toe_direction(frame, side);
    toe.z() = 0;
    front.feet += toe.normalized().dot(ahead) / (2 * patient.frames());
    if (leg.middle < 0) continue;
    const Vector3 hip = patient.head(frame, leg.top), ankle = patient.head(frame, leg.end),
                  knee = patient.head(frame, leg.middle), way = (ankle - hip).normalized();
    const Vector3 bent = (knee - hip) - (knee - hip).dot(way) * way;
    front.knees += bent.dot(ahead) / (2 * patient.frames() * (ankle - hip).norm());
  }
}

Front front_of(const Patient& patient) {
  Front front;
  for (int f = 0; f < patient.frames(); ++f) add_front(patient, f, front);
  return front;
}

// Feet of a runner, say, do not point to the front for certain.
bool points_back(const Front& front) {
  return (front.knees < -kBends && front.feet < kNoDirection) || (front.knees < kBends && front.feet < -kSameWay);
}

}  // namespace

Findings find_unit(const Patient& patient) {
  if (!patient.has_legs() || patient.is_life_size()) return {};
  const std::optional<Unit> unit = told_unit(patient);
  if (!unit) return {};
  const std::string told = unit->name ? std::string("its file is in ") + unit->name + " (a unit of " +
                                            short_number(unit->metres * patient.unit()) + " m)"
                                      : "its lengths are off";
  return {mendable(found(patient, "unit", Severity::kWarning,
                         body_text(patient) + ": " + told + "; lengths times " + short_number(unit->metres) + " make " +
                             (patient.is_four_legged() ? "them " : "it ") +
                             size_text(patient, patient.stature() * unit->metres)))};
}

void change_unit(Patient& patient, const Findings&) { patient.change_basis(kAsItIs, told_unit(patient)->metres); }

Findings find_up(const Patient& patient) {
  const Vector3 up = up_axis(patient);
  if (up.isZero(0) || up.z() == 1) return {};
  const bool rests_so = standing_axis(Patient(patient.skeleton())) == up;
  const bool sure = rests_so || walks_across(patient, up) || stands_on_ground(patient, up);
  const std::string doubt = sure ? "" : " (or the take is of somebody who lies)";
  return {mendable(found(patient, "up", Severity::kWarning,
                         "the body stands along " + axis_name(up) + " and not upright: the file's up axis is another" +
                             doubt + "; turn it up"),
                   sure)};
}

void turn_up(Patient& patient, const Findings&) {
  const Vector3 up = up_axis(patient), z = Vector3::UnitZ();
  const Vector3 about = up.z() == 0 ? Vector3{up.cross(z)} : Vector3::UnitX();
  patient.change_basis(quarter_turns(about, up.z() == 0 ? 1 : 2));
}

Findings find_mirrored(const Patient& patient) {
  if (!patient.has_legs() || patient.is_four_legged() || up_axis(patient).z() != 1) return {};
  if (!points_back(front_of(patient))) return {};
  return {mendable(found(patient, "mirrored", Severity::kWarning,
                         "the left leg is on the body's right: feet and knees point backward; the file is mirrored (a "
                         "left-handed or negated axis), or left and right are swapped in its names; mirror it back"))};
}

void mirror_back(Patient& patient, const Findings&) { patient.change_basis(kMirror); }

Findings find_facing(const Patient& patient) {
  const Patient rest(patient.skeleton());
  const Vector3 front = front_axis(rest);
  if (standing_axis(rest).z() != 1 || front.isZero(0) || front.y() == -1) return {};
  return {mendable(found(patient, "facing", Severity::kInfo,
                         "at rest the body faces " + axis_name(front) + " and not -Y, Blender's front; turn it"))};
}

void turn_to_front(Patient& patient, const Findings&) {
  const Vector3 front = front_axis(Patient(patient.skeleton()));
  const int quarters = front.y() == 1 ? 2 : front.x() == 1 ? -1 : 1;
  patient.change_basis(quarter_turns(Vector3::UnitZ(), quarters));
}

}  // namespace fragmotion
