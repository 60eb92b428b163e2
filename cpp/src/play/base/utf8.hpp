// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace fragmotion {

/// Whether a text is UTF-8: no byte out of place, no sequence too long, no surrogate, nothing beyond U+10FFFF.
bool is_utf8(std::string_view text);

/// A text as UTF-8: as it is where it is so, else taken for Latin-1, in which any byte is a letter. So texts that
/// differ stay different, and old files of western Europe read right; the names of others, as of Shift-JIS, are strange
/// but whole.
std::string as_utf8(std::string text);

}  // namespace fragmotion
