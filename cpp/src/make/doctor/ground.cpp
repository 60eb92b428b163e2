// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/decompositions.hpp"
#include "base/quantile.hpp"
#include "base/rounding.hpp"
#include "doctor/basis.hpp"
#include "doctor/check.hpp"
#include "doctor/examine.hpp"
#include "doctor/lengths.hpp"
#include "motion/one_floor.hpp"
#include "motion/soles.hpp"

namespace fragmotion {
namespace {

constexpr int kFewestStands = 10;  // places where feet stand

/// The lowest joint of a foot, or its end, and where. Ends of what is below the toes' are nobody's: files invent them.
Vector3 sole(const Patient& patient, int frame, int leg) {
  Vector3 lowest = patient.tip(frame, patient.last_bone(leg));
  const auto look_at = [&](const Vector3& point) {
    if (point.z() < lowest.z()) lowest = point;
  };
  look_at(patient.tip(frame, patient.legs[leg].end));
  for (const int joint : patient.feet[leg]) look_at(patient.head(frame, joint));
  return lowest;
}

/// Where and when the lower of the feet that stand does: place and frame.
using Stands = std::vector<Eigen::Vector4d>;

/// `level`: near the lowest that they come; else told by their speeds alone, as the ground may be anywhere.
Stands stands_of(const Patient& patient, bool level) {
  if (!patient.has_legs() || patient.scale() == 0 || !patient.tracks()) return {};
  const Tracks& tracks = *patient.tracks();
  const double any = std::numeric_limits<double>::infinity();
  const FootHeights anywhere{any, any};
  const Floors floors = {anywhere, anywhere};
  const Contacts contacts =
      find_contacts(patient.skeleton(), tracks.feet, tracks.hips, patient.rate(), level ? nullptr : &floors);
  Stands stands;
  for (int f = 0; f < static_cast<int>(contacts.feet[0].size()); ++f) {
    if (!contacts.any_stands(f)) continue;
    int lowest = 0;
    Vector3 place = sole(patient, f, 0);
    for (int leg = 1; leg < static_cast<int>(patient.legs.size()); ++leg) {
      const Vector3 other = sole(patient, f, leg);
      if (!(place.z() < other.z())) place = other, lowest = leg;
    }
    if (contacts.feet[lowest][f]) stands.emplace_back(place.x(), place.y(), place.z(), f);
  }
  return stands;
}

/// Those near the lowest; of feet that tread on the spot, as they would on their way.
Stands level_stands(const Patient& patient) {
  Stands stands = stands_of(patient, true);
  if (!stands.empty()) return stands;
  const Findings on_the_spot = find_in_place(patient);
  if (on_the_spot.empty()) return {};
  Patient led = patient;
  lead_by_feet(led, on_the_spot);
  return stands_of(led, true);
}

/// Of a floor that Build puts level.
Vector2 slope_of(const Patient& patient) {
  const std::optional<Tracks>& tracks = patient.tracks();
  return tracks ? floor_slope(patient.skeleton(), tracks->feet, tracks->hips, patient.rate()) : Vector2::Zero();
}

/// The heights of the lowest joints of feet that stand over such a floor through the origin, m.
std::vector<double> standing_heights(const Patient& patient) {
  const Stands stands = level_stands(patient);
  if (stands.empty()) return {};
  const Vector2 slope = slope_of(patient);
  std::vector<double> heights;
  for (const Eigen::Vector4d& stand : stands) heights.push_back(stand.z() - dot(slope, stand.head<2>()));
  return heights;
}

/// That of a body at rest, where it stands on the ground: nothing of a rest pose whose feet are as near to the
/// knees' height, as where the hips are the origin.
std::optional<double> resting_height(const Patient& patient) {
  const Patient rest(patient.skeleton());
  if (!rest.has_legs() || standing_axis(rest) != Vector3::UnitZ()) return std::nullopt;
  double lowest = std::numeric_limits<double>::infinity(), knee = lowest;
  for (int leg = 0; leg < static_cast<int>(rest.legs.size()); ++leg) {
    lowest = std::min(lowest, sole(rest, 0, leg).z());
    knee = std::min(knee, rest.head(0, rest.legs[leg].middle >= 0 ? rest.legs[leg].middle : rest.legs[leg].top).z());
  }
  return 2 * std::abs(lowest) < knee ? std::optional(lowest) : std::nullopt;
}

/// How high feet stand over the ground, m; 0 where they stand on it, as nearly as the body tells: those that go on toes
/// are as low as they come.
double height_over_ground(const Patient& patient) {
  const std::vector<double> heights = standing_heights(patient);
  if (heights.empty()) return 0;
  const double stands = median(heights);
  const std::optional<double> rests = resting_height(patient);
  if (!rests) return is_on_ground(stands * patient.scale()) ? 0 : stands;
  const double over = stands > *rests ? std::max(0.0, quantile(heights, kUnderFloor) - *rests) : stands - *rests;
  return std::abs(over) * patient.scale() <= kFlatSole ? 0 : over;
}

/// How much the ground that feet stand on rises or falls over the take, as a plane or with time, beyond a floor that
/// Build puts level, m; 0 where it does not.
double rise_of(const Patient& patient) {
  const Stands stands = stands_of(patient, false);
  if (stands.size() < kFewestStands) return 0;
  const Vector2 slope = slope_of(patient);
  Eigen::MatrixXd places(stands.size(), 4);
  Eigen::VectorXd heights(stands.size());
  for (std::size_t i = 0; i < stands.size(); ++i) {
    places.row(static_cast<Eigen::Index>(i)) << 1, stands[i].x(), stands[i].y(), stands[i].w();
    heights[static_cast<Eigen::Index>(i)] = stands[i].z() - dot(slope, stands[i].head<2>());
  }
  const Eigen::VectorXd fitted = places * least_squares(places, heights);
  const double all = (heights.array() - heights.mean()).square().sum(), left = (heights - fitted).squaredNorm();
  const double rise = fitted.maxCoeff() - fitted.minCoeff();
  return left < (1 - kExplained) * all && rise * patient.scale() >= kFootHeight ? rise : 0;
}

}  // namespace

Findings find_ground(const Patient& patient) {
  const double over = height_over_ground(patient);
  if (over == 0 || rise_of(patient) > 0) return {};
  return {mendable(found(patient, "ground", Severity::kWarning,
                         "the feet stand " + length_text(std::abs(over)) + (over < 0 ? " under" : " over") +
                             " the ground; move the take " + (over < 0 ? "up" : "down")))};
}

void put_on_ground(Patient& patient, const Findings&) { patient.move({0, 0, -height_over_ground(patient)}); }

Findings find_slope(const Patient& patient) {
  const double rise = rise_of(patient);
  if (rise == 0) return {};
  return {found(patient, "slope", Severity::kWarning,
                "the ground that the feet stand on rises or falls by " + length_text(rise) +
                    " over the take: a hill or stairs, or the capture drifted; leave out the part that is not level")};
}

Findings find_fixed_hips(const Patient& patient) {
  if (!patient.has_legs() || patient.is_four_legged() || patient.hips < 0) return {};
  std::vector<double> soles, hips;
  for (int f = 0; f < patient.frames(); f += frames_between_looks(patient.frames())) {
    soles.push_back(std::min(sole(patient, f, 0).z(), sole(patient, f, 1).z()));
    hips.push_back(patient.head(f, patient.hips).z());
  }
  const double moved = quantile(hips, 1) - quantile(hips, 0),
               rise = quantile(soles, kUsualShare) - quantile(soles, 1 - kUsualShare);
  if (moved > kFloatRounding * patient.stature() || rise * patient.scale() < kFootHeight) return {};
  return {found(patient, "height", Severity::kWarning,
                "the hips stay at one height, and the lower foot goes up and down by " + length_text(rise) +
                    ": the file does not tell how high the body is, as poses seen in a video; have it solved with the "
                    "feet on the ground, or leave the take out")};
}

std::vector<Finding> examine_ground(const Take& take) {
  const Patient patient(take);
  return patient.is_finite() ? find_ground(patient) : Findings{};
}

}  // namespace fragmotion
