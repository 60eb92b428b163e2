// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "io/asf.hpp"
#include "motion/take.hpp"

namespace fragmotion {

// The readers' work on a text at hand, apart from the disk; `file` names it in errors. Each throws as the function that
// reads a file does.

Take parse_bvh(std::string text, const std::string& file, double unit);
AsfModel parse_asf(std::string text, const std::string& file);
Take parse_amc(std::string text, const std::string& file, const AsfModel& model, double rate);

}  // namespace fragmotion
