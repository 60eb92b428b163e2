# SPDX-License-Identifier: MIT
# tests/fuzz/fuzz_*.cpp, each a libFuzzer program of its own (clang only; preset `sanitize`), and what makes the policy
# fuzzers' corpus.
file(GLOB fragmotion_fuzzers CONFIGURE_DEPENDS tests/fuzz/fuzz_*.cpp)
foreach(source ${fragmotion_fuzzers})
  get_filename_component(fuzzer ${source} NAME_WE)
  add_executable(${fuzzer} ${source})
  target_include_directories(${fuzzer} PRIVATE cpp/src)
  target_link_libraries(${fuzzer} PRIVATE fragmotion)
  target_link_options(${fuzzer} PRIVATE -fsanitize=fuzzer)
  target_compile_options(${fuzzer} PRIVATE -Wall -Wextra -Wpedantic)
endforeach()
add_executable(make_policy_corpus EXCLUDE_FROM_ALL tests/fuzz/make_policy_corpus.cpp)
target_include_directories(make_policy_corpus PRIVATE tests/cpp)
target_link_libraries(make_policy_corpus PRIVATE fragmotion)
