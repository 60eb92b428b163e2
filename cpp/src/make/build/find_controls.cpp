// SPDX-License-Identifier: MIT
#include "build/find_controls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/quantile.hpp"
#include "base/rounding.hpp"
#include "control/gaits.hpp"
#include "fragments/speed_range.hpp"
#include "motion/contacts.hpp"
#include "motion/gait_scale.hpp"

namespace fragmotion {
namespace {

// A run is at least so much faster than a walk, unless nothing goes between them, and a speed that is looked for than
// the one before it.
constexpr double kTwoGaits = 1.6;
// So far apart are the halves of what is spread evenly, which is the flattest that has one mode.
const double kOneMode = std::sqrt(12);
// A speed that is asked for is at least so much faster than the one before it, and its fragments differ by no more.
constexpr double kApart = 1.2;
constexpr double kGroup = 0.02;  // of what goes, that a speed has at least
constexpr int kFew = 3, kOneIn = 200;
constexpr double kMostOf = 0.75;  // of so many directions: as good as all
constexpr int kRounds = 100;

// Sorted values in two clusters.
struct Clusters {
  double slow = 0, fast = 0;  // their means
  // Ashman's D, their distance over their spread (K. Ashman et al., Astronomical J. 108, 1994); 0 where one is of few.
  double apart = 0;
};

double spread_of(const double* begin, const double* end, double mean) {
  const double squares =
      std::accumulate(begin, end, 0.0, [&](double sum, double value) { return sum + (value - mean) * (value - mean); });
  return squares / static_cast<double>(end - begin);
}

// Split best, by the least squares.
Clusters two_clusters(const std::vector<double>& sorted) {
  const double total = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  double best = -1, low = 0;
  std::size_t at = 0;
  Clusters found{sorted.front(), sorted.back()};
  for (std::size_t split = 1; split < sorted.size(); ++split) {
    low += sorted[split - 1];
    const double a = low / static_cast<double>(split), b = (total - low) / static_cast<double>(sorted.size() - split);
    const double between = (b - a) * (b - a) * static_cast<double>(split) * static_cast<double>(sorted.size() - split);
    if (between > best) best = between, at = split, found = {a, b};
  }
  if (static_cast<double>(std::min(at, sorted.size() - at)) < kGroup * static_cast<double>(sorted.size())) return found;
  const double *begin = sorted.data(), *end = begin + sorted.size();
  const double spread = spread_of(begin, begin + at, found.slow) + spread_of(begin + at, end, found.fast);
  if (at > 0) found.apart = (found.fast - found.slow) * std::sqrt(2 / std::max(spread, kRounding));
  return found;
}

// Speeds, m/s of a 1.8 m character, of what goes and does not jump; sorted.
std::vector<double> going_speeds(const std::vector<Control>& evident, double scale) {
  std::vector<double> speeds;
  for (const Control& ev : evident) {
    const double speed = ev.speed() * scale;
    if (speed > kMoving && !ev.jumps()) speeds.push_back(speed);
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

// Those that go straight ahead: who turns, or goes aside or back, is slower.
std::vector<Control> straight_ahead(const std::vector<Control>& evident) {
  const double unit = ControlSpace().turn_rate();
  std::vector<Control> ahead;
  std::copy_if(evident.begin(), evident.end(), std::back_inserter(ahead),
               [&](const Control& ev) { return goes_straight_ahead(ev, unit); });
  return ahead;
}

double mean_of(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  return std::accumulate(values.begin() + begin, values.begin() + end, 0.0) / static_cast<double>(end - begin);
}

// The mean of sorted values within a range, or `usual` where there is none.
double mean_within(const std::vector<double>& sorted, double least, double most, double usual) {
  const auto begin = std::lower_bound(sorted.begin(), sorted.end(), least) - sorted.begin(),
             end = std::upper_bound(sorted.begin() + begin, sorted.end(), most) - sorted.begin();
  return begin == end ? usual : mean_of(sorted, begin, end);
}

// Of the gaits that `speeds` fall into how fast those are of them that go `ahead`. `least`: from where on it is no
// shuffle.
std::vector<double> two_gaits(const std::vector<double>& speeds, const std::vector<double>& ahead, double least) {
  const double walk = kGaits[kWalk].speed, jog = kGaits[kJog].speed, run = kGaits[kRun].speed;
  if (speeds.empty()) return {walk, run};
  const auto [slow, fast, apart] = two_clusters(speeds);
  const auto walking = std::lower_bound(speeds.begin(), speeds.end(), least);
  if (slow < least && walking != speeds.end()) return two_gaits({walking, speeds.end()}, ahead, least);
  const double between = (slow + fast) / 2;
  if (fast > (apart > kOneMode ? kApart : kTwoGaits) * slow)
    return {mean_within(ahead, speeds.front(), between, slow), mean_within(ahead, between, speeds.back(), fast)};
  const double mean = mean_of(speeds, 0, speeds.size());
  return mean < jog ? std::vector{mean, mean * (run / walk)} : std::vector{mean / (run / walk), mean};
}

double turn_rate(const std::vector<Control>& evident) {
  const double unit = ControlSpace().turn_rate();
  std::vector<double> rates;
  for (const Control& ev : evident) {
    if (is_turning(ev, unit)) rates.push_back(std::abs(ev.turn) * unit);
  }
  if (rates.size() * 20 < evident.size() || rates.empty()) return unit;
  return quantile(std::move(rates), 0.75);
}

struct Group {
  double mean = 0;
  std::size_t count = 0;
};

// Sorted speeds in groups by k-means, where what is near is near as a ratio; none where a group is left empty.
std::vector<Group> groups_of(const std::vector<double>& sorted, int count) {
  std::vector<std::size_t> ends(count + 1);
  for (int i = 0; i <= count; ++i) ends[i] = sorted.size() * i / count;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Group> groups;
    for (int i = 0; i < count; ++i) {
      if (ends[i] == ends[i + 1]) return {};
      groups.push_back({mean_of(sorted, ends[i], ends[i + 1]), ends[i + 1] - ends[i]});
    }
    const std::vector<std::size_t> before = ends;
    for (int i = 1; i < count; ++i) {
      const double between = std::sqrt(groups[i - 1].mean * groups[i].mean);
      ends[i] = std::upper_bound(sorted.begin(), sorted.end(), between) - sorted.begin();
    }
    if (ends == before || round + 1 == kRounds) return groups;
  }
  return {};
}

bool are_apart(const std::vector<Group>& groups, std::size_t all, double ratio) {
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (static_cast<double>(groups[i].count) < kGroup * static_cast<double>(all)) return false;
    if (i > 0 && groups[i].mean < ratio * groups[i - 1].mean) return false;
  }
  return !groups.empty();
}

// Up to so many speeds that differ by a ratio; the gait of most where that is one.
std::vector<double> speeds_apart(const std::vector<double>& sorted, int most, double ratio) {
  for (int count = most; count > 1; --count) {
    const std::vector<Group> groups = groups_of(sorted, count);
    if (!are_apart(groups, sorted.size(), ratio)) continue;
    std::vector<double> speeds;
    for (const Group& group : groups) speeds.push_back(group.mean);
    return speeds;
  }
  if (sorted.empty()) return {};
  const std::vector<Group> gaits = groups_of(sorted, 2);
  if (!are_apart(gaits, sorted.size(), kTwoGaits)) return {mean_of(sorted, 0, sorted.size())};
  return {gaits[0].count >= gaits[1].count ? gaits[0].mean : gaits[1].mean};
}

// So many speeds: those that there are, and between them what people go at.
std::vector<double> filled(const std::vector<double>& held, int count) {
  static const std::vector<double> usual[kMostSpeeds] = {{1.2}, {1.2, 3.3}, {1.2, 2.2, 3.3}, {0.7, 1.2, 2.2, 3.3}};
  std::vector<double> speeds = usual[count - 1];
  const std::vector<int> places = matched(held, speeds);
  for (std::size_t i = 0; i < held.size(); ++i) speeds[places[i]] = held[i];
  return speeds;
}

bool are_few(std::size_t count, std::size_t all) { return count < kFew || count * kOneIn < all; }

bool goes(const Control& ev, double scale) { return ev.speed() * scale > kMoving && !ev.jumps(); }

// The directions, of so many, that fragments go in.
int directions_of(const std::vector<Control>& evident, double scale, int directions) {
  std::array<std::size_t, kMostDirections> counts{};
  std::size_t all = 0;
  for (const Control& ev : evident) {
    if (!goes(ev, scale)) continue;
    const auto nearest = static_cast<int>(std::lround(std::atan2(-ev.x, ev.y) * directions / (2 * kPi)));
    ++counts[(nearest + directions) % directions], ++all;
  }
  return static_cast<int>(std::count_if(counts.begin(), counts.begin() + directions,
                                        [&](std::size_t count) { return !are_few(count, all); }));
}

int speeds_of(const std::vector<Control>& evident, const ControlSpace& space) {
  const std::vector<double> going = going_speeds(evident, space.scale());
  int held = 0;
  for (const double speed : space.speeds()) {
    const double wanted = speed * space.scale();
    const auto slow = std::lower_bound(going.begin(), going.end(), wanted / kApart),
               fast = std::upper_bound(going.begin(), going.end(), wanted * kApart);
    if (!are_few(fast - slow, going.size())) ++held;
  }
  return held;
}

// Whether there are enough fragments of which something is so.
template <typename Is>
bool show(const std::vector<Control>& evident, const Is& is) {
  const auto count = static_cast<std::size_t>(std::count_if(evident.begin(), evident.end(), is));
  return !are_few(count, evident.size());
}

bool show_jumps(const std::vector<Control>& evident) {
  return show(evident, [](const Control& ev) { return ev.jumps(); });
}

bool show_turns(const std::vector<Control>& evident, double turn_rate) {
  return show(evident, [=](const Control& ev) { return is_turning(ev, turn_rate); });
}

// As many directions as have takes in nearly all of them.
int found_directions(const std::vector<Control>& evident, double scale) {
  for (const int directions : {16, 8}) {
    if (directions_of(evident, scale, directions) >= kMostOf * directions) return directions;
  }
  return 4;
}

}  // namespace

ControlSpace control_space_of(const std::vector<Control>& evident, double scale, const ControlOptions& options) {
  const std::vector<double> going = going_speeds(evident, scale);
  ControlLayout layout = options.layout;
  check(layout);
  if (options.find) {
    const std::vector<double> found = speeds_apart(going, kMostSpeeds, kTwoGaits);
    if (!found.empty()) layout.speeds = static_cast<int>(found.size());
    layout.directions = found_directions(evident, scale);
    layout.turn = show_turns(evident, ControlSpace().turn_rate());
    layout.jump = show_jumps(evident);
  }
  const double ratio = options.find ? kTwoGaits : kApart;
  std::vector<double> speeds = layout.speeds == 2 ? two_gaits(going, going_speeds(straight_ahead(evident), scale),
                                                              kWalking * scale / gait_scale(scale))
                                                  : filled(speeds_apart(going, layout.speeds, ratio), layout.speeds);
  for (double& speed : speeds) speed /= scale;
  return {layout, std::move(speeds), turn_rate(evident), scale};
}

ControlSpace usual_space(const ControlOptions& options) {
  return options.find ? ControlSpace() : control_space_of({}, 1, options);
}

HeldControls held_controls(const std::vector<Control>& evident, const ControlSpace& space) {
  return {speeds_of(evident, space), directions_of(evident, space.scale(), space.layout().directions),
          show_turns(evident, space.turn_rate()), show_jumps(evident)};
}

}  // namespace fragmotion
