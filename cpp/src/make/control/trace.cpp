// SPDX-License-Identifier: MIT
#include "control/trace.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/decode_text.hpp"
#include "base/ranges.hpp"
#include "base/read_file.hpp"
#include "base/text_reader.hpp"
#include "base/write_file.hpp"
#include "control/parse_trace.hpp"

namespace fragmotion {

namespace {

constexpr const char* kColumns[] = {"velocity_x", "velocity_y", "turn", "jump"};
constexpr const char* kHeader = "velocity_x,velocity_y,turn,jump";
constexpr const char* kMove = "move";
constexpr const char* kStyle = "style";
constexpr const char* kLook = "look";
constexpr const char* kHands[] = {"left_hand", "right_hand"};
constexpr const char* kLooks[] = {"captured", "ahead", "at"};
constexpr const char* kFree = "free";
constexpr const char* kHeld[] = {"at", "with"};  // in the world, along with the character
constexpr const char* kBlanks = " \t\r";

[[noreturn]] void fail(const std::string& file, std::size_t line, const std::string& cause) {
  throw std::invalid_argument(file + ":" + std::to_string(line) + ": " + cause);
}

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Takes the text up to the next `separator`, trimmed, and drops both from `text`.
std::string_view take_piece(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view piece = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return trim(piece);
}

/// Takes the next cell and its comma off a row: trimmed, or what its quotes hold, where two of them are one. Nothing
/// where quotes are elsewhere.
std::optional<std::string> take_cell(std::string_view& row) {
  const std::size_t begin = row.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos || row[begin] != '"') {
    const std::string_view plain = take_piece(row, ',');
    return plain.find('"') == std::string_view::npos ? std::optional<std::string>(plain) : std::nullopt;
  }
  row.remove_prefix(begin + 1);
  std::string cell;
  for (bool open = true; open;) {
    const std::size_t quote = row.find('"');
    if (quote == std::string_view::npos) return std::nullopt;
    open = row.substr(quote + 1, 1) == "\"";
    cell += row.substr(0, quote + (open ? 1 : 0));
    row.remove_prefix(quote + (open ? 2 : 1));
  }
  return take_piece(row, ',').empty() ? std::optional<std::string>(cell) : std::nullopt;
}

std::size_t count_cells(std::string_view row) {
  std::size_t count = 1;
  bool quoted = false;
  for (const char c : row) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) ++count;
  }
  return count;
}

/// The columns after the numbers, as the header names them.
std::vector<std::string> parse_header(const std::string& file, std::string_view line) {
  const auto refuse = [&] {
    fail(file, 1,
         "the header is '" + std::string(line.substr(0, 80)) + "', expected '" + kHeader +
             "', after which there may be columns 'move' and one each of 'style', 'look', 'left_hand', 'right_hand'");
  };
  std::vector<std::string> further;
  std::string_view left = line;
  const std::size_t count = count_cells(line);
  if (count < std::size(kColumns)) refuse();
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<std::string> name = take_cell(left);
    const bool again = name && name != kMove && std::count(further.begin(), further.end(), *name) > 0;
    const bool known = name == kMove || name == kStyle || name == kLook || name == kHands[0] || name == kHands[1];
    if (i < std::size(kColumns) ? name != kColumns[i] : again || !known) refuse();
    if (i >= std::size(kColumns)) further.push_back(*name);
  }
  return further;
}

void check_control(const std::string& file, std::size_t line, const Control& control) {
  const double values[] = {control.x, control.y, control.turn, control.jump};
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(values[i])) fail(file, line, std::string(kColumns[i]) + " is not a finite number");
  }
  for (int i = 0; i < 2; ++i) {
    if (std::abs(values[i]) > kFarthestPlace) fail(file, line, std::string(kColumns[i]) + " is over 1e9 m/s");
  }
  if (std::abs(control.turn) > kMostTurn) {
    fail(file, line,
         "turn is " + std::to_string(control.turn) +
             ", expected -1 (right) to 1 (left), or up to 6 times that to face about");
  }
  if (control.jump < 0 || control.jump > 1)
    fail(file, line, "jump is " + std::to_string(control.jump) + ", expected 0 to 1");
}

