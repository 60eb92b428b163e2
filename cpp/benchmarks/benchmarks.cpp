// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "base/random.hpp"
#include "build/build.hpp"
#include "large.hpp"
#include "policy/iterate.hpp"
#include "policy/optimal.hpp"
#include "policy/quality_table.hpp"
#include "policy/svm.hpp"
#include "workload.hpp"

namespace fragmotion::benchmarks {
namespace {

void measure_trajectories(benchmark::State& state) {
  const Workload& w = workload();
  for (auto _ : state) benchmark::DoNotOptimize(trajectories(w.pool));
}

void measure_cluster(benchmark::State& state) {
  const Workload& w = workload();
  for (auto _ : state) benchmark::DoNotOptimize(cluster(w.trajectories, w.weights, clustering()));
}

void measure_quality(benchmark::State& state) {
  const Workload& w = workload();
  for (auto _ : state)
    benchmark::DoNotOptimize(quality_table(w.pool.fragments, w.trajectories, w.classes, w.built->space));
}

void measure_optimal(benchmark::State& state) {
  const Workload& w = workload();
  for (auto _ : state) benchmark::DoNotOptimize(optimal_path(w.quality, w.controls));
}

void measure_svm(benchmark::State& state) {
  const Workload& w = workload();
  for (auto _ : state) benchmark::DoNotOptimize(svm_policy(w.quality, {w.controls}, w.features, w.built->space));
}

void measure_iterate(benchmark::State& state) {
  const Workload& w = workload();
  for (auto _ : state) benchmark::DoNotOptimize(iterate_policy(w.quality, {w.controls}));
}

// What a joystick asks for ten times a second: the nearest of the 102 points, and the policy's next class.
void measure_decision(benchmark::State& state) {
  const ControlSpace& space = workload().built->space;
  const Policy& policy = workload().built->policy();
  Random random(1);
  const auto within = [&](double limit) { return limit * (2 * random.uniform() - 1); };
  std::vector<Control> controls(4096);
  for (Control& c : controls) c = {within(4), within(4), within(1.2), random.uniform()};
  std::size_t i = 0;
  int playing = 0;
  for (auto _ : state) {
    playing = policy(playing, space.nearest(controls[i++ % controls.size()]));
    benchmark::DoNotOptimize(playing);
  }
}

// From takes to a character with the default policy; the stages' seconds are counters.
void measure_whole(benchmark::State& state) {
  const Workload& w = workload();
  BuildOptions options;
  options.policies.resize(1);
  for (auto _ : state) {
    const Character character = build(w.pool.skeleton, w.takes, {w.trace}, options);
    for (const auto& [name, value] : character.report) state.counters[name] = value;
  }
}

// From fragments to a policy; the memory is the process's, so that the largest pool must come last.
void measure_large(benchmark::State& state) {
  const Workload& w = workload();
  const LargePool large(w, static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(built_policy(large, w));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_bytes"] = 1024.0 * static_cast<double>(usage.ru_maxrss);
}

BENCHMARK(measure_trajectories)->Name("trajectories")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_cluster)->Name("cluster")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_quality)->Name("quality table")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_optimal)->Name("optimal")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_svm)->Name("svm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_iterate)->Name("iterate")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_whole)->Name("whole build")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(measure_decision)->Name("decision")->Unit(benchmark::kNanosecond)->UseRealTime();
BENCHMARK(measure_large)
    ->Name("large build")
    ->Arg(12500)
    ->Arg(25000)
    ->Arg(50000)
    ->Arg(100000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace fragmotion::benchmarks
