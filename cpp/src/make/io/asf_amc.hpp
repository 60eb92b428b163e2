// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "motion/take.hpp"

namespace fragmotion {

/// Reads an Acclaim skeleton (ASF): units, root order and axis, bones with direction, length, axis and degrees of
/// freedom. One file unit is 0.0254/`length` metres (CMU's "length 0.45" means inches scaled by 0.45). z up as in
/// bvh.hpp. Frames are the world's axes at rest; bone 0 is "root" (its tip: the mean of its children's tips).
Skeleton read_asf(const std::filesystem::path& path);

/// The skeleton of an Acclaim motion: the .asf in its folder that is named by what stands before the motion's
/// underscore (02.asf of 02_01.amc) or by the whole of it, else the folder's only one; endings and names in capitals or
/// not, hidden files are none. Throws std::invalid_argument where there is no such file.
std::filesystem::path find_asf(const std::filesystem::path& amc);

/// Reads an Acclaim motion (AMC) on the skeleton of `asf`. AMC files hold no frame rate: `rate` is CMU's 120.
/// Throws std::invalid_argument "FILE:LINE: ..." as read_bvh does.
Take read_asf_amc(const std::filesystem::path& asf, const std::filesystem::path& amc, double rate = 120);

}  // namespace fragmotion
