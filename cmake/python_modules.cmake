# SPDX-License-Identifier: MIT
# The Python module fragmotion_core for each of FRAGMOTION_PYTHONS ("3.11;3.13"), on one build of the core: target
# fragmotion_core_311, file 3.11/fragmotion_core<suffix>. No such Python runs here: its headers (and import library) are
# FRAGMOTION_PYTHONS_DIR/3.11/include (and libs), and FRAGMOTION_MODULE_SUFFIX is its suffix with @ for 311.
file(GLOB fragmotion_bindings CONFIGURE_DEPENDS cpp/bindings/*.cpp)
set(FRAGMOTION_PYTHONS_DIR "" CACHE PATH "Folder of the headers of the Pythons")
set(FRAGMOTION_PYBIND11_INCLUDE "" CACHE PATH "Folder of pybind11's headers")
set(FRAGMOTION_MODULE_SUFFIX "" CACHE STRING "End of a module's file name, with @ for the Python's digits")
foreach(python ${FRAGMOTION_PYTHONS})
  string(REPLACE "." "" digits ${python})
  string(REPLACE "@" ${digits} suffix ${FRAGMOTION_MODULE_SUFFIX})
  set(module fragmotion_core_${digits})
  if(APPLE)
    add_library(${module} SHARED EXCLUDE_FROM_ALL ${fragmotion_bindings})
    target_link_options(${module} PRIVATE -undefined dynamic_lookup -Wl,-install_name,fragmotion_core${suffix})
  else()
    add_library(${module} MODULE EXCLUDE_FROM_ALL ${fragmotion_bindings})
  endif()
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    set(exports "${CMAKE_CURRENT_LIST_DIR}/python_module.map")
    target_link_options(${module} PRIVATE "-Wl,--version-script=${exports}")
    set_property(TARGET ${module} APPEND PROPERTY LINK_DEPENDS "${exports}")
  endif()
  set_target_properties(${module} PROPERTIES
    PREFIX "" OUTPUT_NAME fragmotion_core SUFFIX ${suffix} NO_SONAME ON
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${python}"
    UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  target_include_directories(${module} SYSTEM PRIVATE
    "${FRAGMOTION_PYBIND11_INCLUDE}" "${FRAGMOTION_PYTHONS_DIR}/${python}/include")
  target_link_libraries(${module} PRIVATE fragmotion)
  if(WIN32)
    target_link_libraries(${module} PRIVATE "${FRAGMOTION_PYTHONS_DIR}/${python}/libs/python${digits}.lib")
  endif()
  target_compile_definitions(${module} PRIVATE FRAGMOTION_VERSION="${PROJECT_VERSION}")
  # What computes is the core; the bindings only hand arrays on: as one small file they compile in a quarter of the time.
  target_compile_options(${module} PRIVATE -Os)
  target_link_options(${module} PRIVATE -s)
endforeach()
