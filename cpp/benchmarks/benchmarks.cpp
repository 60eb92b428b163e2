// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "fragmotion/iterate.hpp"
#include "fragmotion/player.hpp"
#include "fragmotion/svm.hpp"
#include "workload.hpp"

namespace fragmotion::benchmarks {
namespace {

constexpr double kFrameRate = 60;
constexpr int kFramesPerControl = static_cast<int>(kFrameRate / kTraceRate);

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
  for (auto _ : state) benchmark::DoNotOptimize(quality_table(w.pool, w.trajectories, w.classes, w.built->space));
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

// From takes to a character, with all that a build does by default; its stages' seconds are counters.
void measure_whole(benchmark::State& state) {
  const Workload& w = workload();
  for (auto _ : state) {
    const Character character = build(w.pool.skeleton, w.takes, {w.trace});
    for (const auto& [name, value] : character.report) state.counters[name] = value;
  }
}

void measure_player_frame(benchmark::State& state) {
  const Workload& w = workload();
  Player player(w.built, 1);
  std::size_t frame = 0;
  for (auto _ : state) {
    player.step(w.trace[frame++ / kFramesPerControl % w.trace.size()], 1 / kFrameRate);
    benchmark::DoNotOptimize(player.rotations().data());
  }
}

BENCHMARK(measure_trajectories)->Name("trajectories")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_cluster)->Name("cluster")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_quality)->Name("quality table")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_optimal)->Name("optimal")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_svm)->Name("svm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_iterate)->Name("iterate")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(measure_whole)->Name("whole build")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(measure_player_frame)->Name("player frame")->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace
}  // namespace fragmotion::benchmarks
