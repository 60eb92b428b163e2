// SPDX-License-Identifier: MIT
#include "fragments/synthesis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/memo.hpp"
#include "base/parallel.hpp"
#include "base/quantile.hpp"
#include "base/ranges.hpp"
#include "base/rounding.hpp"
#include "fragments/blend.hpp"
#include "fragments/borne_gaits.hpp"
#include "fragments/closed_cycles.hpp"
#include "fragments/coverage.hpp"
#include "fragments/distance.hpp"
#include "fragments/gait_edit.hpp"
#include "fragments/leap.hpp"
#include "fragments/speed_range.hpp"
#include "fragments/standing.hpp"
#include "fragments/successors.hpp"
#include "motion/contacts.hpp"
#include "motion/cycle.hpp"
#include "motion/foot_paths.hpp"
#include "motion/legs.hpp"

namespace fragmotion {
namespace {

constexpr int kWanted = 4;                       // fragments that should perform each control
constexpr double kTail = 0.3;                    // s kept beyond a fragment's end, for stitching
constexpr double kJumpHeight = 0.22;             // m, of a 1.8 m character
constexpr double kLeastDip = 0.16;               // m that it crouches for a jump on the spot where no take jumps,
constexpr double kMostDip = 0.3;                 // and at most where takes do
constexpr double kCrouching = 0.5;               // s before a jump in which takes crouch
constexpr double kRunningDip = 0.6;              // of that dip, as it runs
constexpr double kSinking = 0.2;                 // s into a crouch; half of that as it runs
constexpr double kSimilar = 2.52 / kTunedReach;  // m a metre of reach: fragments this near may be interpolated
constexpr int kCandidates = 24;                  // neighbours of a control that interpolation tries in pairs
constexpr double kMostTempo = 1.2;  // the most by which steps are hurried: for speed, sideways, for legs to bear it
constexpr double kStandSeconds = 0.5;
constexpr int kStands = 48;  // fragments that stand, one after the other, until they begin again

double angle_between(const Control& a, const Control& b) {
  return wrapped(std::atan2(b.y, b.x) - std::atan2(a.y, a.x));
}

Control mix(const Control& a, const Control& b, double w) {
  return {a.x + w * (b.x - a.x), a.y + w * (b.y - a.y), a.turn + w * (b.turn - a.turn), a.jump + w * (b.jump - a.jump)};
}

// Adds a fragment that stands in place, for others to be made of.
void add_standing(FragmentPool& pool) {
  const Kinematics kinematics(pool.skeleton);
  const double rate = pool.clips[0].rate;
  Fragment fragment;
  fragment.clip = static_cast<int>(pool.clips.size());
  fragment.end = std::max(1, static_cast<int>(std::lround(kStandSeconds * rate)));
  fragment.origin = Origin::transformed;
  const int frames = fragment.end + 1 + static_cast<int>(std::lround(kTail * rate));
  pool.clips.push_back(
      make_clip(pool.skeleton, standing(kinematics, find_legs(kinematics, pool.clips), pool, frames, rate)));
  pool.fragments.push_back(fragment);
}

// Adds a take of a character that stands for long, fragment after fragment, as this clip.
void add_living_stand(FragmentPool& pool, const ControlSpace& space, double usual, int into) {
  const Kinematics kinematics(pool.skeleton);
  const double rate = pool.clips[0].rate;
  const int length = std::max(1, static_cast<int>(std::lround(kStandSeconds * rate))), cycle = kStands * length,
            frames = cycle + 1 + static_cast<int>(std::lround(kTail * rate));
  Clip clip = living_stand(kinematics, find_legs(kinematics, pool.clips), pool, cycle, frames, rate);
  const BodyMotion motion = body_motion(kinematics, clip);
  for (int begin = 0; begin < cycle; begin += length) {
    Fragment fragment;
    fragment.clip = into;
    fragment.begin = begin;
    fragment.end = begin + length;
    fragment.origin = Origin::transformed;
    fragment.evident = evident_control(motion, rate, begin, begin + length, usual, space);
    pool.fragments.push_back(fragment);
  }
  pool.clips.resize(std::max(pool.clips.size(), std::size_t{1} + into));
  pool.clips[into] = make_clip(pool.skeleton, std::move(clip));
}

bool stands(const Fragment& f, const ControlSpace& space) { return !space.asks_to_go(f.evident) && !f.evident.jumps(); }

// Whether the takes show long enough how the body stands: in fragments that follow each other, hardly move, and stay
// where they are together, though it shifts its weight in each; or in a whole clip that ends as it begins.
bool takes_stand(const FragmentPool& pool, const std::vector<int>& next, const ControlSpace& space) {
  const Kinematics kinematics(pool.skeleton);
  for (std::size_t first = 0; first < next.size(); ++first) {
    const int begin = pool.fragments[first].begin;
    Control gone{0, 0, 0, 0};
    double seconds = 0;
    for (int f = static_cast<int>(first); f >= 0 && stands(pool.fragments[f], space); f = next[f]) {
      const Fragment& fragment = pool.fragments[f];
      const double more = pool.seconds(fragment);
      gone = mix(gone, fragment.evident, more / (seconds + more));
      seconds += more;
      if (space.distance(gone, {}) > kPerformed) continue;
      const Clip& clip = pool.clips[fragment.clip];
      const bool is_whole = begin == 0 && fragment.end == clip.frames - 1;
      if (seconds >= kStandsLong || (is_whole && cycle_of(kinematics, clip) > 0)) return true;
    }
  }
  return false;
}

// Fills the holes of a pool's control space.
class Synthesizer {
 public:
  // `next`: successors() of the fragments.
  Synthesizer(FragmentPool& pool, std::vector<int> next, std::size_t takes, const ControlSpace& space, double usual,
              double longest, int threads, const Trajectories& known)
      : pool_(pool),
        space_(space),
        usual_(usual),
        longest_(longest),
        threads_(thread_count(threads)),
        kinematics_(pool.skeleton),
        legs_(find_legs(kinematics_, pool.clips)),
        trajectories_(trajectories(pool, kPoses, threads, known)),
        borne_gaits_(kinematics_, legs_, pool, kMostTempo, threads),
        originals_(static_cast<int>(pool.fragments.size())),
        next_(std::move(next)),
        cycles_(closed_cycles(pool, trajectories_, space, takes)) {
    find_dip();
  }

