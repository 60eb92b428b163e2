# SPDX-License-Identifier: MIT
# tests/fuzz/fuzz_*.cpp, each a libFuzzer program of its own (clang only; preset `sanitize`), and what makes the policy
# fuzzers' corpus.
file(GLOB fragmotion_fuzzers CONFIGURE_DEPENDS tests/fuzz/fuzz_*.cpp)
# libFuzzer is guided by the coverage of what reads; that of the rest would only make the tests slow.
file(GLOB fragmotion_readers CONFIGURE_DEPENDS cpp/src/*/base/*.cpp cpp/src/*/skeleton/*.cpp cpp/src/make/io/*.cpp
     cpp/src/make/control/trace.cpp cpp/src/play/character/policy_file.cpp)
set_source_files_properties(${fragmotion_readers} PROPERTIES COMPILE_OPTIONS -fsanitize=fuzzer-no-link)
foreach(source ${fragmotion_fuzzers})
  get_filename_component(fuzzer ${source} NAME_WE)
  add_executable(${fuzzer} ${source})
  target_link_libraries(${fuzzer} PRIVATE fragmotion)
  target_link_options(${fuzzer} PRIVATE -fsanitize=fuzzer)
  target_compile_options(${fuzzer} PRIVATE -Wall -Wextra -Wpedantic)
endforeach()
add_executable(make_policy_corpus EXCLUDE_FROM_ALL tests/fuzz/make_policy_corpus.cpp)
target_include_directories(make_policy_corpus PRIVATE tests/cpp)
target_link_libraries(make_policy_corpus PRIVATE fragmotion)
