// SPDX-License-Identifier: MIT
#include "doctor/mend.hpp"

#include <algorithm>

#include "doctor/check.hpp"

namespace fragmotion {
namespace {

constexpr const char* kStage = "Mending a take";

bool is_same(const Finding& a, const Finding& b) { return a.code == b.code && a.begin == b.begin && a.end == b.end; }

bool holds(const Findings& findings, const Finding& finding) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& each) { return is_same(each, finding); });
}

}  // namespace

Take mend(const Take& take, const std::vector<Finding>& findings, const Progress& progress) {
  double done = 0;
  Patient patient(take, [&] { report(progress, done, kStage); });
  for (const Check& check : checks()) {
    report(progress, done, kStage);
    Findings chosen;
    for (const Finding& finding : find(check, patient)) {
      if (holds(findings, in_take(patient, finding))) chosen.push_back(finding);
    }
    mend(check, chosen, patient);
    done += 1.0 / static_cast<double>(checks().size() + 1);
  }
  return patient.take();
}

}  // namespace fragmotion
