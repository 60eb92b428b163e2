// SPDX-License-Identifier: MIT
// Measures the core: `POLICY FOLDER` before Google Benchmark's own options. Frames and crowds are measured on the
// character in POLICY, too, and what all else works on is written to FOLDER as NumPy arrays.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <utility>

#include "character/policy_file.hpp"
#include "crowds.hpp"
#include "frames.hpp"
#include "peers/ozz.hpp"
#include "workload.hpp"

namespace fragmotion::benchmarks {
namespace {

void prepare(const char* policy, const char* folder) {
  const std::pair<const char*, std::shared_ptr<const Character>> characters[] = {
      {"small", workload().built}, {"large", std::make_shared<const Character>(load_policy(policy))}};
  for (const auto& [name, character] : characters) {
    register_frames(name, character);
    register_ozz_frame(name, character);
    register_crowds(name, character);
  }
  dump(workload(), folder);
}

}  // namespace
}  // namespace fragmotion::benchmarks

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: %s POLICY FOLDER [OPTION...]\n", argv[0]), 1;
  try {
    fragmotion::benchmarks::prepare(argv[1], argv[2]);
    argv[2] = argv[0];
    argc -= 2;
    argv += 2;
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
