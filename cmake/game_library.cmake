# SPDX-License-Identifier: MIT
# libfragmotion, what a game links: the C API of fragmotion.h on the sources of fragmotion_runtime, in a shared and a
# static library of their own. Nothing of Eigen and nothing of C++ is seen from outside, so that neither the game's
# flags nor another Eigen of its can matter.
set(fragmotion_game_headers cpp/include/fragmotion/fragmotion.h cpp/include/fragmotion/fragmotion.hpp)
file(READ cpp/include/fragmotion/fragmotion.h fragmotion_exported)
string(REGEX MATCHALL "FRAGMOTION_EXPORT [^(;]*fragmotion_[a-z_]+[(]" fragmotion_exported "${fragmotion_exported}")
list(TRANSFORM fragmotion_exported REPLACE ".*[ *\n](fragmotion_[a-z_]+)[(]" "\\1")

# What every step and its pose compute is made fast. What loads, names, makes, decides and hands on is made small, and so
# are heads and hands that look and reach: a third of the time, four fifths of the size.
set(fragmotion_small ${fragmotion_runtime_sources})
set(fragmotion_small_stages "(base|skeleton|control|fragments|classes|policy|character|direct|api)/[a-z_]+")
set(fragmotion_small_files "motion/(clip|contacts|facing|foot_paths|take)|runtime/(crowd|director|gaze|held_gaits|move_track|player|player_(constants|making|moves|styles)|reaching|step_sequence|upper_body|workspace)")
list(FILTER fragmotion_small INCLUDE REGEX "/(${fragmotion_small_stages}|${fragmotion_small_files})[.]cpp$")
list(FILTER fragmotion_small EXCLUDE REGEX "/(kinematics|two_bone_ik|control|body_tips|hips_velocity|player_pose)[.]cpp$")
set(fragmotion_fast ${fragmotion_runtime_sources})
list(REMOVE_ITEM fragmotion_fast ${fragmotion_small})
foreach(kind fast small)
  add_library(fragmotion_${kind} OBJECT ${fragmotion_${kind}})
  target_include_directories(fragmotion_${kind} PRIVATE cpp/include cpp/src/play)
  target_link_libraries(fragmotion_${kind} PRIVATE Eigen3::Eigen)
  target_compile_definitions(fragmotion_${kind} PRIVATE FRAGMOTION_BUILDS_SHARED EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MPL2_ONLY)
  target_compile_options(fragmotion_${kind} PRIVATE -Wall -Wextra -Wpedantic -fno-rtti -ffunction-sections
                         -fdata-sections $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique -fno-align-jumps>)
  set_target_properties(fragmotion_${kind} PROPERTIES VISIBILITY_INLINES_HIDDEN ON)
  compile_by_stage(fragmotion_${kind})
endforeach()
target_compile_options(fragmotion_fast PRIVATE $<$<CONFIG:Release>:-O2>)
target_compile_options(fragmotion_small PRIVATE $<$<CONFIG:Release>:-Os>)
set(fragmotion_objects $<TARGET_OBJECTS:fragmotion_fast> $<TARGET_OBJECTS:fragmotion_small>)
if(TARGET fragmotion_math_objects)
  list(APPEND fragmotion_objects $<TARGET_OBJECTS:fragmotion_math_objects>)
endif()
if(NOT PROJECT_IS_TOP_LEVEL)
  set(fragmotion_game_exclude EXCLUDE_FROM_ALL)
endif()

add_library(fragmotion_shared SHARED ${fragmotion_game_exclude} ${fragmotion_objects})
set_target_properties(fragmotion_shared PROPERTIES OUTPUT_NAME fragmotion EXPORT_NAME shared
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}
  LIBRARY_OUTPUT_DIRECTORY game RUNTIME_OUTPUT_DIRECTORY game ARCHIVE_OUTPUT_DIRECTORY game)
target_compile_definitions(fragmotion_shared INTERFACE FRAGMOTION_SHARED)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  # Templates of the standard library are visible, whatever is told.
  list(JOIN fragmotion_exported "; " exported)
  file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/game/exported.map" "{ global: ${exported}; local: *; };\n")
  target_link_options(fragmotion_shared PRIVATE "-Wl,--version-script=${CMAKE_CURRENT_BINARY_DIR}/game/exported.map"
                      -Wl,--gc-sections -Wl,--no-undefined $<$<CONFIG:Release>:-s>
                      # Code and constants share pages: 8 kB of zeros less.
                      -Wl,-z,noseparate-code)
endif()

if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_OBJCOPY AND NOT CMAKE_CROSSCOMPILING)
  # One object, from what is exported and all that it needs; of the rest no name is left.
  set(object "${CMAKE_CURRENT_BINARY_DIR}/game/fragmotion.o")
  list(TRANSFORM fragmotion_exported PREPEND "--undefined=" OUTPUT_VARIABLE needed)
  add_custom_command(OUTPUT "${object}" DEPENDS ${fragmotion_objects}
    COMMAND ${CMAKE_LINKER} -r --gc-sections --force-group-allocation ${needed} -o "${object}"
            ${fragmotion_objects}
    COMMAND ${CMAKE_OBJCOPY} --wildcard "--keep-global-symbol=fragmotion_*" "${object}"
    COMMAND_EXPAND_LISTS VERBATIM)
  set_source_files_properties("${object}" PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  add_library(fragmotion_static STATIC ${fragmotion_game_exclude} "${object}")
else()
  add_library(fragmotion_static STATIC ${fragmotion_game_exclude} ${fragmotion_objects})
endif()
set_target_properties(fragmotion_static PROPERTIES OUTPUT_NAME fragmotion EXPORT_NAME static LINKER_LANGUAGE CXX
                      ARCHIVE_OUTPUT_DIRECTORY game)

foreach(library shared static)
  target_include_directories(fragmotion_${library} SYSTEM INTERFACE
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/cpp/include>" "$<INSTALL_INTERFACE:include>")
  add_library(fragmotion::${library} ALIAS fragmotion_${library})
endforeach()

if(PROJECT_IS_TOP_LEVEL)
  include(GNUInstallDirs)
  include(CMakePackageConfigHelpers)
  set(fragmotion_package "${CMAKE_INSTALL_LIBDIR}/cmake/fragmotion")
  install(TARGETS fragmotion_shared fragmotion_static EXPORT fragmotion COMPONENT game)
  install(FILES ${fragmotion_game_headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/fragmotion" COMPONENT game)
  install(EXPORT fragmotion NAMESPACE fragmotion:: FILE fragmotionTargets.cmake DESTINATION "${fragmotion_package}"
          COMPONENT game)
  write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/game/fragmotionConfigVersion.cmake"
                                   COMPATIBILITY SameMinorVersion)
  configure_file(cmake/fragmotionConfig.cmake "${CMAKE_CURRENT_BINARY_DIR}/game/fragmotionConfig.cmake" COPYONLY)
  configure_file(cmake/fragmotion.pc.in "${CMAKE_CURRENT_BINARY_DIR}/game/fragmotion.pc" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/game/fragmotionConfig.cmake"
                "${CMAKE_CURRENT_BINARY_DIR}/game/fragmotionConfigVersion.cmake"
          DESTINATION "${fragmotion_package}" COMPONENT game)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/game/fragmotion.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
          COMPONENT game)
endif()