  // Who stands does so as the takes do, or as living_stand().
  void fill() {
    const int stand = space_.nearest({});
    const SpeedRange speeds(pool_.fragments, space_);
    const ControlLayout& layout = space_.layout();
    const int points = layout.turns() * layout.jumps();  // of a velocity, which are made of the same gaits
    auto made = parallel_map(layout.velocities(), threads_, [&](int velocity) {
      Additions additions;
      for (int c = points * velocity; c < points * (velocity + 1); ++c) {
        const Control able = speeds.within(space_.point(c));
        if (c == stand || space_.nearest(able) != c) continue;
        const int missing = std::max(0, kWanted - performers(able));
        if (missing > 0) interpolate(able, missing, additions);
        if (missing > 0 || !(able.jumps() || is_gait(able))) transform(able, additions);
      }
      return additions;
    });
    for (Additions& additions : made) add(std::move(additions));
  }

 private:
  // A clip, and its fragments, which do not know the clip's number yet.
  struct Addition {
    Clip clip;
    std::vector<Fragment> fragments;
  };
  using Additions = std::vector<Addition>;

  double distance(int fragment, const Control& control) const {
    return space_.distance(pool_.fragments[fragment].evident, control);
  }

  int performers(const Control& control) const {
    int count = 0;
    for (int i = 0; i < originals_; ++i) count += distance(i, control) <= kPerformed ? 1 : 0;
    return count;
  }

  // Whether two fragments that follow each other in a take, a left and a right step, perform a control together.
  bool is_gait(const Control& control) const {
    for (int i = 0; i < originals_; ++i) {
      if (next_[i] < 0) continue;
      const Control both = mix(pool_.fragments[i].evident, pool_.fragments[next_[i]].evident, 0.5);
      if (space_.distance(both, control) <= kPerformed) return true;
    }
    return false;
  }

  // Frames kept beyond a fragment's end.
  int tail(double rate) const { return static_cast<int>(std::lround(kTail * rate)); }

  // A clip whose frames ends[i] .. ends[i + 1] are fragments.
  Addition addition(Clip clip, const std::vector<int>& ends, Origin origin) const {
    const BodyMotion motion = body_motion(kinematics_, clip);
    return addition(std::move(clip), motion, ends, origin);
  }

