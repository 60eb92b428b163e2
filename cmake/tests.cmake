# SPDX-License-Identifier: MIT
# tests/cpp/*/test_*.cpp in one GoogleTest program; each of its tests is one of ctest's, run from the top folder.
set(FRAGMOTION_TEST_FILES "*/test_*.cpp" CACHE STRING "Files of tests/cpp to build, all unless told")
list(TRANSFORM FRAGMOTION_TEST_FILES PREPEND tests/cpp/ OUTPUT_VARIABLE fragmotion_test_globs)
file(GLOB fragmotion_test_sources CONFIGURE_DEPENDS ${fragmotion_test_globs})
if(NOT fragmotion_test_sources)
  message(STATUS "tests/cpp holds no test yet")
  return()
endif()
find_package(GTest REQUIRED)
include(GoogleTest)
add_executable(fragmotion_tests ${fragmotion_test_sources})
target_include_directories(fragmotion_tests PRIVATE tests/cpp)
target_link_libraries(fragmotion_tests PRIVATE fragmotion GTest::gtest_main)
# What is optimised, debugged and sanitized is the core; its tests are compiled in half the time without optimisation.
compile_by_stage(fragmotion_tests)
target_compile_options(fragmotion_tests PRIVATE -Wall -Wextra -Wpedantic -O0)
gtest_discover_tests(fragmotion_tests WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" DISCOVERY_TIMEOUT 60)

# What a game does, with fragmotion_runtime alone.
add_executable(fragmotion_runtime_tests tests/cpp/test_runtime_alone.cpp)
target_link_libraries(fragmotion_runtime_tests PRIVATE fragmotion_runtime GTest::gtest_main)
target_compile_options(fragmotion_runtime_tests PRIVATE -Wall -Wextra -Wpedantic)
gtest_discover_tests(fragmotion_runtime_tests WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" DISCOVERY_TIMEOUT 60
                     PROPERTIES LABELS runtime)
add_test(NAME RuntimeLibrary.StartsNoThreadAndKnowsNoLibsvm
         COMMAND ${CMAKE_COMMAND} -D "NM=${CMAKE_NM}" -D "LIBRARY=$<TARGET_FILE:fragmotion_runtime>"
                 -P "${PROJECT_SOURCE_DIR}/cmake/check_symbols.cmake")
set_tests_properties(RuntimeLibrary.StartsNoThreadAndKnowsNoLibsvm PROPERTIES LABELS runtime)
