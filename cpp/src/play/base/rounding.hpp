// SPDX-License-Identifier: MIT
#pragma once

namespace fragmotion {

/// m, s, rad or a ratio, of bodies: no more than that is what sums and products of doubles, of 16 digits, are off.
constexpr double kRounding = 1e-9;

/// The same of what has been in single precision, of 7 digits, as are the numbers of files and games.
constexpr double kFloatRounding = 1e-6;

/// m of a 1.8 m character, rad or a ratio: no more than that is what the few digits of files are off. A length that is
/// no longer has no direction.
constexpr double kFileRounding = 1e-3;

}  // namespace fragmotion