  Addition addition(Clip clip, const BodyMotion& motion, const std::vector<int>& ends, Origin origin) const {
    Addition made;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      Fragment fragment;
      fragment.begin = ends[i];
      fragment.end = ends[i + 1];
      fragment.origin = origin;
      fragment.evident = evident_control(motion, clip.rate, ends[i], ends[i + 1], usual_, space_);
      made.fragments.push_back(fragment);
    }
    made.clip = make_clip(pool_.skeleton, std::move(clip));
    return made;
  }

  void add(Additions made) {
    for (Addition& each : made) {
      for (Fragment& fragment : each.fragments) {
        fragment.clip = static_cast<int>(pool_.clips.size());
        pool_.fragments.push_back(fragment);
      }
      pool_.clips.push_back(std::move(each.clip));
    }
  }

  std::vector<int> nearest_originals(const Control& control) const {
    std::vector<int> order(originals_);
    for (int i = 0; i < originals_; ++i) order[i] = i;
    const int count = std::min(kCandidates, originals_);
    std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](int a, int b) {
      const double da = distance(a, control), db = distance(b, control);
      return da != db ? da < db : a < b;
    });
    order.resize(count);
    return order;
  }

  struct Pair {
    int a, b;
    double weight, distance;
  };

  // The weight in [0, 1] that brings (1 - w) Ev(a) + w Ev(b) nearest to the control.
  Pair pair_for(int a, int b, const Control& control) const {
    Pair best{a, b, 0, std::numeric_limits<double>::infinity()};
    for (int i = 1; i < 10; ++i) {
      const double w = 0.1 * i;
      const double d = space_.distance(mix(pool_.fragments[a].evident, pool_.fragments[b].evident, w), control);
      if (d < best.distance) best.weight = w, best.distance = d;
    }
    return best;
  }

  // Interpolates up to `count` pairs of similar fragments that together perform the control.
  void interpolate(const Control& control, int count, Additions& additions) const {
    const auto similar = static_cast<float>(kSimilar * kPoses * trajectories_.reach);
    const std::vector<int> near = nearest_originals(control);
    std::vector<Pair> pairs;
    for (const int a : near) {
      for (const int b : near) {
        if (a >= b) continue;
        const Pair pair = pair_for(a, b, control);
        if (pair.distance > kPerformed || fragment_distance(trajectories_, a, b) > similar) continue;
        pairs.push_back(pair);
      }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
      return p.distance != q.distance ? p.distance < q.distance : p.a != q.a ? p.a < q.a : p.b < q.b;
    });
    const int used = std::min(count, static_cast<int>(pairs.size()));
    for (int i = 0; i < used; ++i) {
      const Fragment a = pool_.fragments[pairs[i].a], b = pool_.fragments[pairs[i].b];
      const int frames = tail(pool_.clips[a.clip].rate);
      Clip clip = interpolated(kinematics_, pool_, a, b, pairs[i].weight, frames);
      const int end = clip.frames - 1 - frames;
      additions.push_back(addition(std::move(clip), {0, end}, Origin::interpolated));
    }
  }

  // The median dip of the takes' hips, under their usual height, before a jump.
  void find_dip() {
    std::vector<double> heights, dips;
    for (const Clip& clip : pool_.clips) {
      for (int f = 0; f < clip.frames; ++f) heights.push_back(clip.root_positions[std::size_t{3} * f + 2]);
    }
    const double usual = median(std::move(heights));
    for (const Fragment& f : pool_.fragments) {
      if (!f.evident.jumps()) continue;
      const Clip& clip = pool_.clips[f.clip];
      double lowest = usual;
      for (int at = std::max(0, f.begin - static_cast<int>(kCrouching * clip.rate)); at <= f.begin; ++at)
        lowest = std::min(lowest, clip.root_positions[std::size_t{3} * at + 2]);
      dips.push_back((usual - lowest) * space_.scale());
    }
    takes_jump_ = !dips.empty();
    if (takes_jump_) dip_ = std::clamp(median(std::move(dips)), kLeastDip, kMostDip);
  }

  // What it costs a cycle's looks to be made to perform a control, if that is less than `most`. Whether it jumps makes
  // no difference: what hops is made of what goes, so that the one follows the other.
  double effort(const ClosedCycle& cycle, const Control& control, double most) const {
    const Control& ev = cycle.evident;
    const double moving = kMoving / space_.scale();
    const bool moves = ev.speed() > moving, wants = control.speed() > moving, steps = wants || control.turn != 0;
    if (moves != steps) return std::numeric_limits<double>::infinity();
    double effort = kFlawed * cycle.flaw + effort_of_turn(ev, control) + 2 * ev.jump;
    if (cycle.backward()) ++effort;
    if (steps && !wants) effort += ev.speed() / space_.walk();  // it steps in place
    if (wants && effort < most) {
      effort += effort_of_direction(ev, control) + effort_of_speed(control.speed() / ev.speed());
    }
    return effort;
  }

  // The cycle that performs the control with the least effort, the first of those that are alike but for rounding.
  const ClosedCycle* cheapest(const Control& control) const {
    const ClosedCycle* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const ClosedCycle& cycle : cycles_) {
      const double cost = effort(cycle, control, least);
      if (cost < least - kFloatRounding) least = cost, best = &cycle;
    }
    return best;
  }

  const Contacts& contacts(int clip) {
    return contacts_.get(clip, [&] { return find_contacts(kinematics_, pool_.clips[clip]); });
  }

  // What goes round and round as a cycle; `number` tells its clip from others.
  struct Gait {
    const Clip& clip;
    const Contacts& contacts;
    int number, begin, end;
  };

  Gait gait_of(const ClosedCycle& cycle) {
    if (!cycle.is_step()) return {pool_.clips[cycle.clip], contacts(cycle.clip), cycle.clip, cycle.begin, cycle.end};
    const GaitSource& step = steps_.get(
        &cycle, [&] { return gait_of_step(kinematics_, pool_, cycle, contacts(cycle.clip), contacts(cycle.image)); });
    return {step.clip, step.contacts, -1 - static_cast<int>(&cycle - cycles_.data()), step.begin, step.end};
  }

  // Transforms the cheapest cycle for the control, in pieces that follow each other as in the take.
  void transform(const Control& control, Additions& additions) {
    const ClosedCycle* best = cheapest(control);
    if (!best) return;
    const Gait gait = gait_of(*best);
    const Clip& clip = gait.clip;
    GaitEdit change;
    change.turn = (control.turn - best->evident.turn) * space_.turn_rate();
    const bool moves = best->evident.speed() > kMoving / space_.scale();
    const double faster = moves ? control.speed() / best->evident.speed() : 1;
    if (moves && control.speed() > 0) change.direction = angle_between(best->evident, control);
    const int length = std::abs(gait.end - gait.begin);
    const double usual = length / (longest_ * clip.rate);  // pieces, each as long as may be
    const int pieces = std::max(1, static_cast<int>(std::ceil(usual / kMostTempo - 1e-6)));
    const double sideways = std::abs(std::sin(change.direction)), cadence = 1 + sideways * (kMostTempo - 1);
    change.tempo = std::max(usual / pieces, cadence * std::clamp(std::sqrt(faster), 1 / kMostTempo, kMostTempo));
    change.speed = faster / change.tempo;
    change = borne_gaits_.of(clip, gait.number, gait.begin, gait.end, change);
    const int beyond = tail(clip.rate * change.tempo);
    const int most = length + beyond + frames_of(hop_at(control.speed(), missing_rise(0)), clip.rate * change.tempo);
    const Clip made = transformed(kinematics_, legs_, clip, gait.contacts, gait.begin, gait.end, most, change);
    std::vector<int> ends;
    for (int piece = 0; piece <= pieces; ++piece) ends.push_back(length * piece / pieces);
    if (control.jump <= best->evident.jump)
      return additions.push_back(addition(part(made, 0, length + beyond), ends, Origin::transformed));
    std::vector<double> higher(pieces, 0);
    std::vector<Leap> leaps = leaping(made, gait, ends, control, higher);
    if (!takes_jump_ &&
        std::none_of(leaps.begin(), leaps.end(), [&](const Leap& leap) { return performs(leap, control); })) {
      for (int piece = 0; piece < pieces; ++piece) higher[piece] = missing_rise(leaps[piece].evident.jump);
      leaps = leaping(made, gait, ends, control, higher);
      for (Leap& leap : leaps) fly_as_fast(control, leap);
    }
    for (Leap& leap : leaps)
      additions.push_back(addition(std::move(leap.clip), leap.motion, {leap.begin, leap.end}, Origin::transformed));
  }

  // A gait that begins with frame `first` of a cycle, whose flight in a hop ends on the foot that did not take off:
  // legs in the air get there kTurnsAtMost times as fast as steps may follow each other. A foot that only touches the
  // ground as the body takes off does not bear it.
  Clip landing_in_turn(Clip clip, const Gait& gait, int first, const Hop& hop) const {
    const double take_off = hop.crouch() * clip.rate, flight = hop.flight() * clip.rate;
    const int off = static_cast<int>(take_off), bears = static_cast<int>(take_off - kShortestContact * clip.rate);
    const int down = next_foot_down(gait.contacts, gait.begin, gait.end, first + off,
                                    static_cast<int>(kTurnsAtMost * kMostTempo * flight), off - bears);
    return down < 0 ? clip : gait_in_flight(kinematics_, clip, take_off, take_off + flight, down - first);
  }

  // Of a character that goes so fast, and so much higher than usual, m.
  Hop hop_at(double speed, double higher) const {
    const double running = std::min(1.0, speed / space_.run());
    return {kJumpHeight + higher, dip_ * (1 + running * (kRunningDip - 1)), kSinking * (1 - running / 2), running};
  }

  static int frames_of(const Hop& hop, double rate) { return static_cast<int>(std::ceil(hop.seconds() * rate)); }

  bool performs(const Leap& leap, const Control& control) const {
    return space_.distance(leap.evident, control) <= kPerformed;
  }

  // A hop from each piece of a gait on, so much higher than usual, m.
  std::vector<Leap> leaping(const Clip& made, const Gait& gait, const std::vector<int>& ends, const Control& control,
                            const std::vector<double>& higher) const {
    std::vector<Leap> leaps;
    for (std::size_t piece = 0; piece < higher.size(); ++piece) {
      const Hop hop = hop_at(control.speed(), higher[piece]);
      Clip clip = landing_in_turn(part(made, ends[piece], made.frames - 1), gait, ends[piece], hop);
      clip = part(clip, 0, std::min(clip.frames - 1, frames_of(hop, clip.rate) + tail(clip.rate)));
      add_hop(kinematics_, legs_, clip, hop);
      leaps.push_back(leap_of(kinematics_, std::move(clip), hop, usual_, space_));
    }
    return leaps;
  }

  FragmentPool& pool_;
  const ControlSpace& space_;
  double usual_;
  double longest_;
  int threads_;
  Kinematics kinematics_;
  Legs legs_;
  Trajectories trajectories_;
  BorneGaits borne_gaits_;
  int originals_;
  std::vector<int> next_;
  std::vector<ClosedCycle> cycles_;
  bool takes_jump_ = false;                     // then these show how high and fast
  double dip_ = kLeastDip;                      // m of a 1.8 m character that jumps on the spot
  Memo<int, Contacts> contacts_;                // of the clips that were transformed
  Memo<const ClosedCycle*, GaitSource> steps_;  // likewise
};

}  // namespace

