// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/decode_text.hpp"
#include "base/take_limits.hpp"
#include "base/types.hpp"

namespace fragmotion {

inline char ascii_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Whether two words are equal but for the case of ASCII letters.
inline bool same_word(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (ascii_lower(a[i]) != ascii_lower(b[i])) return false;
  }
  return true;
}

/// The finite number that `text` is as a whole, with a point for decimals whatever the locale.
inline std::optional<double> parse_double(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
#ifdef __cpp_lib_to_chars
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
#else  // Apple's standard library has no from_chars for doubles.
  std::istringstream stream{std::string(text)};
  stream.imbue(std::locale::classic());
  if (!(stream >> value) || stream.peek() != std::istringstream::traits_type::eof()) return std::nullopt;
#endif
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

/// The same of a text whose decimals may stand after a comma, where it is no list: programs write what their system
/// does.
inline std::optional<double> parse_decimal(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || text.find('.') != std::string_view::npos) return parse_double(text);
  return parse_double(std::string(text.substr(0, comma)) + '.' + std::string(text.substr(comma + 1)));
}

inline std::optional<long long> parse_integer(std::string_view text) {
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A text as words and lines. Words are cut at blanks; CR LF and LF end lines; views stay valid as long as the reader.
/// Where a comment character is given, a word that begins with it hides the rest of its line.
class TextReader {
 public:
  /// `file` names the text in errors.
  TextReader(std::string text, std::string file, char comment = '\0')
      : file_(std::move(file)), text_(decode_text(std::move(text), file_)), comment_(comment) {}

  /// The next word of this line, or an empty one at its end.
  std::string_view word_in_line() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    if (at_ < text_.size() && comment_ != '\0' && text_[at_] == comment_) skip_to_line_end();
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != '\n' && !is_blank(text_[at_])) ++at_;
    return std::string_view(text_).substr(begin, at_ - begin);
  }

  /// The next word on this or a later line, or an empty one at the file's end.
  std::string_view word() {
    for (;;) {
      const std::string_view found = word_in_line();
      if (!found.empty() || !next_line()) return found;
    }
  }

  /// The next word, which stays unread.
  std::string_view peek() {
    const std::string_view found = word();
    at_ -= found.size();
    return found;
  }

  std::string_view peek_in_line() {
    const std::string_view found = word_in_line();
    at_ -= found.size();
    return found;
  }

  /// A finite number from this line; `what` names it in the error.
  double number(std::string_view what) { return to_number(word_in_line(), what); }

  double to_number(std::string_view found, std::string_view what) const {
    const std::optional<double> value = parse_decimal(found);
    if (!value) fail(std::string(what) + " expected, found " + quoted(found));
    if (std::abs(*value) > kLargestNumber)
      fail(std::string(what) + " from -1e12 to 1e12 expected, found " + quoted(found));
    return *value;
  }

  Vector3 vector(std::string_view what) {
    Vector3 v;
    for (double& value : v) value = number(what);
    return v;
  }

  /// Reads the next word, which must be this one.
  void expect(std::string_view expected) {
    const std::string_view found = word();
    if (!same_word(found, expected)) fail("'" + std::string(expected) + "' expected, found " + quoted(found));
  }

  void skip_to_line_end() {
    at_ = text_.find('\n', at_);
    if (at_ == std::string::npos) at_ = text_.size();
  }

  void expect_line_end() {
    const std::string_view found = word_in_line();
    if (!found.empty()) fail("end of the line expected, found " + quoted(found));
  }

  [[noreturn]] void fail(const std::string& what) const { fail_at(line_, what); }

  [[noreturn]] void fail_at(int line, const std::string& what) const {
    throw std::invalid_argument(file_ + ":" + std::to_string(line) + ": " + what);
  }

  /// A found word for an error; lines and files end with an empty one.
  std::string quoted(std::string_view found) const {
    constexpr std::size_t kLongest = 40;
    if (!found.empty()) return "'" + std::string(found.substr(0, kLongest)) + "'";
    return at_ == text_.size() ? "the end of the file" : "the end of the line";
  }

  void check_name(const std::string& name) const {
    if (name.size() <= kLongestName) return;
    fail("name " + quoted(name) + "... has " + std::to_string(name.size()) + " bytes, at most " +
         std::to_string(kLongestName) + " are allowed");
  }

  /// Fails where one bone more than `bones` would be too many.
  void check_bones(std::size_t bones) const {
    if (bones >= kMostBones) fail("more than " + std::to_string(kMostBones) + " bones");
  }

  void check_poses(std::size_t frames, std::size_t bones) const {
    const std::size_t most = most_poses(text_.size());
    if (frames <= most / bones) return;
    fail(std::to_string(frames) + " frames of " + std::to_string(bones) + " bones in a file of " +
         std::to_string(text_.size()) + " bytes, which may hold at most " + std::to_string(most) +
         " poses of a bone: most of its bones would not move");
  }

  int line() const { return line_; }
  std::size_t bytes_left() const { return text_.size() - at_; }

  /// Where it reads, to come back to.
  struct Place {
    std::size_t at;
    int line;
  };
  Place place() const { return {at_, line_}; }
  void go_back(const Place& place) {
    at_ = place.at;
    line_ = place.line;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

  bool next_line() {
    if (at_ >= text_.size()) return false;
    ++at_;
    // A final line end begins no line that an error could name.
    if (at_ < text_.size()) ++line_;
    return true;
  }

  std::string file_;
  std::string text_;
  std::size_t at_ = 0;
  int line_ = 1;
  char comment_;
};

}  // namespace fragmotion
