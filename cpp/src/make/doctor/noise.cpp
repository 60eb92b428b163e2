// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <cmath>

#include "base/quantile.hpp"
#include "doctor/check.hpp"
#include "doctor/lengths.hpp"

namespace fragmotion {
namespace {

// The second differences of white noise are six times its variance, and each is opposed to the one before by two
// thirds; those of bodies in motion go on as they were.
constexpr double kOfDifferences = 6;
constexpr double kOpposed = -0.3;
constexpr double kNoisy = 1;       // degrees
constexpr int kFewestShaken = 30;  // animators key a blow or a jump in less

/// How much a bone is off from what is beside it from frame to frame.
struct Jitter {
  double squares = 0, products = 0;  // of second differences, and of each with the one before
  int count = 0;

  double degrees() const { return count > 0 ? std::sqrt(squares / (kOfDifferences * count)) * 180 / kPi : 0; }
};

Vector3 turn(const Quaternion& from, const Quaternion& to) {
  const Eigen::AngleAxisd between(from.conjugate() * to);
  return (between.angle() > kPi ? between.angle() - 2 * kPi : between.angle()) * between.axis();
}

Jitter jitter_of(const Patient& patient, int bone) {
  Jitter jitter;
  Vector3 turned = Vector3::Zero(), change = Vector3::Zero();
  for (int f = 1; f < patient.frames(); ++f) {
    const Vector3 now = turn(patient.local(f - 1, bone).rotation, patient.local(f, bone).rotation);
    if (f > 1) {
      jitter.squares += (now - turned).squaredNorm();
      jitter.products += (now - turned).dot(change);
      ++jitter.count;
      change = now - turned;
    }
    turned = now;
  }
  return jitter;
}

}  // namespace

Findings find_noise(const Patient& patient) {
  if (patient.frames() < kFewestShaken) return {};
  std::vector<double> off, opposed;
  for (int b = 0; b < patient.bones(); ++b) {
    const Jitter jitter = jitter_of(patient, b);
    off.push_back(jitter.degrees());
    if (jitter.squares > 0) opposed.push_back(jitter.products / jitter.squares);
  }
  const double degrees = median(std::move(off));
  if (degrees < kNoisy || median(std::move(opposed)) > kOpposed) return {};
  return {found(patient, "noise", Severity::kWarning,
                "bones shake by " + short_number(degrees) +
                    " degrees from frame to frame: noise of the capture; smooth the take, or leave it out")};
}

}  // namespace fragmotion
