// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "motion/take.hpp"

namespace fragmotion {

/// Reads a BVH file (Biovision hierarchy). `unit` is the length of one file unit in metres (0.01: centimetres).
/// BVH's y-up world becomes z-up as (x, -z, y); joints' frames are the world's axes at rest. Position channels replace
/// the joint's OFFSET, as in Blender's importer. A bone's tip is its only child's head, the mean of its children's
/// heads, or its End Site.
/// Throws std::invalid_argument "FILE:LINE: what is wrong and what was expected" on anything malformed: truncated,
/// wrong channel or value counts, NaN, unknown words, unbalanced braces, no frames.
Take read_bvh(const std::filesystem::path& path, double unit = 0.01);

/// Writes a take as a BVH file whose lengths are in units of `unit` metres, y up: the inverse of read_bvh. Joints'
/// frames are the world's axes at rest, whatever the bones' are; rotations are written in the order Z, X, Y, in
/// degrees; the root, and joints that leave their OFFSET, have positions before them; an end's tip is its End Site.
/// Numbers have six decimals, so that at a `unit` of 0.01 places are right to a micrometre; the same take is the same
/// bytes. Written as write_file does: whole or not at all. Throws std::invalid_argument on names that cannot be
/// read again (empty, with braces, or with other blanks than one between words), on numbers that are missing, naming
/// frame and bone, on no unit as read_bvh, and as write_file.
void write_bvh(const Take& take, const std::filesystem::path& path, double unit = 0.01);

}  // namespace fragmotion
