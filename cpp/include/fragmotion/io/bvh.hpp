// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "fragmotion/motion/take.hpp"

namespace fragmotion {

/// Reads a BVH file (Biovision hierarchy). `unit` is the length of one file unit in metres (0.01: centimetres).
/// BVH's y-up world becomes z-up as (x, -z, y); joints' frames are the world's axes at rest. Position channels replace
/// the joint's OFFSET, as in Blender's importer. A bone's tip is its only child's head, the mean of its children's
/// heads, or its End Site.
/// Throws std::invalid_argument "FILE:LINE: what is wrong and what was expected" on anything malformed: truncated,
/// wrong channel or value counts, NaN, unknown words, unbalanced braces, no frames.
Take read_bvh(const std::filesystem::path& path, double unit = 0.01);

}  // namespace fragmotion
