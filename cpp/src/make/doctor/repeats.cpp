// SPDX-License-Identifier: MIT
#include <algorithm>

#include "doctor/check.hpp"
#include "doctor/runs.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {
namespace {

constexpr int kMostCopies = 8;   // of each frame
constexpr double kMoving = 0.6;  // of the frames that should move, that do
constexpr int kFewestOwn = 4;    // frames of their own, to tell that each stands several times

/// Whether a frame is the one before, to the bit.
class Repeats {
 public:
  explicit Repeats(const Patient& patient) {
    for (int f = 0; f < patient.frames(); ++f) flags_.push_back(patient.repeats(f));
  }

  bool operator[](int frame) const { return flags_[frame] != 0; }
  bool all() const {
    return std::all_of(flags_.begin() + 1, flags_.end(), [](char flag) { return flag != 0; });
  }
  int moves() const { return static_cast<int>(std::count(flags_.begin() + 1, flags_.end(), 0)); }

 private:
  std::vector<char> flags_;
};

/// How often each frame stands in the take, and the first that is new.
struct Copies {
  int count = 1, first = 0;
};

bool stands_so_often(const Patient& patient, const Repeats& repeats, const Copies& copies) {
  for (int f = 1; f < patient.frames(); ++f) {
    if (!repeats[f] && f % copies.count != copies.first) return false;
  }
  const int steps = patient.frames() / copies.count - 1;
  return repeats.moves() >= kMoving * steps;
}

Copies copies_of(const Patient& patient) {
  const Repeats repeats(patient);
  for (int count = kMostCopies; count > 1; --count) {
    if (patient.frames() < kFewestOwn * count) continue;
    for (int first = 0; first < count; ++first) {
      if (stands_so_often(patient, repeats, {count, first})) return {count, first};
    }
  }
  return {};
}

/// Runs of frames that are the one before.
std::vector<Run> held(const Patient& patient) {
  const Repeats repeats(patient);
  return runs(patient.frames(), [&](int f) { return repeats[f]; });
}

bool is_inside(const Patient& patient, const Run& run) { return run.begin > 1 && run.end < patient.frames() - 1; }

Finding held_inside(const Patient& patient, const Run& run) {
  const std::string text = frames_text(run) + ": nothing moves, while it does before and after";
  if (run.length() <= brief(patient.rate()))
    return mendable(found("frozen", Severity::kWarning, run.begin, run.end, text + "; interpolate over them"));
  return found("frozen", Severity::kWarning, run.begin, run.end,
               text + "; leave these frames out of what is learned, or cut the take in two");
}

}  // namespace

Findings find_doubled(const Patient& patient) {
  const int count = copies_of(patient).count;
  if (count == 1) return {};
  return {mendable(found(patient, "doubled", Severity::kWarning,
                         "each frame stands " + std::to_string(count) + " times: the motion was made at 1/" +
                             std::to_string(count) + " of the file's rate; leave the copies out"))};
}

void leave_out_doubled(Patient& patient, const Findings&) {
  const Copies copies = copies_of(patient);
  std::vector<int> frames;
  for (int f = copies.first > 0 ? copies.first - copies.count : 0; f < patient.frames(); f += copies.count)
    frames.push_back(std::max(f, 0));
  patient.keep(frames, copies.count);
}

Findings find_held(const Patient& patient) {
  if (patient.frames() < 2) return {};
  if (Repeats(patient).all())
    return {found(patient, "frozen", Severity::kInfo, "nothing moves in this take: it is one pose, good for standing")};
  Findings findings;
  for (const Run& run : held(patient)) {
    if (is_inside(patient, run)) findings.push_back(held_inside(patient, run));
  }
  return findings;
}

void fill_held(Patient& patient, const Findings& findings) {
  for (const Finding& finding : findings) {
    for (int b = 0; b < patient.bones(); ++b) patient.bridge(b, {finding.begin, finding.end});
  }
}

Findings find_frozen_ends(const Patient& patient) {
  if (patient.frames() < 2 || Repeats(patient).all()) return {};
  Findings findings;
  for (const Run& run : held(patient)) {
    if (is_inside(patient, run) || run.length() < brief(patient.rate())) continue;
    const Run cut = run.begin == 1 ? Run{0, run.end - 1} : run;
    findings.push_back(mendable(found("frozen", Severity::kWarning, cut.begin, cut.end,
                                      frames_text(cut) + ": nothing moves at this end of the take; cut it off")));
  }
  return findings;
}

void cut_ends(Patient& patient, const Findings& findings) {
  int first = 0, last = patient.frames() - 1;
  for (const Finding& finding : findings) {
    if (finding.begin <= first)
      first = std::max(first, finding.end + 1);
    else
      last = std::min(last, finding.begin - 1);
  }
  std::vector<int> frames;
  for (int f = first; f <= last; ++f) frames.push_back(f);
  if (frames.size() >= 2 && frames.size() < static_cast<std::size_t>(patient.frames())) patient.keep(frames);
}

}  // namespace fragmotion
