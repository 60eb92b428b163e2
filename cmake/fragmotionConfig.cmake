# SPDX-License-Identifier: MIT
# find_package(fragmotion): fragmotion::shared and fragmotion::static, the latter with the C++ library that it needs, and
# fragmotion::fragmotion, which is the one that BUILD_SHARED_LIBS asks for.
include("${CMAKE_CURRENT_LIST_DIR}/fragmotionTargets.cmake")
if(NOT TARGET fragmotion::fragmotion)
  add_library(fragmotion::fragmotion INTERFACE IMPORTED)
  if(BUILD_SHARED_LIBS)
    target_link_libraries(fragmotion::fragmotion INTERFACE fragmotion::shared)
  else()
    target_link_libraries(fragmotion::fragmotion INTERFACE fragmotion::static)
  endif()
endif()