Control parse_control(const std::string& file, std::size_t line, const std::string* cells) {
  double values[std::size(kColumns)];
  for (std::size_t i = 0; i < std::size(kColumns); ++i) {
    const std::optional<double> value = parse_double(cells[i]);
    if (!value) {
      fail(file, line, std::string(kColumns[i]) + " is '" + cells[i].substr(0, 40) + "', expected a finite number");
    }
    values[i] = *value;
  }
  const Control control{values[0], values[1], values[2], values[3]};
  check_control(file, line, control);
  return control;
}

/// Reads the rows below a header.
class RowParser {
 public:
  RowParser(const std::string& file, std::vector<std::string> further)
      : file_(file),
        further_(std::move(further)),
        cells_(std::size(kColumns) + further_.size()),
        held_(further_.size(), -1),
        last_(further_.size()) {}

  void parse(std::size_t line, std::string_view row) {
    split(line, row);
    found_.trace.push_back(parse_control(file_, line, cells_.data()));
    for (std::size_t i = 0; i < further_.size(); ++i) {
      std::string name = std::move(cells_[std::size(kColumns) + i]);
      if (further_[i] == kMove) {
        hold(held_[i], std::move(name));
      } else if (further_[i] == kStyle) {
        change(std::move(name));
      } else if (!name.empty() && name != last_[i]) {
        further_[i] == kLook ? look(line, name) : reach(line, further_[i] == kHands[1], name);
        last_[i] = std::move(name);
      }
    }
  }

  TraceFile take() { return std::move(found_); }

 private:
  void split(std::size_t line, std::string_view row) {
    const std::size_t count = count_cells(row);
    if (count != cells_.size()) {
      std::string header = kHeader;
      for (const std::string& name : further_) header += "," + name;
      fail(file_, line,
           "expected " + std::to_string(cells_.size()) + " values (" + header + "), found " +
               (row.empty() ? "an empty line" : std::to_string(count)));
    }
    for (std::string& cell : cells_) {
      std::optional<std::string> found = take_cell(row);
      if (!found) fail(file_, line, "quotes are not closed, or not around a whole value");
      cell = std::move(*found);
    }
  }

  /// `held` is the number of the move that the row before holds in this column, or -1.
  void hold(int& held, std::string name) {
    std::vector<Asked::Move>& moves = found_.asked.moves;
    if (name.empty()) {
      held = -1;
    } else if (held >= 0 && moves[held].name == name) {
      ++moves[held].held;
    } else {
      held = static_cast<int>(moves.size());
      moves.push_back({now(), std::move(name), 1});
    }
  }

  void change(std::string name) {
    std::vector<Asked::Style>& styles = found_.asked.styles;
    if (name.empty() || (!styles.empty() && styles.back().name == name)) return;
    styles.push_back({now(), std::move(name)});
  }

  void look(std::size_t line, const std::string& text) {
    const std::vector<std::string> words = words_of(text);
    const auto look = std::find(std::begin(kLooks), std::end(kLooks), words.front()) - std::begin(kLooks);
    const std::size_t count = look == 2 ? 4 : 1;
    if (look > 2 || words.size() != count) refuse(line, kLook, text, "captured, ahead, or at X Y Z");
    const Vector3 place = count > 1 ? place_of(line, kLook, words, 1) : Vector3(Vector3::Zero());
    found_.asked.looks.push_back({now(), static_cast<int>(look), place});
  }

  void reach(std::size_t line, int hand, const std::string& text) {
    const std::vector<std::string> words = words_of(text);
    if (words.size() == 1 && words[0] == kFree) {
      found_.asked.reaches.push_back({now(), hand, 0, false, Vector3::Zero()});
      return;
    }
    const std::optional<double> weight = parse_double(words[0]);
    const bool told = words.size() == 5 && (words[1] == kHeld[0] || words[1] == kHeld[1]);
    if (!told || !weight || !(*weight >= 0 && *weight <= 1))
      refuse(line, kHands[hand], text, "free, WEIGHT at X Y Z, or WEIGHT with X Y Z, the weight 0 to 1");
    found_.asked.reaches.push_back(
        {now(), hand, *weight, words[1] == kHeld[1], place_of(line, kHands[hand], words, 2)});
  }

