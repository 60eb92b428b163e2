// SPDX-License-Identifier: MIT
// Measures the core. `--dump FOLDER` before Google Benchmark's own options also writes what it works on as NumPy
// arrays.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <string>

#include "workload.hpp"

int main(int argc, char** argv) {
  try {
    if (argc > 2 && std::string(argv[1]) == "--dump") {
      fragmotion::benchmarks::dump(fragmotion::benchmarks::workload(), argv[2]);
      argv[2] = argv[0];
      argc -= 2;
      argv += 2;
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
