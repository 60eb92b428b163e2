// SPDX-License-Identifier: MIT
// Measures the core: `POLICY FOLDER` before Google Benchmark's own options. Frames are measured on the character in
// POLICY, too, and what all else works on is written to FOLDER as NumPy arrays.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>

#include "character/policy_file.hpp"
#include "frames.hpp"
#include "workload.hpp"

namespace fragmotion::benchmarks {
namespace {

void prepare(const char* policy, const char* folder) {
  register_frames("small", workload().built);
  register_frames("large", std::make_shared<const Character>(load_policy(policy)));
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
