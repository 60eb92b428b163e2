// SPDX-License-Identifier: MIT
#include "doctor/examine.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "doctor/basis.hpp"
#include "doctor/check.hpp"
#include "doctor/duplicates.hpp"

namespace fragmotion {
namespace {

std::string rest_pose_name(const Patient& rest) {
  if (!rest.has_arms()) return "";
  const Vector3 up = standing_axis(rest);
  if (up.isZero(0)) return "other";
  double rise = 0;
  for (const Limb3& arm : rest.arms) {
    const Vector3 way = rest.head(0, arm.end) - rest.head(0, arm.top);
    rise += 0.5 * std::asin(std::clamp(way.normalized().dot(up), -1.0, 1.0)) * 180 / kPi;
  }
  return rise > 20 ? "other" : rise > -20 ? "T" : rise > -65 ? "A" : "down";
}

Examination described(const Patient& patient) {
  const Patient rest(patient.skeleton());
  Examination told;
  told.up = axis_name(up_axis(patient));
  told.facing = axis_name(front_axis(rest));
  told.rate = patient.rate();
  told.rest_pose = rest_pose_name(rest);
  told.roles = named_bones(patient.skeleton(), patient.roles());
  return told;
}

/// Finds and tells, and mends the patient as far as it can be, so that the next check sees no fault but its own.
void apply(const Check& check, Patient& patient, Findings& told) {
  const Findings findings = find(check, patient);
  for (const Finding& finding : findings) told.push_back(in_take(patient, finding));
  mend(check, findings, patient);
}

/// Each take on one thread, the next that is left. The calling one alone tells how far all are, and ends all.
class Rounds {
 public:
  Rounds(const std::vector<const Take*>& takes, const Progress& progress)
      : takes_(takes), progress_(progress), told_(takes.size()), outlines_(takes.size()) {
    for (const Take* take : takes) all_ += static_cast<double>(take->frames) * stages_;
  }

  void go(int threads) {
    parallel_for(threads, threads, [&](int begin, int) { begin == 0 ? lead() : follow(); });
  }

  const std::vector<Outline>& outlines() const { return outlines_; }
  std::vector<Examination>& told() { return told_; }

 private:
  const int stages_ = static_cast<int>(checks().size()) + 1;  // of a take

  void lead() {
    try {
      work([&] { tell(); });
      std::unique_lock lock(mutex_);
      while (busy_ > 0) {
        ended_.wait_for(lock, std::chrono::milliseconds(50));
        lock.unlock();
        tell();
        lock.lock();
      }
    } catch (...) {
      is_over_ = true;
      throw;
    }
  }

  void follow() {
    work([&] {
      if (is_over_) throw Cancelled();
    });
  }

  void tell() const { report(progress_, static_cast<double>(done_) / all_, "Examining takes"); }

  void work(const Patient::Tick& tick) {
    while (const std::optional<std::size_t> take = next()) {
      try {
        examine(*take, tick);
      } catch (...) {
        end();
        throw;
      }
      end();
    }
  }

  std::optional<std::size_t> next() {
    const std::scoped_lock lock(mutex_);
    if (next_ == takes_.size()) return std::nullopt;
    ++busy_;
    return next_++;
  }

  void end() {
    const std::scoped_lock lock(mutex_);
    --busy_;
    ended_.notify_all();
  }

  void examine(std::size_t take, const Patient::Tick& tick) {
    Patient patient(*takes_[take], tick);
    Findings findings;
    Examination& told = told_[take];
    for (std::size_t i = 0; i < checks().size(); ++i) {
      tick();
      apply(checks()[i], patient, findings);
      if (i == 0) told = described(patient);
      done_ += takes_[take]->frames;
    }
    told.stature = patient.stature();
    told.scale = patient.unit() / takes_[take]->unit;
    told.root_motion =
        std::none_of(findings.begin(), findings.end(), [](const Finding& f) { return f.code == "in_place"; });
    told.findings = std::move(findings);
    outlines_[take] = outline_of(patient);
    done_ += takes_[take]->frames;
  }

  const std::vector<const Take*>& takes_;
  const Progress& progress_;
  std::vector<Examination> told_;
  std::vector<Outline> outlines_;
  double all_ = 0;                     // frames times stages
  std::atomic<std::int64_t> done_{0};  // of these
  std::atomic<bool> is_over_{false};
  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t next_ = 0;
  int busy_ = 0;
};

}  // namespace

const std::vector<std::string>& finding_codes() {
  static const std::vector<std::string> codes = {"missing", "unit",    "up",     "mirrored",    "facing",   "flip",
                                                 "spike",   "doubled", "frozen", "calibration", "dropped",  "jump",
                                                 "ground",  "slope",   "axes",   "drift",       "in_place", "noise",
                                                 "rate",    "size",    "body",   "short",       "duplicate"};
  return codes;
}

std::vector<Examination> examine(const std::vector<const Take*>& takes, int threads, const Progress& progress) {
  Rounds rounds(takes, progress);
  rounds.go(std::min(thread_count(threads), std::max(1, static_cast<int>(takes.size()))));
  find_duplicates(takes, rounds.outlines(), thread_count(threads), progress, rounds.told());
  return std::move(rounds.told());
}

std::vector<Examination> examine(const std::vector<Take>& takes, int threads, const Progress& progress) {
  std::vector<const Take*> each;
  for (const Take& take : takes) each.push_back(&take);
  return examine(each, threads, progress);
}

}  // namespace fragmotion
