// SPDX-License-Identifier: MIT
#include "doctor/duplicates.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.hpp"
#include "base/rates.hpp"
#include "doctor/lengths.hpp"

namespace fragmotion {
namespace {

constexpr int kAnchors = 8;         // poses of the shorter take that are looked for in the longer
constexpr double kSame = 0.015;     // m: root mean square of the points, of a character of 1.8 m
constexpr double kOfMotion = 0.15;  // of how far the points move in the take
constexpr double kSpeeds = 0.1;     // share by which one copy may be faster
constexpr int kSlack = 2;           // frames
constexpr double kOverlap = 0.6;    // of the shorter take, and of its anchors

constexpr int kNumbers = std::tuple_size_v<Shape>;

float distance(const Shape& a, const Shape& b, float most) {
  float sum = 0;
  for (int i = 0; i < kNumbers && sum <= most; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

Shape shape_of(const Patient& patient, int frame) {
  const Vector3 hips = patient.head(frame, patient.hips);
  Vector3 right = patient.head(frame, patient.legs[1].top) - patient.head(frame, patient.legs[0].top);
  right = Vector3{right.x(), right.y(), 0}.normalized();
  const Vector3 ahead = Vector3::UnitZ().cross(right);
  Shape shape = {};
  int at = 0;
  const Limb3* fore = patient.is_four_legged() ? &patient.legs[2] : patient.arms.data();
  for (const int bone : {patient.legs[0].end, patient.legs[1].end, fore[0].end, fore[1].end, patient.skull}) {
    const Vector3 way =
        patient.scale() * (bone < 0 ? Vector3::Zero().eval() : Vector3{patient.head(frame, bone) - hips});
    for (const double value : {way.dot(right), way.dot(ahead), way.z()}) shape[at++] = static_cast<float>(value);
  }
  return shape;
}

Shape between(const Shape& a, const Shape& b, float weight) {
  Shape shape;
  for (int i = 0; i < kNumbers; ++i) shape[i] = (1 - weight) * a[i] + weight * b[i];
  return shape;
}

float spread_of(const std::vector<Shape>& shapes) {
  Shape mean = {};
  for (const Shape& shape : shapes) {
    for (int i = 0; i < kNumbers; ++i) mean[i] += shape[i] / static_cast<float>(shapes.size());
  }
  float sum = 0;
  for (const Shape& shape : shapes) sum += distance(shape, mean, INFINITY);
  return sum / static_cast<float>(shapes.size());
}

bool has_outline(const Patient& patient) {
  return patient.is_finite() && patient.has_legs() && patient.hips >= 0 && patient.scale() > 0;
}

/// Where a pose of a take is in another one: frame a of one is frame b of the other.
struct Match {
  int a = 0, b = 0;
};

std::optional<int> nearest(const Shape& shape, const std::vector<Shape>& shapes, float near) {
  std::optional<int> best;
  for (int f = 0; f < static_cast<int>(shapes.size()); ++f) {
    const float d = distance(shape, shapes[f], near);
    if (d < near) near = d, best = f;
  }
  return best;
}

std::vector<Match> matches_of(const Outline& shorter, const Outline& longer) {
  std::vector<Match> matches;
  const int frames = static_cast<int>(shorter.shapes.size());
  for (int i = 0; i < kAnchors; ++i) {
    if (static_cast<int>(matches.size()) + kAnchors - i < kOverlap * kAnchors) return {};
    const int a = static_cast<int>((i + 0.5) * frames / kAnchors);
    if (const auto b = nearest(shorter.shapes[a], longer.shapes, shorter.near)) matches.push_back({a, *b});
  }
  return matches;
}

/// The share of the shorter take whose poses the longer one goes through in its time, or hardly faster or slower; 0
/// where they are other poses, or few.
double shared_along(const Outline& shorter, const Outline& longer, const Match& first, double speed) {
  if (std::abs(speed - 1) > kSpeeds) return 0;
  const int frames = static_cast<int>(shorter.shapes.size()), end = static_cast<int>(longer.shapes.size());
  int shared = 0;
  double sum = 0;
  for (int a = 0; a < frames; ++a) {
    const int b = static_cast<int>(std::lround(first.b + speed * (a - first.a)));
    if (b < 0 || b >= end) continue;
    float best = INFINITY;
    for (int c = std::max(0, b - kSlack); c <= std::min(end - 1, b + kSlack); ++c)
      best = std::min(best, distance(shorter.shapes[a], longer.shapes[c], best));
    sum += best;
    ++shared;
  }
  const double share = static_cast<double>(shared) / frames;
  return share >= kOverlap && sum <= shorter.near * shared ? share : 0;
}

double shared_motion(const Outline& shorter, const Outline& longer) {
  if (static_cast<double>(shorter.shapes.size()) < kShortestStep * kPoseRate) return 0;
  const std::vector<Match> matches = matches_of(shorter, longer);
  if (static_cast<int>(matches.size()) < kOverlap * kAnchors) return 0;
  const Match &first = matches.front(), &last = matches.back();
  double share = shared_along(shorter, longer, first, static_cast<double>(last.b - first.b) / (last.a - first.a));
  // Where steps are all alike, the poses of one may be found in another.
  for (const Match& match : matches) share = std::max(share, shared_along(shorter, longer, match, 1));
  return share;
}

/// Of two takes with the same motion the shorter one is a duplicate; of two that are as long, the later one.
double shared_with(const std::vector<Outline>& outlines, int take, int other) {
  const std::size_t a = outlines[take].shapes.size(), b = outlines[other].shapes.size();
  if (take == other || a > b || (a == b && take < other)) return 0;
  return shared_motion(outlines[take], outlines[other]);
}

Finding duplicate(const std::vector<const Take*>& takes, int take, int other, double share) {
  const std::string percent = std::to_string(std::lround(100 * share));
  const std::string part = percent == "100" ? "its motion" : percent + " % of its motion";
  Finding finding = mendable(found("duplicate", Severity::kWarning, 0, takes[take]->frames - 1,
                                   part + " is in take '" + takes[other]->name +
                                       "', too: it counts twice in what is learned; leave one of them out"),
                             false);
  finding.other = other;
  return finding;
}

}  // namespace

Outline outline_of(const Patient& patient) {
  if (!has_outline(patient)) return {};
  Outline outline;
  const int last = patient.frames() - 1;
  for (double at = 0; at <= last; at += patient.rate() / kPoseRate) {
    const int f = static_cast<int>(at);
    const Shape shape = shape_of(patient, f), next = shape_of(patient, std::min(f + 1, last));
    outline.shapes.push_back(between(shape, next, static_cast<float>(at - f)));
  }
  outline.near =
      static_cast<float>(std::min(kNumbers / 3.0 * kSame * kSame, kOfMotion * kOfMotion * spread_of(outline.shapes)));
  return outline;
}

void find_duplicates(const std::vector<const Take*>& takes, const std::vector<Outline>& outlines, int threads,
                     const Progress& progress, std::vector<Examination>& told) {
  const int count = static_cast<int>(takes.size());
  parallel_for(count, threads, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      if (begin == 0) report(progress, 1, "Comparing takes");
      double share = 0;
      int other = -1;
      while (share == 0 && ++other < count) share = shared_with(outlines, i, other);
      if (share > 0) told[i].findings.push_back(duplicate(takes, i, other, share));
    }
  });
}

}  // namespace fragmotion
