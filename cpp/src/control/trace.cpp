// SPDX-License-Identifier: MIT
#include "fragmotion/control/trace.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "base/read_file.hpp"
#include "base/text_reader.hpp"
#include "base/write_file.hpp"
#include "control/parse_trace.hpp"

namespace fragmotion {

namespace {

constexpr const char* kColumns[] = {"velocity_x", "velocity_y", "turn", "jump"};
constexpr double kFastest = 1e9;  // m/s: three times as fast as light
constexpr const char* kHeader = "velocity_x,velocity_y,turn,jump";

[[noreturn]] void fail(const std::string& file, std::size_t line, const std::string& cause) {
  throw std::invalid_argument(file + ":" + std::to_string(line) + ": " + cause);
}

std::string_view trim(std::string_view text) {
  const char* blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Takes the text up to the next `separator`, trimmed, and drops both from `text`.
std::string_view take_piece(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view piece = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return trim(piece);
}

/// The values of a row as they are written; `fail` is told how many there are where they are not four.
template <typename Fail>
std::array<std::string_view, 4> split_row(std::string_view row, const Fail& fail) {
  const auto count = static_cast<std::size_t>(std::count(row.begin(), row.end(), ',')) + 1;
  std::array<std::string_view, 4> cells;
  if (count != cells.size()) fail(count);
  for (std::string_view& cell : cells) cell = take_piece(row, ',');
  return cells;
}

void check_header(const std::string& file, std::string_view line) {
  const auto refuse = [&](std::size_t /*columns*/ = 0) {
    fail(file, 1, "the header is '" + std::string(line.substr(0, 80)) + "', expected '" + kHeader + "'");
  };
  const auto names = split_row(line, refuse);
  if (!std::equal(names.begin(), names.end(), std::begin(kColumns))) refuse();
}

void check_control(const std::string& file, std::size_t line, const Control& control) {
  const double values[] = {control.x, control.y, control.turn, control.jump};
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(values[i])) fail(file, line, std::string(kColumns[i]) + " is not a finite number");
  }
  for (int i = 0; i < 2; ++i) {
    if (std::abs(values[i]) > kFastest) fail(file, line, std::string(kColumns[i]) + " is over 1e9 m/s");
  }
  if (std::abs(control.turn) > kMostTurn) {
    fail(file, line,
         "turn is " + std::to_string(control.turn) +
             ", expected -1 (right) to 1 (left), or up to 6 times that to face about");
  }
  if (control.jump < 0 || control.jump > 1)
    fail(file, line, "jump is " + std::to_string(control.jump) + ", expected 0 to 1");
}

Control parse_control(const std::string& file, std::size_t line, std::string_view text) {
  const auto cells = split_row(text, [&](std::size_t count) {
    fail(file, line,
         "expected 4 values (" + std::string(kHeader) + "), found " +
             (text.empty() ? "an empty line" : std::to_string(count)));
  });
  double values[4];
  for (int i = 0; i < 4; ++i) {
    const std::optional<double> value = parse_double(cells[i]);
    if (!value) {
      fail(file, line,
           std::string(kColumns[i]) + " is '" + std::string(cells[i].substr(0, 40)) + "', expected a finite number");
    }
    values[i] = *value;
  }
  const Control control{values[0], values[1], values[2], values[3]};
  check_control(file, line, control);
  return control;
}

void append_number(double value, char end, std::string& text) {
  char buffer[32];
#ifdef __cpp_lib_to_chars
  text.append(buffer, std::to_chars(buffer, buffer + sizeof(buffer), value).ptr);
#else  // Apple's standard library; 17 digits read back the same, too
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(std::numeric_limits<double>::max_digits10);
  stream << value;
  text += stream.str();
#endif
  text += end;
}

std::string format_trace(const Trace& trace) {
  std::string text = std::string(kHeader) + "\n";
  for (const Control& control : trace) {
    append_number(control.x, ',', text);
    append_number(control.y, ',', text);
    append_number(control.turn, ',', text);
    append_number(control.jump, '\n', text);
  }
  return text;
}

}  // namespace

Trace parse_trace(const std::string& text, const std::string& file) {
  std::string_view left = text;
  if (left.substr(0, 3) == "\xEF\xBB\xBF") left.remove_prefix(3);  // UTF-8 byte order mark
  left = left.substr(0, left.find_last_not_of(" \t\r\n") + 1);     // blank lines at the end
  check_header(file, take_piece(left, '\n'));
  Trace trace;
  std::size_t line = 1;
  while (!left.empty()) trace.push_back(parse_control(file, ++line, take_piece(left, '\n')));
  if (trace.size() < 2)
    fail(file, line, "the trace ends after " + std::to_string(trace.size()) + " rows, expected at least 2");
  return trace;
}

std::vector<int> snap(const ControlSpace& space, const Trace& trace) {
  std::vector<int> indices;
  for (const Control& control : trace) indices.push_back(space.nearest(control));
  return indices;
}

Trace read_trace(const std::filesystem::path& path) { return parse_trace(read_file(path), path.filename().u8string()); }

void write_trace(const std::filesystem::path& path, const Trace& trace) {
  const std::string file = path.filename().u8string();
  for (std::size_t i = 0; i < trace.size(); ++i) check_control(file, i + 2, trace[i]);
  if (trace.size() < 2)
    throw std::invalid_argument(file + ": the trace has " + std::to_string(trace.size()) +
                                " controls, expected at least 2");
  write_file(path, format_trace(trace));
}

}  // namespace fragmotion
