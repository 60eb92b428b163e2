# SPDX-License-Identifier: MIT
# Compiles the sources of a target that share a folder as one: most of a file's time goes to Eigen's headers, so that the
# core takes less than half as long. A name in an unnamed namespace is therefore one to a folder.
function(compile_by_stage target)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(folder "${source}" DIRECTORY)
    get_filename_component(stage "${folder}" NAME)
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${stage}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
