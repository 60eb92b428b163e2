// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace fragmotion {

/// The text that a file's bytes are, as UTF-8 without an order mark: of UTF-16, which an order mark or a first letter
/// of ASCII tells, of UTF-8, or else of Latin-1; lines that end with CR alone end with LF. std::invalid_argument, which
/// `file` begins, where they are an archive.
std::string decode_text(std::string bytes, const std::string& file);

}  // namespace fragmotion
