# SPDX-License-Identifier: MIT
# tests/cpp/test_*.cpp in one GoogleTest program; each of its tests is one of ctest's, run from the top folder.
file(GLOB fragmotion_test_sources CONFIGURE_DEPENDS tests/cpp/test_*.cpp)
if(NOT fragmotion_test_sources)
  message(STATUS "tests/cpp holds no test yet")
  return()
endif()
find_package(GTest REQUIRED)
include(GoogleTest)
add_executable(fragmotion_tests ${fragmotion_test_sources})
target_include_directories(fragmotion_tests PRIVATE cpp/src)
target_link_libraries(fragmotion_tests PRIVATE fragmotion GTest::gtest_main)
target_compile_options(fragmotion_tests PRIVATE -Wall -Wextra -Wpedantic)
gtest_discover_tests(fragmotion_tests WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" DISCOVERY_TIMEOUT 60)
