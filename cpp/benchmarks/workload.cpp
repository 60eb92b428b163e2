// SPDX-License-Identifier: MIT
#include "workload.hpp"

#include "build/build.hpp"
#include "control/simulated_players.hpp"
#include "policy/quality_table.hpp"
#include "policy/svm.hpp"
#include "synthetic_takes.hpp"

namespace fragmotion::benchmarks {
namespace {

constexpr int kMostTakes = 1024;

Character built_from(const std::vector<Clip>& takes, const Trace& trace, const BuildOptions& options = {}) {
  return build(mannequin(), takes, {trace}, options);
}

// The fewest takes whose build has kFragments fragments.
std::vector<Clip> enough_takes(const Trace& trace) {
  BuildOptions quick;
  quick.policies = {"greedy"};
  quick.restarts = 1;
  const auto enough = [&](int count) {
    return built_from(synthetic_takes(count), trace, quick).pool.fragments.size() >= kFragments;
  };
  int few = 16, many = 2 * few;
  while (many < kMostTakes && !enough(many)) few = many, many *= 2;
  while (many - few > 1) (enough((few + many) / 2) ? many : few) = (few + many) / 2;
  return synthetic_takes(many);
}

Workload make_workload() {
  Workload w;
  w.trace = simulate_trace("explorer", kSamples / kTraceRate, 1, ControlSpace());
  w.takes = enough_takes(w.trace);
  w.built = std::make_shared<const Character>(built_from(w.takes, w.trace));
  w.controls = snap(w.built->space, w.trace);
  w.pool = w.built->pool;
  w.pool.fragments.resize(kFragments);
  w.trajectories = trajectories(w.pool);
  w.weights.assign(kFragments, 1);
  w.classes = cluster(w.trajectories, w.weights, clustering());
  w.quality = quality_table(w.pool.fragments, w.trajectories, w.classes, w.built->space);
  w.features = class_features(w.trajectories, w.classes);
  return w;
}

}  // namespace

ClusterOptions clustering() {
  const BuildOptions build;
  ClusterOptions options;
  options.classes = build.classes;
  options.restarts = build.restarts;
  options.seed = build.seed;
  return options;
}

const Workload& workload() {
  static const Workload made = make_workload();
  return made;
}

}  // namespace fragmotion::benchmarks