  static std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    while (!text.empty()) words.emplace_back(take_piece(text, ' '));
    return words;
  }

  Vector3 place_of(std::size_t line, const char* column, const std::vector<std::string>& words, std::size_t first) {
    Vector3 place;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = parse_double(words[first + i]);
      if (!value || !(std::abs(*value) <= kFarthestPlace))
        refuse(line, column, words[first + i], "a place within 1e9 m");
      place[static_cast<Eigen::Index>(i)] = *value;
    }
    return place;
  }

  [[noreturn]] void refuse(std::size_t line, const char* column, const std::string& text, const char* expected) const {
    fail(file_, line, std::string(column) + " is '" + text.substr(0, 40) + "', expected " + expected);
  }

  int now() const { return static_cast<int>(found_.trace.size()) - 1; }

  const std::string& file_;
  std::vector<std::string> further_, cells_;
  std::vector<int> held_;
  std::vector<std::string> last_;  // of each column, but for moves and styles
  TraceFile found_;
};

void append_number(double value, std::string& text) {
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
}

void append_control(const Control& control, std::string& text) {
  append_number(control.x, text);
  for (const double value : {control.y, control.turn, control.jump}) {
    text += ',';
    append_number(value, text);
  }
}

void append_name(const std::string& name, std::string& text) {
  text += ',';
  if (name.find_first_of(",\"") == std::string::npos && trim(name) == name) {
    text += name;
    return;
  }
  text += '"';
  for (const char c : name) text.append(c == '"' ? 2 : 1, c);
  text += '"';
}

void check_asked(const std::string& what, const std::string& name, int control, std::size_t controls) {
  if (name.empty()) throw std::invalid_argument("a " + what + " has no name");
  if (name.find('\n') != std::string::npos)
    throw std::invalid_argument(what + " '" + name + "' has a line break in its name: a trace file cannot hold that");
  if (control < 0 || static_cast<std::size_t>(control) >= controls) {
    throw std::invalid_argument(what + " '" + name + "' is asked for before control " + std::to_string(control) +
                                " of " + std::to_string(controls));
  }
}

/// A name, or none, for each control.
using Names = std::vector<const std::string*>;

/// Each move in the first column that is free, and that does not hold the same move right before it.
std::vector<Names> columns_of(std::vector<Asked::Move>& moves, std::size_t controls) {
  std::stable_sort(moves.begin(), moves.end(), [](const auto& a, const auto& b) { return a.control < b.control; });
  std::vector<Names> columns;
  for (const Asked::Move& move : moves) {
    check_asked(kMove, move.name, move.control, controls);
    const auto is_free = [&](const Names& names) {
      const std::string* before = move.control > 0 ? names[move.control - 1] : nullptr;
      return names[move.control] == nullptr && (before == nullptr || *before != move.name);
    };
    auto column = std::find_if(columns.begin(), columns.end(), is_free);
    if (column == columns.end()) column = columns.insert(column, Names(controls));
    const std::size_t held = std::min<std::size_t>(std::max(move.held, 1), controls - move.control);
    std::fill_n(column->begin() + move.control, held, &move.name);
  }
  return columns;
}

Names column_of(const std::vector<Asked::Style>& styles, std::size_t controls) {
  Names names(controls);
  for (const Asked::Style& style : styles) {
    check_asked(kStyle, style.name, style.control, controls);
    std::fill(names.begin() + style.control, names.end(), &style.name);
  }
  return names;
}

void append_place(const Vector3& place, std::string& text) {
  for (const double value : place) {
    text += ' ';
    append_number(value, text);
  }
}

