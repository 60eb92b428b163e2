// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "doctor/check.hpp"
#include "doctor/runs.hpp"

namespace fragmotion {
namespace {

constexpr double kTurn = kPi / 7.2;                 // rad: at once, of a bone in its parent
constexpr double kLeastMove = 0.05, kMoveRate = 4;  // m, m/s: of a bone of a character of 1.8 m
constexpr double kCalm = 0.3;      // of the jump: how far it moves from frame to frame before and after
constexpr double kLongest = 0.05;  // s, four frames at the least
constexpr int kMostRounds = 8;
constexpr double kTurnedOver = 0.75 * kPi;  // rad: turned over

/// A bone's frames out of line, and how far they are.
struct Spike {
  int bone = -1;
  Run run;
  bool flip = false;
};

/// How far a bone is between two frames, as a share of what no bone does from frame to frame.
class Distances {
 public:
  explicit Distances(const Patient& patient)
      : patient_(patient), move_(std::max(kLeastMove, kMoveRate / patient.rate()) / patient.scale()) {}

  double operator()(int bone, int a, int b) const { return std::max(turned(bone, a, b) / kTurn, moved(bone, a, b)); }

  double turned(int bone, int a, int b) const {
    const Quaternion from = patient_.local(a, bone).rotation, to = patient_.local(b, bone).rotation;
    return 2 * std::acos(std::min(1.0, std::abs(from.dot(to))));
  }

 private:
  double moved(int bone, int a, int b) const {
    return (patient_.local(a, bone).place - patient_.local(b, bone).place).norm() / move_;
  }

  const Patient& patient_;
  double move_;
};

/// Without those of several frames that a bone does again and again in the same time, as a foot of a drawn run that
/// flicks: no capture breaks so evenly.
std::vector<Spike> without_drawn(const std::vector<Spike>& spikes) {
  std::map<int, std::vector<int>> of_bones;
  for (int i = 0; i < static_cast<int>(spikes.size()); ++i) {
    if (spikes[i].run.length() > 1) of_bones[spikes[i].bone].push_back(i);
  }
  std::vector<char> is_drawn(spikes.size());
  for (const auto& [bone, numbers] : of_bones) {
    for (std::size_t k = 2; k < numbers.size(); ++k) {
      const int a = numbers[k - 2], b = numbers[k - 1], c = numbers[k];
      const int before = spikes[b].run.begin - spikes[a].run.begin, after = spikes[c].run.begin - spikes[b].run.begin;
      if (before == after) is_drawn[a] = is_drawn[b] = is_drawn[c] = 1;
    }
  }
  std::vector<Spike> rest;
  for (std::size_t i = 0; i < spikes.size(); ++i) {
    if (!is_drawn[i]) rest.push_back(spikes[i]);
  }
  return rest;
}

class SpikeFinder {
 public:
  explicit SpikeFinder(const Patient& patient)
      : patient_(patient),
        distance_(patient),
        longest_(std::max(4, static_cast<int>(kLongest * patient.rate()))),
        next_(patient.bones(), 1) {}

  std::vector<Spike> find() {
    std::vector<Spike> spikes;
    for (int f = 1; f < patient_.frames(); ++f) {
      for (int b = 0; b < patient_.bones(); ++b) {
        const int end = f >= next_[b] ? back_from(b, f) : 0;
        if (end == 0) continue;
        spikes.push_back({b, {f, end - 1}, distance_.turned(b, f - 1, f) > kTurnedOver});
        next_[b] = end + 1;
      }
    }
    return without_drawn(spikes);
  }

 private:
  double step(int bone, int frame) const { return distance_(bone, frame - 1, frame); }

