// SPDX-License-Identifier: MIT
#include "retarget/remarks.hpp"

#include <algorithm>
#include <cstdio>

namespace fragmotion {
namespace {

constexpr double kSkate = 1.1, kContact = 0.01;  // ratio, and m of a 1.8 m character, beyond which it is remarked on
constexpr double kHipsMoved = 0.05;              // m of a 1.8 m character that hips are moved without a remark
constexpr double kLimbBroken = 45 * kPi / 180;   // rad: no rest pose of a standing body differs so from another's

std::string with_number(const char* format, double number) {
  char text[160];
  std::snprintf(text, sizeof(text), format, number);
  return text;
}

}  // namespace

std::vector<RetargetRemark> remarks_on(const RetargetReport& report, double scale) {
  std::vector<RetargetRemark> found;
  for (const auto& [role, angle] : report.limb_angles) {
    if (angle <= kLimbBroken) continue;
    std::string limb = role;
    std::replace(limb.begin(), limb.end(), '_', ' ');
    found.push_back({"limb", true,
                     "the " + limb +
                         with_number(" is %.0f degrees from the actor's: see in Bones whether it, and what "
                                     "it hangs on, are told right",
                                     angle * 180 / kPi)});
  }
  if (report.foot_skate_ratio > kSkate)
    found.push_back(
        {"foot_skate", false, with_number("feet slide %.2f times as much as in the take", report.foot_skate_ratio)});
  if (report.contact_error * scale > kContact)
    found.push_back(
        {"contact", false, with_number("a standing foot is up to %.1f cm off the ground", 100 * report.contact_error)});
  if (report.hips_moved * scale > kHipsMoved)
    found.push_back(
        {"hips", false,
         with_number("the hips are moved by up to %.1f cm for the legs to reach", 100 * report.hips_moved)});
  return found;
}

}  // namespace fragmotion
