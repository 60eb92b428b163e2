// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/decompositions.hpp"
#include "base/quantile.hpp"
#include "doctor/check.hpp"
#include "doctor/lengths.hpp"
#include "doctor/runs.hpp"
#include "motion/contacts.hpp"
#include "motion/gait_bounces.hpp"

namespace fragmotion {
namespace {

// Of a character of 1.8 m. The 24 flights of two actors that are so long and even fall at 9.2 to 11.1 m/s^2.
constexpr double kAloft = 0.05;     // m: of all joints of the feet over where they stand
constexpr int kShortestFlight = 5;  // of a flight
constexpr double kEven = 0.1;       // of what a straight way leaves unexplained: what a fall does at most
constexpr double kOtherRate = 1.8;  // times the rate: animators let bodies fall slower or faster, too

// How high over its ground the lowest joint of the feet is, by frame, m.
std::vector<double> clearance(const Patient& patient) {
  std::vector<int> joints;
  for (const std::vector<int>& foot : patient.feet) joints.insert(joints.end(), foot.begin(), foot.end());
  std::vector<std::vector<Vector3>> paths(joints.size());
  for (int f = 0; f < patient.frames(); ++f) {
    for (std::size_t i = 0; i < joints.size(); ++i) paths[i].push_back(patient.head(f, joints[i]));
  }
  std::vector<double> lowest(patient.frames(), std::numeric_limits<double>::infinity());
  for (const std::vector<Vector3>& path : paths) {
    const double ground = floor_of(path);
    for (std::size_t f = 0; f < path.size(); ++f) lowest[f] = std::min(lowest[f], path[f].z() - ground);
  }
  return lowest;
}

// The mean of the body's joints, m.
double height(const Patient& patient, int frame) {
  double sum = 0;
  int joints = 0;
  for (const RoleBone& bone : patient.roles().bones) {
    if (bone.role != Role::kFinger && bone.role != Role::kRoot) sum += patient.head(frame, bone.bone).z(), ++joints;
  }
  return sum / joints;
}

double unexplained(const Eigen::MatrixXd& powers, const Eigen::VectorXd& heights) {
  return (heights - powers * least_squares(powers, heights)).squaredNorm();
}

// By how much the body falls faster from second to second in a flight, m/s^2; 0 where it is no free fall.
double fall(const Patient& patient, const Run& run) {
  if (run.length() < kShortestFlight) return 0;
  Eigen::MatrixXd powers(run.length(), 3);
  Eigen::VectorXd heights(run.length());
  for (int i = 0; i < run.length(); ++i) {
    const double time = (i - (run.length() - 1) / 2.0) / patient.rate();
    powers.row(i) << 1, time, time * time;
    heights[i] = height(patient, run.begin + i) * patient.scale();
  }
  const double curve = least_squares(powers, heights)[2], end = powers(0, 1);
  if (-curve * end * end < kLeastBounce) return 0;
  const double straight = unexplained(powers.leftCols(2), heights);
  return unexplained(powers, heights) < kEven * kEven * straight ? -2 * curve : 0;
}

}  // namespace

Findings find_falls(const Patient& patient) {
  if (!patient.has_legs() || patient.scale() == 0) return {};
  const std::vector<double> clear = clearance(patient);
  std::vector<double> falls;
  for (const Run& run : runs(patient.frames(), [&](int f) { return clear[f] * patient.scale() > kAloft; })) {
    const double fallen = fall(patient, run);
    if (fallen > 0) falls.push_back(fallen);
  }
  if (falls.empty()) return {};
  const double times = std::sqrt(kGravity / median(std::move(falls)));
  if (times < kOtherRate && times > 1 / kOtherRate) return {};
  return {found(patient, "rate", Severity::kWarning,
                "the body falls as in some " + short_number(std::round(times * patient.rate())) +
                    " frames a second, and not in " + short_number(patient.rate()) +
                    "; look up the true rate, for speeds depend on it")};
}

}  // namespace fragmotion
