# SPDX-License-Identifier: MIT
# libsvm::libsvm, so that `#include <svm.h>` works: compiled in from FRAGMOTION_LIBSVM_DIR (`dev.py` puts the sources of
# PyPI's libsvm-official there), else the system's (Debian's libsvm-dev).
if(EXISTS "${FRAGMOTION_LIBSVM_DIR}/svm.cpp")
  add_library(libsvm STATIC "${FRAGMOTION_LIBSVM_DIR}/svm.cpp")
  target_include_directories(libsvm SYSTEM PUBLIC "${FRAGMOTION_LIBSVM_DIR}")
  target_compile_options(libsvm PRIVATE -w)
  target_link_libraries(libsvm PRIVATE fragmotion_math)
  message(STATUS "libsvm: compiled in from ${FRAGMOTION_LIBSVM_DIR}")
else()
  find_path(FRAGMOTION_SYSTEM_LIBSVM_INCLUDE svm.h PATH_SUFFIXES libsvm REQUIRED)
  find_library(FRAGMOTION_SYSTEM_LIBSVM svm REQUIRED)
  add_library(libsvm INTERFACE)
  target_include_directories(libsvm SYSTEM INTERFACE "${FRAGMOTION_SYSTEM_LIBSVM_INCLUDE}")
  target_link_libraries(libsvm INTERFACE "${FRAGMOTION_SYSTEM_LIBSVM}")
  message(STATUS "libsvm: the system's, ${FRAGMOTION_SYSTEM_LIBSVM}")
endif()
add_library(libsvm::libsvm ALIAS libsvm)