void synthesize(FragmentPool& pool, const ControlSpace& space, double usual, double longest, int threads,
                const Trajectories& known) {
  require_range("the longest fragment (s)", longest, 0.1, 10);
  const std::size_t fragments = pool.fragments.size(), clips = pool.clips.size();
  const bool mirrored = std::any_of(pool.fragments.begin(), pool.fragments.end(),
                                    [](const Fragment& f) { return f.origin == Origin::mirrored; });
  std::vector<int> next = successors(pool.fragments);
  const bool stands_long = takes_stand(pool, next, space);
  const bool any_stands =
      stands_long || std::any_of(pool.fragments.begin(), pool.fragments.end(),
                                 [&](const Fragment& f) { return space.distance(f.evident, {}) <= kPerformed; });
  if (!any_stands) {
    add_standing(pool);
    next = successors(pool.fragments);
  }
  Synthesizer(pool, std::move(next), mirrored ? clips / 2 : clips, space, usual, longest, threads, known).fill();
  if (stands_long) return;
  add_living_stand(pool, space, usual, static_cast<int>(any_stands ? pool.clips.size() : clips));
  if (!any_stands) pool.fragments.erase(pool.fragments.begin() + static_cast<std::ptrdiff_t>(fragments));
}

}  // namespace fragmotion
