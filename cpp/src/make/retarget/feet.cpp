// SPDX-License-Identifier: MIT
#include "retarget/feet.hpp"

#include <cmath>

#include "motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kSmooth = 0.15;  // s, before and after: over which hips sink or rise

struct Run {
  int begin = 0, end = 0;  // first and last frame
  double mean = 0;
};

std::vector<Run> runs_of(const std::vector<bool>& stands, const std::vector<double>& headings) {
  std::vector<Run> runs;
  for (int f = 0; f < static_cast<int>(stands.size()); ++f) {
    if (!stands[f]) continue;
    if (f == 0 || !stands[f - 1]) runs.push_back({f, f, 0});
    runs.back().end = f;
    runs.back().mean += headings[f];
  }
  for (Run& run : runs) run.mean /= run.end - run.begin + 1;
  return runs;
}

// What `pick` picks of the values in a window around each frame.
template <typename Pick>
std::vector<double> filtered(const std::vector<double>& values, int reach, const Pick& pick) {
  std::vector<double> result(values.size());
  const int last = static_cast<int>(values.size()) - 1;
  for (int f = 0; f <= last; ++f) {
    result[f] = pick(values.begin() + std::max(0, f - reach), values.begin() + std::min(last, f + reach) + 1);
  }
  return result;
}

using Value = std::vector<double>::const_iterator;

double mean_of(Value begin, Value end) {
  double sum = 0;
  for (auto value = begin; value != end; ++value) sum += *value;
  return sum / static_cast<double>(end - begin);
}

}  // namespace

double knee_bend(const Leg& leg, const PosedBones& posed) {
  const Vector3 upper = posed.heads[leg.knee] - posed.heads[leg.thigh],
                lower = posed.heads[leg.foot] - posed.heads[leg.knee];
  return std::atan2(upper.cross(lower).norm(), upper.dot(lower));
}

Reach reach_of(const Leg& leg, const PosedBones& posed, const KneeRange& range) {
  const double upper = (posed.heads[leg.knee] - posed.heads[leg.thigh]).norm(),
               lower = (posed.heads[leg.foot] - posed.heads[leg.knee]).norm();
  const auto apart = [&](double bend) {
    return std::sqrt(std::max(0.0, upper * upper + lower * lower + 2 * upper * lower * std::cos(bend)));
  };
  return {apart(range.most), apart(range.least)};
}

LegMotion::LegMotion(const Body& body, const Clip& clip) : paths(foot_paths(body.kinematics, clip)) {
  const std::vector<int> bones = body.kinematics.chains({body.legs[0].foot, body.legs[1].foot});
  PosedBones posed(body.kinematics.bones());
  for (int f = 0; f < clip.frames; ++f) {
    world(body.kinematics, clip, f, bones, posed.heads.data(), posed.rotations.data());
    for (int side = 0; side < 2; ++side) knees[side].add(knee_bend(body.legs[side], posed));
  }
}

std::vector<double> held_headings(const std::vector<bool>& stands, const std::vector<double>& headings) {
  const std::vector<Run> runs = runs_of(stands, headings);
  if (runs.empty()) return headings;
  std::vector<double> held(headings.size());
  std::size_t next = 0;
  for (int f = 0; f < static_cast<int>(held.size()); ++f) {
    while (next + 1 < runs.size() && f > runs[next].end) ++next;
    const Run& to = runs[next];
    const Run& from = next > 0 ? runs[next - 1] : to;
    const double t = f >= to.begin ? 1 : static_cast<double>(f - from.end) / (to.begin - from.end);
    held[f] = from.mean + (to.mean - from.mean) * ease_in_ease_out(t);
  }
  return held;
}

std::vector<double> smooth_moves(const std::vector<double>& least, const std::vector<double>& most, double rate) {
  std::vector<double> down(most.size()), up(most.size());
  for (std::size_t f = 0; f < most.size(); ++f) {
    down[f] = std::min(0.0, most[f]);
    up[f] = std::max(0.0, std::min(least[f], most[f]));
  }
  const int reach = static_cast<int>(std::lround(kSmooth * rate));
  down = filtered(filtered(down, reach, [](Value a, Value b) { return *std::min_element(a, b); }), reach, mean_of);
  up = filtered(filtered(up, reach, [](Value a, Value b) { return *std::max_element(a, b); }), reach, mean_of);
  for (std::size_t f = 0; f < down.size(); ++f) down[f] += up[f];
  return down;
}

}  // namespace fragmotion
