// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "doctor/examine.hpp"

namespace fragmotion {

/// The take without what these findings of its examination say, as far as they are mendable; others, and those of other
/// takes, change nothing. Examined again, nothing of a mended code is found. Lengths that change: a `calibration`, and
/// `frozen` or `missing` frames at an end, are cut off, `doubled` frames are left out, `dropped` ones filled in.
Take mend(const Take& take, const std::vector<Finding>& findings, const Progress& progress = {});

}  // namespace fragmotion
