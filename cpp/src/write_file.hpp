// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace fragmotion {

/// Writes a file: to a temporary file beside it, then renamed, so that the old one stays whole where this fails. Throws
/// std::invalid_argument "cannot write PATH: the system's cause".
void write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace fragmotion
