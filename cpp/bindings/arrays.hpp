// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "control/trace.hpp"
#include "threads.hpp"

namespace fragmotion::bindings {

/// Arrays as C++ reads them; what comes otherwise, as from a view of packed bytes, is copied.
constexpr int kPlain = py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
using Doubles = py::array_t<double, kPlain>;
using Floats = py::array_t<float, kPlain>;
using Flags = py::array_t<bool, kPlain>;

/// Throws std::logic_error unless so many values fill an array of this shape.
void check_size(std::size_t count, const std::vector<py::ssize_t>& shape);

/// The vector's values as an array that takes the vector over, without a copy.
template <typename T>
py::array_t<T> to_array(std::vector<T> values, std::vector<py::ssize_t> shape) {
  check_size(values.size(), shape);
  auto* owned = new std::vector<T>(std::move(values));
  const py::capsule free(owned, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(std::move(shape), owned->data(), free);
}

/// A read-only view of values that `owner` keeps and that fill an array of this shape.
template <typename T>
py::array_t<T> view(const std::vector<T>& values, std::vector<py::ssize_t> shape, const py::handle& owner) {
  check_size(values.size(), shape);
  py::array_t<T> array(std::move(shape), values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Throws ValueError unless `array` has this shape; -1 stands for any length that an int holds.
void check_shape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& shape);

/// The values of an array.
std::vector<double> to_vector(const Doubles& array);

/// The values of an array; throws ValueError unless all are between two numbers.
std::vector<double> to_vector(const Doubles& array, const std::string& name, double least, double greatest);

/// A control from [4]; throws ValueError on what is not a number or beyond all controls.
Control to_control(const Doubles& values);

/// A trace from [T,4], with the same checks.
Trace to_trace(const Doubles& controls);
/// Its controls [T,4].
py::array_t<double> to_rows(const Trace& trace);

/// Traces from [T,4] each.
std::vector<Trace> to_traces(const std::vector<Doubles>& traces);

/// Throws ValueError unless a name is UTF-8, as bytes for a string need not be.
void check_name(const std::string& name);

void bind_errors(py::module_& m);
void bind_skeleton(py::module_& m);
void bind_motion(py::module_& m);
void bind_io(py::module_& m);
void bind_retarget(py::module_& m);
void bind_doctor(py::module_& m);
void bind_control(py::module_& m);
void bind_fragments(py::module_& m);
void bind_classes(py::module_& m);
void bind_policy(py::module_& m);
void bind_character(py::module_& m);
void bind_runtime(py::module_& m);
void bind_bake(py::module_& m);
void bind_pins(py::module_& m);
void bind_direct(py::module_& m);
void bind_build(py::module_& m);
void bind_player_options(py::module_& m);
void bind_evaluate(py::module_& m);

}  // namespace fragmotion::bindings
