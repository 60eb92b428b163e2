// SPDX-License-Identifier: MIT
#include "build/build.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/listed.hpp"
#include "base/parallel.hpp"
#include "base/ranges.hpp"
#include "build/stages.hpp"
#include "classes/clustering.hpp"
#include "fragments/able_trace.hpp"
#include "fragments/acts.hpp"
#include "fragments/coverage.hpp"
#include "fragments/entry_poses.hpp"
#include "fragments/evident.hpp"
#include "fragments/lying.hpp"
#include "fragments/packed_pool.hpp"
#include "fragments/synthesis.hpp"
#include "fragments/t_poses.hpp"
#include "fragments/whole_jumps.hpp"
#include "motion/bladed_stance.hpp"
#include "motion/cycle.hpp"
#include "motion/discontinuities.hpp"
#include "motion/legs.hpp"
#include "motion/mirror.hpp"
#include "motion/one_floor.hpp"
#include "policy/anticipate.hpp"
#include "policy/bridge.hpp"
#include "policy/greedy.hpp"
#include "policy/iterate.hpp"
#include "policy/optimal.hpp"
#include "policy/quality_table.hpp"
#include "policy/svm.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {
namespace {

constexpr double kBalance = -0.75;     // each of k fragments that perform one control counts k^(-3/4) in clustering
constexpr double kRoundSeconds = 2.5;  // s that a shorter cycle is gone through, and twice at least
constexpr double kSideHop = 0.2;       // weight of a hop that goes to a side,
constexpr double kTurningHop = 0.02;   // and of one that turns

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<Contacts> all_contacts(const Kinematics& kinematics, const std::vector<Clip>& clips, int threads) {
  return parallel_map(static_cast<int>(clips.size()), threads,
                      [&](int c) { return find_contacts(kinematics, clips[c]); });
}

// Adds clips with these contacts and discontinuities, cuts them and marks their fragments.
void cut(FragmentPool& pool, std::vector<Clip> clips, const std::vector<Contacts>& contacts,
         const std::vector<std::vector<int>>& seams, Origin origin, const BuildOptions& options) {
  const std::size_t before = pool.fragments.size();
  for (std::size_t c = 0; c < clips.size(); ++c) {
    pool.clips.push_back(std::move(clips[c]));
    cut_fragments(pool, static_cast<int>(pool.clips.size()) - 1, contacts[c], seams[c], options.cut);
  }
  drop_lying(pool, before);
  for (std::size_t i = before; i < pool.fragments.size(); ++i) pool.fragments[i].origin = origin;
}

// The clip, whole rounds of it where it is a short cycle: so that it goes on where it ends.
Clip in_rounds(const Kinematics& kinematics, Clip clip) {
  const int period = cycle_of(kinematics, clip), enough = static_cast<int>(std::ceil(kRoundSeconds * clip.rate));
  if (period == 0 || period >= enough) return clip;
  const int rounds = std::max(2, (enough + period - 1) / period);
  return unrolled(kinematics, clip, period, rounds * period + 1);
}

// Of so many clips, after which their images come.
MirrorImages mirror_images(MirrorTurns turns, int clips) {
  if (turns.counterparts.empty()) return {};
  MirrorImages images{std::vector<int>(clips, -1), std::move(turns)};
  for (int c = 0; c < clips; ++c) images.originals.push_back(c);
  return images;
}

// The captured and mirrored fragments, without their evident controls; tells which clips are mirrored.
FragmentPool captured_pool(const Kinematics& kinematics, const std::vector<Clip>& clips, const BuildOptions& options,
                           MirrorImages& images) {
  const Skeleton& skeleton = kinematics.skeleton();
  FragmentPool pool{skeleton, {}, {}};
  const int takes = static_cast<int>(clips.size()), threads = thread_count(options.threads);
  std::vector<Clip> captured = parallel_map(takes, threads, [&](int c) { return make_clip(skeleton, clips[c]); });
  const std::vector<double> told = take_told_turns(kinematics, captured);
  captured = parallel_map(takes, threads, [&](int c) { return in_rounds(kinematics, std::move(captured[c])); });
  face_ahead(kinematics, told, captured);
  std::vector<Contacts> contacts = put_level_on_one_floor(kinematics, captured, threads);
  const std::vector<std::vector<int>> seams =
      parallel_map(takes, threads, [&](int c) { return discontinuities(skeleton, captured[c]); });
  cut(pool, std::move(captured), contacts, seams, Origin::captured, options);
  if (pool.fragments.empty()) {
    throw std::invalid_argument("the takes are too short: none holds a fragment of " +
                                std::to_string(options.cut.shortest) + " s");
  }
  if (options.mirror) {
    const Mirror mirror(kinematics, pool.clips);
    std::vector<Clip> mirrored = parallel_map(takes, threads, [&](int c) { return mirror(pool.clips[c]); });
    contacts = all_contacts(kinematics, mirrored, threads);
    images = mirror_images(mirror.turns(), takes);
    cut(pool, std::move(mirrored), contacts, seams, Origin::mirrored, options);
  }
  for (std::size_t c = 0; c < pool.clips.size(); ++c) close_way(seams[c % takes], pool.clips[c]);
  return pool;
}

// Fills the evident controls; returns the space that fits them and the usual height of the centre of mass.
ControlSpace perform(FragmentPool& pool, const Kinematics& kinematics, const BuildOptions& options, double& usual) {
  const double scale = standard_scale(pool.skeleton);
  const auto motions = parallel_map(static_cast<int>(pool.clips.size()), thread_count(options.threads),
                                    [&](int c) { return body_motion(kinematics, pool.clips[c]); });
  usual = usual_height(motions);
  const ControlSpace standard(1.2, 3.3, ControlSpace().turn_rate(), scale);
  std::vector<Control> evident;
  for (Fragment& f : pool.fragments) {
    f.evident = evident_control(motions[f.clip], pool.clips[f.clip].rate, f.begin, f.end, usual, standard);
    evident.push_back(f.evident);
  }
  lead_to_jumps(pool);
  const ControlSpace space = control_space_of(evident, scale, options.controls);
  for (Fragment& f : pool.fragments) f.evident.turn *= standard.turn_rate() / space.turn_rate();
  return space;
}

// What the takes hold of the controls, beside what was asked for.
void report_held(Character& c, const FragmentPool& pool) {
  std::vector<Control> evident;
  for (const Fragment& f : pool.fragments) evident.push_back(f.evident);
  const HeldControls held = held_controls(evident, c.space);
  c.report["speeds_held"] = held.speeds;
  c.report["directions_held"] = held.directions;
  c.report["turn_held"] = held.turn ? 1 : 0;
  c.report["jump_held"] = held.jump ? 1 : 0;
}

void round_to_single(std::vector<double>& values) {
  for (double& value : values) value = static_cast<float>(value);
}

// Fragments that differ by less than single precision are the same.
FragmentPool in_single(FragmentPool pool) {
  for (Clip& clip : pool.clips) {
    for (std::vector<double>* values : {&clip.root_positions, &clip.rotations, &clip.headings})
      round_to_single(*values);
  }
  return pool;
}

// What many fragments perform must not take all classes from what few do. Hops that turn may be in a class with those
// that do not, where the player draws them; those that are pressed for most, on the spot and ahead, should not be in
// one with those to the side.
std::vector<float> balanced_weights(const Character& c) {
  const std::vector<int> counts = coverage(c.pool.fragments, c.space).counts;
  std::vector<float> weights;
  for (const Fragment& f : c.pool.fragments) {
    const int nearest = c.space.nearest(f.evident);
    const Control control = c.space.point(nearest);
    const double share = std::pow(counts[nearest], kBalance);
    const bool turns = control.turn != 0, ahead = control.x == 0 && control.y >= 0;
    const double wanted = !control.jumps() ? 1 : turns ? kTurningHop : ahead ? 1 : kSideHop;
    weights.push_back(static_cast<float>(share * wanted));
  }
  return weights;
}

// Which fragments jump: 1 each.
std::vector<char> jumping(const std::vector<Fragment>& fragments) {
  std::vector<char> jumping;
  for (const Fragment& f : fragments) jumping.push_back(f.evident.jumps() ? 1 : 0);
  return jumping;
}

// Scores classes by the quality of Optimal's paths over the traces.
ClassScore serves_traces(const Character& c, const Trajectories& t, const std::vector<std::vector<int>>& traces) {
  return [&](const Classes& classes) {
    const Quality quality = quality_table(c.pool.fragments, t, classes, c.space);
    double sum = 0;
    for (const std::vector<int>& trace : traces) sum += optimal_path(quality, trace).quality;
    return sum;
  };
}

Policy policy_named(const std::string& name, const Character& c, const Trajectories& t,
                    const std::vector<std::vector<int>>& traces, int threads, const Progress& progress) {
  if (name == "greedy") return greedy_policy(c.quality);
  if (name == "anticipate") return anticipate_policy(c.quality, traces);
  if (name == "iterate") return iterate_policy(c.quality, traces);
  SvmOptions options;
  options.threads = threads;
  return svm_policy(c.quality, traces, class_features(t, c.classes), c.space, options, progress).policy;
}

void check(const Trace& trace, std::size_t number) {
  if (trace.size() < 2) throw std::invalid_argument("a trace must hold at least two controls");
  for (std::size_t i = 0; i < trace.size(); ++i) {
    for (const double value : {trace[i].x, trace[i].y, trace[i].turn, trace[i].jump}) {
      if (std::isfinite(value)) continue;
      throw std::invalid_argument("control " + std::to_string(i) + " of trace " + std::to_string(number) +
                                  " is not a number");
    }
  }
}

// Before the stages that would find it, which take their time.
void check(const BuildOptions& options) {
  check(options.cut);
  check(options.controls.layout);
  require_range("the number of classes", options.classes, 1, kMostClasses);
  require_range("the number of restarts", std::max(1, options.restarts), 1, kMostRestarts);
}

void check(const std::vector<Clip>& clips, const std::vector<Trace>& traces, const BuildOptions& options) {
  if (clips.empty()) throw std::invalid_argument("there are no takes to build from");
  if (traces.empty()) throw std::invalid_argument("there is no trace to learn from");
  for (std::size_t i = 0; i < traces.size(); ++i) check(traces[i], i);
  check(options);
  if (options.policies.empty()) throw std::invalid_argument("no policy is asked for");
  const std::vector<std::string>& names = policy_names();
  for (const std::string& name : options.policies) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw std::invalid_argument("there is no policy \"" + name + "\"; the policies are " + listed(names));
  }
}

}  // namespace

