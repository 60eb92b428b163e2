// SPDX-License-Identifier: MIT
#include <cmath>

#include "arrays.hpp"

namespace fragmotion::bindings {

void check_shape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& shape) {
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (py::ssize_t i = 0; fits && i < array.ndim(); ++i) fits = shape[i] < 0 || array.shape(i) == shape[i];
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

Control to_control(const Doubles& values) {
  check_shape(values, "a control", {4});
  return {*values.data(0), *values.data(1), *values.data(2), *values.data(3)};
}

Trace to_trace(const Doubles& controls) {
  check_shape(controls, "a trace", {-1, 4});
  Trace trace;
  for (py::ssize_t i = 0; i < controls.shape(0); ++i) {
    const double* row = controls.data(i, 0);
    for (int k = 0; k < 4; ++k) {
      if (!std::isfinite(row[k]))
        throw std::invalid_argument("control " + std::to_string(i) + " of the trace is not a number");
    }
    trace.push_back({row[0], row[1], row[2], row[3]});
  }
  return trace;
}

Progress to_progress(const py::object& callback) {
  if (callback.is_none()) return {};
  return [callback = callback.ptr()](double fraction, const std::string& stage) {
    const py::gil_scoped_acquire gil;
    const py::object goes_on = py::handle(callback)(fraction, stage);
    return goes_on.is_none() || goes_on.cast<bool>();
  };
}

}  // namespace fragmotion::bindings

PYBIND11_MODULE(fragmotion_core, m) {
  namespace b = fragmotion::bindings;
  m.doc() = "Fragment-based responsive character motion (Cheng, Liu, Pan and Tang 2009).";
  m.attr("__version__") = FRAGMOTION_VERSION;
  pybind11::register_exception<fragmotion::Cancelled>(m, "Cancelled", PyExc_RuntimeError);
  b::bind_motion(m);
  b::bind_rig(m);
  b::bind_control(m);
  b::bind_character(m);
  b::bind_player(m);
  b::bind_explain(m);
  b::bind_stages(m);
}
