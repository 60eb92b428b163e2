// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <climits>
#include <cmath>
#include <locale>
#include <sstream>

#include "base/utf8.hpp"
#include "control/control.hpp"

namespace fragmotion::bindings {
namespace {

Control checked_control(const double* row, const std::string& label) {
  for (int k = 0; k < 4; ++k) {
    if (!std::isfinite(row[k])) throw std::invalid_argument(label + " holds what is not a number");
    if (std::abs(row[k]) > kMostControl) throw std::invalid_argument(label + " holds a number beyond a million");
  }
  return {row[0], row[1], row[2], row[3]};
}

std::string printed(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

}  // namespace

void check_shape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& shape) {
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (py::ssize_t i = 0; fits && i < array.ndim(); ++i)
    fits = shape[i] < 0 ? array.shape(i) <= INT_MAX : array.shape(i) == shape[i];
  if (fits) return;
  std::string expected, found;
  for (const py::ssize_t length : shape)
    expected += (expected.empty() ? "" : ", ") + (length < 0 ? "any" : std::to_string(length));
  for (py::ssize_t i = 0; i < array.ndim(); ++i) found += (i == 0 ? "" : ", ") + std::to_string(array.shape(i));
  throw std::invalid_argument(name + " must have the shape [" + expected + "], not [" + found + "]");
}

void check_size(std::size_t count, const std::vector<py::ssize_t>& shape) {
  std::size_t size = 1;
  for (const py::ssize_t length : shape) size *= static_cast<std::size_t>(length);
  if (size == count) return;
  throw std::logic_error(std::to_string(count) + " values do not fill an array of " + std::to_string(size));
}

std::vector<double> to_vector(const Doubles& array) { return {array.data(), array.data() + array.size()}; }

std::vector<double> to_vector(const Doubles& array, const std::string& name, double least, double greatest) {
  std::vector<double> values = to_vector(array);
  for (const double value : values) {
    if (value >= least && value <= greatest) continue;
    throw std::invalid_argument(name + " must hold numbers from " + printed(least) + " to " + printed(greatest) +
                                ", not " + printed(value));
  }
  return values;
}

Control to_control(const Doubles& values) {
  check_shape(values, "a control", {4});
  return checked_control(values.data(), "the control");
}

Trace to_trace(const Doubles& controls) {
  check_shape(controls, "a trace", {-1, 4});
  Trace trace;
  for (py::ssize_t i = 0; i < controls.shape(0); ++i) {
    trace.push_back(checked_control(controls.data(i, 0), "control " + std::to_string(i) + " of the trace"));
  }
  return trace;
}

py::array_t<double> to_rows(const Trace& trace) {
  std::vector<double> rows;
  for (const Control& c : trace) rows.insert(rows.end(), {c.x, c.y, c.turn, c.jump});
  return to_array(std::move(rows), {static_cast<py::ssize_t>(trace.size()), 4});
}

std::vector<Trace> to_traces(const std::vector<Doubles>& traces) {
  std::vector<Trace> controls;
  for (const Doubles& trace : traces) controls.push_back(to_trace(trace));
  return controls;
}

void check_name(const std::string& name) {
  if (!is_utf8(name)) throw std::invalid_argument("the name '" + name + "' is not UTF-8");
}

}  // namespace fragmotion::bindings
