// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace fragmotion {

/// The bytes of a file. Throws std::invalid_argument "FILE: cannot be read, ..." on what is missing or no regular file
/// (a device or a pipe might never end), and on more than 2 GB.
std::string read_file(const std::filesystem::path& path);

}  // namespace fragmotion
