# SPDX-License-Identifier: MIT
# cpp/benchmarks/*.cpp in one Google Benchmark program.
file(GLOB fragmotion_benchmark_sources CONFIGURE_DEPENDS cpp/benchmarks/*.cpp)
if(NOT fragmotion_benchmark_sources)
  message(STATUS "cpp/benchmarks holds no benchmark yet")
  return()
endif()
find_package(benchmark REQUIRED)
add_executable(fragmotion_benchmarks ${fragmotion_benchmark_sources})
target_link_libraries(fragmotion_benchmarks PRIVATE fragmotion benchmark::benchmark_main)
target_compile_options(fragmotion_benchmarks PRIVATE -Wall -Wextra -Wpedantic)
