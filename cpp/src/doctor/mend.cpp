// SPDX-License-Identifier: MIT
#include "fragmotion/doctor/mend.hpp"

#include <algorithm>

#include "doctor/check.hpp"

namespace fragmotion {
namespace {

bool is_same(const Finding& a, const Finding& b) { return a.code == b.code && a.begin == b.begin && a.end == b.end; }

bool holds(const Findings& findings, const Finding& finding) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& each) { return is_same(each, finding); });
}

}  // namespace

Take mend(const Take& take, const std::vector<Finding>& findings) {
  Patient patient(take);
  for (const Check& check : checks()) {
    Findings chosen;
    for (const Finding& finding : find(check, patient)) {
      if (holds(findings, in_take(patient, finding))) chosen.push_back(finding);
    }
    mend(check, chosen, patient);
  }
  return patient.take();
}

}  // namespace fragmotion