std::string text_of(const Asked::Look& look) {
  std::string text = kLooks[look.look];
  if (look.look == 2) append_place(look.place, text);
  return text;
}

std::string text_of(const Asked::Reach& reach) {
  std::string text;
  append_number(reach.weight, text);
  text += std::string(" ") + kHeld[reach.carried ? 1 : 0];
  append_place(reach.place, text);
  return text;
}

// What is asked for as texts, each of which stays until the next.
void append_texts(const std::string& name, std::vector<Asked::Style> texts, std::size_t controls,
                  std::vector<std::vector<std::string>>& columns, std::string& header) {
  if (texts.empty()) return;
  header += "," + name;
  std::vector<std::string>& column = columns.emplace_back(controls);
  for (const Asked::Style& text : texts) {
    check_asked(name, text.name, text.control, controls);
    std::fill(column.begin() + text.control, column.end(), text.name);
  }
}

std::vector<Asked::Style> texts_of_hand(const std::vector<Asked::Reach>& reaches, int hand) {
  std::vector<Asked::Style> texts;
  for (const Asked::Reach& reach : reaches) {
    if (reach.hand == hand) texts.push_back({reach.control, text_of(reach)});
  }
  return texts;
}

std::string format_trace(const Trace& trace, Asked asked) {
  std::vector<Names> columns = columns_of(asked.moves, trace.size());
  std::string text = kHeader;
  for (std::size_t i = 0; i < columns.size(); ++i) text += std::string(",") + kMove;
  if (!asked.styles.empty()) {
    columns.push_back(column_of(asked.styles, trace.size()));
    text += std::string(",") + kStyle;
  }
  std::vector<std::vector<std::string>> texts;
  std::vector<Asked::Style> looks;
  for (const Asked::Look& look : asked.looks) looks.push_back({look.control, text_of(look)});
  append_texts(kLook, std::move(looks), trace.size(), texts, text);
  for (int hand = 0; hand < 2; ++hand)
    append_texts(kHands[hand], texts_of_hand(asked.reaches, hand), trace.size(), texts, text);
  text += '\n';
  for (std::size_t i = 0; i < trace.size(); ++i) {
    append_control(trace[i], text);
    for (const Names& names : columns) append_name(names[i] == nullptr ? "" : *names[i], text);
    for (const std::vector<std::string>& column : texts) append_name(column[i], text);
    text += '\n';
  }
  return text;
}

}  // namespace

TraceFile parse_trace(std::string bytes, const std::string& file) {
  const std::string text = decode_text(std::move(bytes), file);
  std::string_view left = text;
  left = left.substr(0, left.find_last_not_of(" \t\r\n") + 1);  // blank lines at the end
  RowParser rows(file, parse_header(file, take_piece(left, '\n')));
  std::size_t line = 1;
  while (!left.empty()) rows.parse(++line, take_piece(left, '\n'));
  if (line < 3) {
    fail(file, line, "the trace ends after " + std::to_string(line - 1) + " rows, expected at least 2");
  }
  return rows.take();
}

namespace {

TraceFile read_trace_file(const std::filesystem::path& path) {
  return parse_trace(read_file(path), path.filename().u8string());
}

}  // namespace

std::vector<int> snap(const ControlSpace& space, const Trace& trace) {
  std::vector<int> indices;
  for (const Control& control : trace) indices.push_back(space.nearest(control));
  return indices;
}

Trace read_trace(const std::filesystem::path& path) { return read_trace_file(path).trace; }

Asked read_asked(const std::filesystem::path& path) { return read_trace_file(path).asked; }

void write_trace(const std::filesystem::path& path, const Trace& trace, const Asked& asked) {
  const std::string file = path.filename().u8string();
  for (std::size_t i = 0; i < trace.size(); ++i) check_control(file, i + 2, trace[i]);
  if (trace.size() < 2)
    throw std::invalid_argument(file + ": the trace has " + std::to_string(trace.size()) +
                                " controls, expected at least 2");
  write_file(path, format_trace(trace, asked));
}

}  // namespace fragmotion
