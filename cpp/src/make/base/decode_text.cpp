// SPDX-License-Identifier: MIT
#include "base/decode_text.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/utf8.hpp"

namespace fragmotion {
namespace {

bool begins_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

void check_archive(std::string_view bytes, const std::string& file) {
  using Kind = std::pair<std::string_view, std::string_view>;
  for (const auto& [start, kind] :
       {Kind{"PK\x03\x04", "ZIP"}, Kind{"Rar!", "RAR"}, Kind{"7z\xBC\xAF", "7z"}, Kind{"\x1F\x8B", "gzip"}}) {
    if (!begins_with(bytes, start)) continue;
    throw std::invalid_argument(file + ": no text but a " + std::string(kind) +
                                " archive: unpack it, and take what is inside");
  }
}

/// Whether a text is UTF-16 whose letters begin with their high bytes, or with their low ones.
enum class Utf16 { kNone, kHighFirst, kLowFirst };

Utf16 utf16_of(std::string_view bytes) {
  if (bytes.size() < 2) return Utf16::kNone;
  if (begins_with(bytes, "\xFE\xFF") || (bytes[0] == '\0' && bytes[1] != '\0')) return Utf16::kHighFirst;
  if (begins_with(bytes, "\xFF\xFE") || (bytes[0] != '\0' && bytes[1] == '\0')) return Utf16::kLowFirst;
  return Utf16::kNone;
}

void append_utf8(char32_t letter, std::string& text) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | (letter >> shift & 0x3F)); };
  if (letter < 0x80) {
    text += static_cast<char>(letter);
  } else if (letter < 0x800) {
    text += {static_cast<char>(0xC0 | letter >> 6), tail(0)};
  } else if (letter < 0x10000) {
    text += {static_cast<char>(0xE0 | letter >> 12), tail(6), tail(0)};
  } else {
    text += {static_cast<char>(0xF0 | letter >> 18), tail(12), tail(6), tail(0)};
  }
}

/// Halves of a pair that stand alone are letters of which nothing is known.
std::string from_utf16(std::string_view bytes, bool high_first) {
  const auto unit = [&](std::size_t i) -> char32_t {
    const auto high = static_cast<unsigned char>(bytes[i + (high_first ? 0 : 1)]);
    return static_cast<char32_t>(high << 8 | static_cast<unsigned char>(bytes[i + (high_first ? 1 : 0)]));
  };
  std::string text;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    char32_t letter = unit(i);
    if ((letter & 0xF800) == 0xD800) {
      const bool is_pair = letter < 0xDC00 && i + 3 < bytes.size() && (unit(i + 2) & 0xFC00) == 0xDC00;
      letter = is_pair ? 0x10000 + ((letter & 0x3FF) << 10) + (unit(i + 2) & 0x3FF) : U'\uFFFD';
      if (is_pair) i += 2;
    }
    append_utf8(letter, text);
  }
  return text;
}

}  // namespace

std::string decode_text(std::string bytes, const std::string& file) {
  check_archive(bytes, file);
  const Utf16 kind = utf16_of(bytes);
  std::string text = kind == Utf16::kNone ? as_utf8(std::move(bytes)) : from_utf16(bytes, kind == Utf16::kHighFirst);
  if (begins_with(text, "\xEF\xBB\xBF")) text.erase(0, 3);  // the order mark
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
  return text;
}

}  // namespace fragmotion
