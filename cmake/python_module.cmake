# SPDX-License-Identifier: MIT
# The Python module fragmotion_core: one extension module, its stub and the command `fragmotion` beside it.
file(GLOB fragmotion_bindings CONFIGURE_DEPENDS cpp/bindings/*.cpp)
if(NOT fragmotion_bindings)
  message(STATUS "cpp/bindings holds no source yet: no Python module")
  return()
endif()
set(PYBIND11_FINDPYTHON ON)
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 CONFIG REQUIRED)
pybind11_add_module(fragmotion_core NO_EXTRAS ${fragmotion_bindings})
target_link_libraries(fragmotion_core PRIVATE fragmotion)
# What computes is the core; the bindings only hand arrays on: as one file they compile in a third of the time, and not
# optimized to the last in two thirds of that.
set_target_properties(fragmotion_core PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
target_compile_options(fragmotion_core PRIVATE -Wall -Wextra -Wpedantic $<$<CONFIG:Release>:-O1>)
target_compile_definitions(fragmotion_core PRIVATE FRAGMOTION_VERSION="${PROJECT_VERSION}")
install(TARGETS fragmotion_core LIBRARY DESTINATION .)
install(FILES cpp/bindings/fragmotion_core.pyi DESTINATION .)
install(DIRECTORY cpp/bindings/fragmotion_command DESTINATION . FILES_MATCHING PATTERN *.py)
# What of the add-on reads files by Blender's importers, for the command where bpy is installed.
file(STRINGS cmake/fragmotion_blender.txt fragmotion_blender)
foreach(file IN LISTS fragmotion_blender)
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES addon/fragmotion/${file} DESTINATION fragmotion_blender/${folder})
endforeach()
