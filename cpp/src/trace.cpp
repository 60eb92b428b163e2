// SPDX-License-Identifier: MIT
#include "fragmotion/trace.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "text_reader.hpp"
#include "write_file.hpp"

namespace fragmotion {

namespace {

constexpr const char* kColumns[] = {"velocity_x", "velocity_y", "turn", "jump"};
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

/// Pieces between `separator`s, trimmed.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (;;) {
    const std::size_t end = text.find(separator);
    pieces.push_back(trim(text.substr(0, end)));
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + 1);
  }
}

std::string read_text(const std::filesystem::path& path) {
  std::error_code error;
  std::ifstream stream;
  // A directory opens like a file on some systems.
  if (std::filesystem::is_regular_file(path, error)) stream.open(path, std::ios::binary);
  if (!stream.is_open()) throw std::invalid_argument(path.filename().u8string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string_view> trace_lines(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // UTF-8 byte order mark
  std::vector<std::string_view> lines = split(text, '\n');
  while (lines.size() > 1 && lines.back().empty()) lines.pop_back();
  return lines;
}

void check_header(const std::string& file, std::string_view line) {
  const std::vector<std::string_view> names = split(line, ',');
  if (!std::equal(names.begin(), names.end(), std::begin(kColumns), std::end(kColumns)))
    fail(file, 1, "the header is '" + std::string(line.substr(0, 80)) + "', expected '" + kHeader + "'");
}

void check_control(const std::string& file, std::size_t line, const Control& control) {
  const double values[] = {control.x, control.y, control.turn, control.jump};
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(values[i])) fail(file, line, std::string(kColumns[i]) + " is not a finite number");
  }
  if (std::abs(control.turn) > 1)
    fail(file, line, "turn is " + std::to_string(control.turn) + ", expected -1 (right) to 1 (left)");
  if (control.jump < 0 || control.jump > 1)
    fail(file, line, "jump is " + std::to_string(control.jump) + ", expected 0 to 1");
}

Control parse_control(const std::string& file, std::size_t line, std::string_view text) {
  const std::vector<std::string_view> cells = split(text, ',');
  if (cells.size() != 4)
    fail(file, line,
         "expected 4 values (" + std::string(kHeader) + "), found " +
             (text.empty() ? "an empty line" : std::to_string(cells.size())));
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

Trace read_trace(const std::filesystem::path& path) {
  const std::string file = path.filename().u8string();
  const std::string text = read_text(path);
  const std::vector<std::string_view> lines = trace_lines(text);
  check_header(file, lines[0]);
  Trace trace;
  for (std::size_t i = 1; i < lines.size(); ++i) trace.push_back(parse_control(file, i + 1, lines[i]));
  if (trace.size() < 2)
    fail(file, lines.size(), "the trace ends after " + std::to_string(trace.size()) + " rows, expected at least 2");
  return trace;
}

void write_trace(const std::filesystem::path& path, const Trace& trace) {
  const std::string file = path.filename().u8string();
  for (std::size_t i = 0; i < trace.size(); ++i) check_control(file, i + 2, trace[i]);
  if (trace.size() < 2)
    throw std::invalid_argument(file + ": the trace has " + std::to_string(trace.size()) +
                                " controls, expected at least 2");
  write_file(path, format_trace(trace));
}

}  // namespace fragmotion