  // The frame in which the bone is back where it was before `begin`, a jump; 0 where it is not soon, or does not jump.
  int back_from(int bone, int begin) const {
    const double first = step(bone, begin);
    for (int f = begin + 1; first > 1 && f <= begin + longest_ && f < patient_.frames(); ++f) {
      const double jump = std::min(first, step(bone, f));
      if (2 * distance_(bone, begin - 1, f) < jump)
        return jump > 1 && is_calm(bone, begin - 1, kCalm * jump) && is_calm(bone, f + 1, kCalm * jump) ? f : 0;
    }
    return 0;
  }

  bool is_calm(int bone, int frame, double most) const {
    return frame < 1 || frame >= patient_.frames() || step(bone, frame) < most;
  }

  const Patient& patient_;
  Distances distance_;
  int longest_;
  std::vector<int> next_;  // the first frame in which each bone may leave again
};

/// Also those that show only when others are filled.
std::vector<Spike> all_spikes(const Patient& patient) {
  std::vector<Spike> all, fresh = SpikeFinder(patient).find();
  if (fresh.empty()) return all;
  Patient mended = patient;
  for (int round = 0; !fresh.empty() && round < kMostRounds; ++round) {
    all.insert(all.end(), fresh.begin(), fresh.end());
    for (const Spike& spike : fresh) mended.bridge(spike.bone, spike.run);
    fresh = SpikeFinder(mended).find();
  }
  return all;
}

std::string bone_names(const Patient& patient, const std::vector<Spike>& spikes, const Run& run) {
  std::set<int> bones;
  for (const Spike& spike : spikes) {
    if (spike.run.begin >= run.begin && spike.run.end <= run.end) bones.insert(spike.bone);
  }
  const std::string first = "bone '" + patient.skeleton().names[*bones.begin()] + "'";
  return bones.size() == 1 ? first : first + " and " + std::to_string(bones.size() - 1) + " more";
}

/// Fingers and the like, which motions are not compared by, matter little.
Severity severity_of(const std::vector<Spike>& spikes, const Run& run, const std::vector<int>& measured) {
  const bool matters = std::any_of(spikes.begin(), spikes.end(), [&](const Spike& spike) {
    return spike.run.begin >= run.begin && spike.run.end <= run.end &&
           std::find(measured.begin(), measured.end(), spike.bone) != measured.end();
  });
  return matters ? Severity::kWarning : Severity::kInfo;
}

Findings findings_of(const Patient& patient, const std::vector<Spike>& spikes, const char* code, const char* what) {
  const std::vector<int> measured = measured_bones(patient.skeleton());
  std::vector<char> is_out(patient.frames());
  for (const Spike& spike : spikes) std::fill_n(&is_out[spike.run.begin], spike.run.length(), 1);
  Findings findings;
  for (const Run& run : runs(patient.frames(), [&](int f) { return is_out[f] != 0; })) {
    const std::string text =
        frames_text(run) + ": " + bone_names(patient, spikes, run) + what + "; interpolate from the frames beside";
    findings.push_back(mendable(found(code, severity_of(spikes, run, measured), run.begin, run.end, text)));
  }
  return findings;
}

}  // namespace

Findings find_spikes(const Patient& patient) {
  if (patient.scale() == 0) return {};
  std::vector<Spike> spikes = all_spikes(patient);
  const auto others = std::stable_partition(spikes.begin(), spikes.end(), [](const Spike& s) { return s.flip; });
  const std::vector<Spike> flips(spikes.begin(), others), jumps(others, spikes.end());
  Findings findings = findings_of(patient, flips, "flip", " is turned over and back at once");
  for (const Finding& f : findings_of(patient, jumps, "spike", " leaves and comes back at once")) findings.push_back(f);
  return findings;
}

void fill_spikes(Patient& patient, const Findings& findings) {
  for (const Spike& spike : all_spikes(patient)) {
    const bool chosen = std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
      return (finding.code == "flip") == spike.flip && covers({finding}, spike.run);
    });
    if (chosen) patient.bridge(spike.bone, spike.run);
  }
}

}  // namespace fragmotion
