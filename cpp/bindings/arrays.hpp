// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "fragmotion/progress.hpp"
#include "fragmotion/trace.hpp"

namespace fragmotion::bindings {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Flags = py::array_t<bool, py::array::c_style | py::array::forcecast>;

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

/// Throws ValueError unless `array` has this shape; -1 stands for any length.
void check_shape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& shape);

/// The values of an array.
std::vector<double> to_vector(const Doubles& array);

/// A control from [4].
Control to_control(const Doubles& values);

/// A trace from [T,4].
Trace to_trace(const Doubles& controls);

/// A Python callable (or None) as a progress callback that may be called without the GIL. It goes on where the callable
/// returns None.
Progress to_progress(const py::object& callback);

/// What `work` returns; meanwhile other Python threads run, so it must touch no Python object but the values of arrays.
template <typename Work>
auto without_gil(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

void bind_motion(py::module_& m);
void bind_rig(py::module_& m);
void bind_control(py::module_& m);
void bind_character(py::module_& m);
void bind_player(py::module_& m);
void bind_explain(py::module_& m);
void bind_stages(py::module_& m);

}  // namespace fragmotion::bindings
