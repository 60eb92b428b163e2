// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/decompositions.hpp"
#include "base/quantile.hpp"
#include "doctor/check.hpp"
#include "doctor/lengths.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {
namespace {

// Of a character of 1.8 m. The lowest joint of a foot is inside it, and not every file has the toes' ends.
constexpr double kUnder = -0.02, kOver = 0.08;  // m: where it may be on the ground, which rises by no more
constexpr double kExplained = 0.7;              // of the heights' variance, by a slope
constexpr int kFewestStands = 10;               // places where feet stand

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

/// The median height over the ground at which feet stand, m; nothing where none does.
std::optional<double> ground_of(const Patient& patient) {
  std::vector<double> heights;
  for (const Eigen::Vector4d& stand : stands_of(patient, true)) heights.push_back(stand.z());
  return heights.empty() ? std::nullopt : std::optional(median(std::move(heights)));
}

/// How much the ground that feet stand on rises or falls over the take, as a plane or with time, m; 0 where it is
/// level.
double rise_of(const Patient& patient) {
  const Stands stands = stands_of(patient, false);
  if (stands.size() < kFewestStands) return 0;
  Eigen::MatrixXd places(stands.size(), 4);
  Eigen::VectorXd heights(stands.size());
  for (std::size_t i = 0; i < stands.size(); ++i) {
    places.row(static_cast<Eigen::Index>(i)) << 1, stands[i].x(), stands[i].y(), stands[i].w();
    heights[static_cast<Eigen::Index>(i)] = stands[i].z();
  }
  const Eigen::VectorXd fitted = places * least_squares(places, heights);
  const double all = (heights.array() - heights.mean()).square().sum(), left = (heights - fitted).squaredNorm();
  const double rise = fitted.maxCoeff() - fitted.minCoeff();
  return left < (1 - kExplained) * all && rise * patient.scale() >= kOver ? rise : 0;
}

}  // namespace

Findings find_ground(const Patient& patient) {
  const std::optional<double> ground = ground_of(patient);
  if (!ground || rise_of(patient) > 0) return {};
  const double height = *ground * patient.scale();
  if (height >= kUnder && height <= kOver) return {};
  return {mendable(found(patient, "ground", Severity::kWarning,
                         "the feet stand " + centimetres(std::abs(*ground)) + (height < 0 ? " under" : " over") +
                             " the ground; move the take " + (height < 0 ? "up" : "down")))};
}

void put_on_ground(Patient& patient, const Findings&) { patient.move({0, 0, -*ground_of(patient)}); }

Findings find_slope(const Patient& patient) {
  const double rise = rise_of(patient);
  if (rise == 0) return {};
  return {found(patient, "slope", Severity::kWarning,
                "the ground that the feet stand on rises or falls by " + centimetres(rise) +
                    " over the take: a hill or stairs, or the capture drifted; leave out the part that is not level")};
}

}  // namespace fragmotion
