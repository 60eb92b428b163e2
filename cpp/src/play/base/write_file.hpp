// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace fragmotion {

/// Writes a file whole or not at all: to a new file beside it, onto the disk, and then into the place of the old one,
/// whose permissions it takes over. Whoever else writes or reads it at the same time, a reader meets one whole file. A
/// symbolic link is refused, as is all that is no regular file: no other file than this name's is ever written. New
/// files that killed programs left in the folder are removed, but none that is being written. Throws
/// std::invalid_argument "cannot write PATH: cause".
void write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace fragmotion