const std::vector<std::string>& policy_names() {
  static const std::vector<std::string> names{"anticipate", "iterate", "svm", "greedy"};
  return names;
}

std::vector<Contacts> contacts_of(const FragmentPool& pool, int threads) {
  std::vector<char> captured(pool.clips.size(), 0);
  for (const Fragment& f : pool.fragments) {
    captured[f.clip] = !is_made(f.origin);
  }
  std::vector<Contacts> contacts(pool.clips.size());
  const Kinematics kinematics(pool.skeleton);
  std::vector<int> takes, others;
  for (std::size_t c = 0; c < captured.size(); ++c) (captured[c] ? takes : others).push_back(static_cast<int>(c));
  const auto find = [&](const std::vector<int>& clips, const Floors* floors) {
    std::vector<Contacts> found = parallel_map(static_cast<int>(clips.size()), thread_count(threads), [&](int i) {
      return find_plants(kinematics, pool.clips[clips[i]], floors);
    });
    for (std::size_t i = 0; i < clips.size(); ++i) contacts[clips[i]] = found[i];
    return found;
  };
  const Floors usual = usual_floors(find(takes, nullptr));
  find(others, &usual);
  return contacts;
}

Material prepare(const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                 const BuildOptions& options, const Progress& progress) {
  check(clips, traces, options);
  Material material{std::make_shared<Character>(), {}, {}};
  Character& c = *material.character;
  Stopwatch stage;
  report(progress, 0, "Cutting fragments");
  const Kinematics kinematics(make_skeleton(skeleton));
  check_stature(kinematics.skeleton());
  MirrorImages images;
  FragmentPool pool = captured_pool(kinematics, clips, options, images);
  double usual = 0;
  c.space = perform(pool, kinematics, options, usual);
  drop_t_poses(pool, c.space);
  drop_acts(pool, c.space);
  c.report["captured"] = static_cast<double>(pool.fragments.size());
  report_held(c, pool);
  c.report["cut_seconds"] = stage.lap();
  report(progress, 0.5, "Synthesizing fragments");
  material.trajectories = trajectories(in_single(pool), kPoses, options.threads);
  if (options.synthesize) synthesize(pool, c.space, usual, options.cut.longest, options.threads, material.trajectories);
  pool = in_single(std::move(pool));
  c.contacts = contacts_of(pool, options.threads);
  c.legs = find_legs(kinematics, pool.clips);
  c.pool = pack(pool, images, options.threads);
  for (Fragment& f : c.pool.fragments) f.evident = c.space.rounded(f.evident);
  find_whole_jumps(c.pool);
  c.speeds = SpeedRange(c.pool.fragments, c.space);
  pool.fragments = c.pool.fragments;
  c.report["fragments"] = static_cast<double>(c.pool.fragments.size());
  c.report["synthesize_seconds"] = stage.lap();
  report(progress, 0.9, "Measuring fragments");
  material.trajectories = trajectories(pool, kPoses, options.threads, std::move(material.trajectories));
  parallel_for(2, thread_count(options.threads), [&](int begin, int end) {
    if (begin == 0) c.entry_poses = entry_poses(c.pool);
    if (end == 2) measure_looks_and_arms(c);
  });
  for (const Trace& trace : traces) material.traces.push_back(snap(c.space, able_trace(c.speeds, trace)));
  c.report["measure_seconds"] = stage.lap();
  return material;
}

