// SPDX-License-Identifier: MIT
#include "arrays.hpp"

namespace fragmotion::bindings {
namespace {

// An error may quote a file's name or words, which need not be UTF-8.
void translate(std::exception_ptr error) {
  try {
    std::rethrow_exception(std::move(error));
  } catch (const std::invalid_argument& refusal) {
    const std::string text = refusal.what();
    const auto message = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
    PyErr_SetObject(PyExc_ValueError, message.ptr());
  }
}

}  // namespace

void bind_errors(py::module_& m) {
  py::register_local_exception_translator(translate);
  py::register_exception<Cancelled>(m, "Cancelled", PyExc_RuntimeError);
}

}  // namespace fragmotion::bindings
