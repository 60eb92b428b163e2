# SPDX-License-Identifier: MIT
# fragmotion_math: the functions of <cmath> whose last bits differ between C libraries, as those of musl, which lie in
# FRAGMOTION_ZIG_LIB_DIR. Linked into a module they go before the system's, so that a character is the same bit for bit
# wherever it was made. (For Windows zig links these by itself; sine, cosine, exp and log are its own everywhere.)
set(FRAGMOTION_ZIG_LIB_DIR "" CACHE PATH "Folder of zig's own sources and headers")
enable_language(C)
set(musl "${FRAGMOTION_ZIG_LIB_DIR}/libc/musl")
set(fragmotion_math_functions acos asin atan atan2 expm1 hypot pow tanh)
set(fragmotion_math_parts exp_data pow_data __math_divzero __math_invalid __math_oflow __math_uflow __math_xflow)
set(fragmotion_math_sources ${fragmotion_math_functions} ${fragmotion_math_parts})
list(TRANSFORM fragmotion_math_sources REPLACE "(.+)" "${musl}/src/math/\\1.c")
add_library(fragmotion_math STATIC ${fragmotion_math_sources})
target_include_directories(fragmotion_math PRIVATE
  "${musl}/arch/generic" "${musl}/src/include" "${musl}/src/internal" "${musl}/include")
target_include_directories(fragmotion_math SYSTEM PRIVATE
  "${FRAGMOTION_ZIG_LIB_DIR}/include" "${FRAGMOTION_ZIG_LIB_DIR}/libc/include/x86_64-linux-musl"
  "${FRAGMOTION_ZIG_LIB_DIR}/libc/include/generic-musl")
target_compile_options(fragmotion_math PRIVATE -nostdinc -w)
set_target_properties(fragmotion_math PROPERTIES C_VISIBILITY_PRESET hidden)