void learn(const Material& material, const BuildOptions& options, const Progress& progress) {
  Character& c = *material.character;
  const Trajectories& t = material.trajectories;
  Stopwatch stage;
  ClusterOptions clustering;
  clustering.classes = distinct_fragments(t, options.classes);
  clustering.restarts = options.restarts;
  clustering.seed = options.seed;
  clustering.threads = options.threads;
  clustering.kinds = jumping(c.pool.fragments);
  c.classes =
      cluster(t, balanced_weights(c), clustering, serves_traces(c, t, material.traces), part_of(progress, 0, 0.5));
  c.report["classes"] = c.classes.count;
  c.report["cluster_seconds"] = stage.lap();
  c.quality = quality_table(c.pool.fragments, t, c.classes, c.space);
  c.bridges = stand_bridges(c.pool.fragments, t, c.classes, c.space);
  c.report["quality_seconds"] = stage.lap();
  c.control_model = control_model(material.traces, kGenericPrior, c.space.size());
  round_to_single(c.control_model);
  c.policies.clear();
  for (const std::string& name : options.policies) {
    c.policies.push_back(policy_named(name, c, t, material.traces, options.threads, part_of(progress, 0.5, 1)));
    c.report[name + "_seconds"] = stage.lap();
  }
  repair_policies(c);
}

Character build(const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                const BuildOptions& options, const Progress& progress) {
  Stopwatch whole;
  const Material material = prepare(skeleton, clips, traces, options, part_of(progress, 0, 0.35));
  learn(material, options, part_of(progress, 0.35, 1));
  Character& c = *material.character;
  c.report["seconds"] = whole.lap();
  report(progress, 1, "Done");
  return std::move(c);
}

}  // namespace fragmotion
