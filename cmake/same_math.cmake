# SPDX-License-Identifier: MIT
# The same bits on every compiler and processor. fragmotion_math has the functions of <cmath> whose last bits differ
# between C libraries, as those of musl, from FRAGMOTION_MUSL_DIR. Linked in, they go before the system's. Without them
# the system's are used, and a character is the same only where those are.
set(FRAGMOTION_MUSL_DIR "${CMAKE_CURRENT_SOURCE_DIR}/build/musl" CACHE PATH
    "Folder with musl's sources as zig has them: lib/libc of PyPI's ziglang; without them the system's <cmath> is used")

# Vectors of Eigen's own sum in another order than one number after the other does.
add_compile_definitions(EIGEN_DONT_VECTORIZE)
# No fused multiply-add behind our back. Square roots need not set errno, so that loops over them vectorise; their
# values stay the same.
add_compile_options(-ffp-contract=off -fno-math-errno)

set(musl "${FRAGMOTION_MUSL_DIR}/musl")
if(NOT EXISTS "${musl}/src/math/exp.c")
  message(STATUS "mathematics: the system's, as there is no musl in ${FRAGMOTION_MUSL_DIR}")
  add_library(fragmotion_math INTERFACE)
  return()
endif()
message(STATUS "mathematics: musl's, compiled in from ${FRAGMOTION_MUSL_DIR}")
enable_language(C)
set(functions acos asin atan atan2 exp exp2 expm1 hypot log log1p log2 pow tanh)
set(parts __math_divzero __math_invalid __math_oflow __math_uflow __math_xflow __rem_pio2 __rem_pio2_large __tan
    exp_data log2_data log_data pow_data scalbn)
set(sources ${functions} ${parts})
list(TRANSFORM sources REPLACE "(.+)" "${musl}/src/math/\\1.c")
add_library(fragmotion_math_objects OBJECT ${sources} cpp/src/play/same_math/trigonometry.c)
# The headers of a 32-bit processor are right for all, as far as these go: Windows' long has 32 bits, too.
target_include_directories(fragmotion_math_objects PRIVATE
  "${musl}/arch/generic" "${musl}/src/include" "${musl}/src/internal" "${musl}/src/math" "${musl}/include")
target_include_directories(fragmotion_math_objects SYSTEM PRIVATE
  "${FRAGMOTION_MUSL_DIR}/include/arm-linux-musl" "${FRAGMOTION_MUSL_DIR}/include/generic-musl")
target_compile_options(fragmotion_math_objects PRIVATE
  -nostdinc -U__FP_FAST_FMA -ffunction-sections -fdata-sections -w $<$<CONFIG:Release>:-O2>
  $<$<C_COMPILER_ID:GNU>:-fno-align-jumps>)
set_target_properties(fragmotion_math_objects PROPERTIES C_VISIBILITY_PRESET hidden)
add_library(fragmotion_math INTERFACE)
# As objects, since a linker may search the system's archives before ours: zig's for Windows does.
target_link_libraries(fragmotion_math INTERFACE $<TARGET_OBJECTS:fragmotion_math_objects>)
add_compile_definitions(FRAGMOTION_SAME_MATH)

# A compiler works out what it knows of these by a mathematics of its own.
list(TRANSFORM functions PREPEND -fno-builtin- OUTPUT_VARIABLE no_builtins)
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:${no_builtins};-fno-builtin-sin;-fno-builtin-cos;-fno-builtin-tan>")
