// SPDX-License-Identifier: MIT
#include "threads.hpp"

#ifdef __GLIBCXX__
#include <cxxabi.h>

#include <chrono>
#include <thread>
#endif

namespace fragmotion::bindings {
namespace {

// What `call` returns, which waits for the GIL: while Python ends, CPython before 3.14 ends a thread that does. With
// the GNU library that is an exception, which must not get to a destructor; this thread stays until the process has
// ended.
template <typename Call>
auto unless_python_ends(const Call& call) {
#ifdef __GLIBCXX__
  try {
    return call();
  } catch (const abi::__forced_unwind&) {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
#else
  return call();
#endif
}

}  // namespace

void GilRelease::take_back() {
  unless_python_ends([&] { PyEval_RestoreThread(thread_); });
}

GilHold::GilHold() : state_(unless_python_ends([] { return PyGILState_Ensure(); })) {}

py::object GilHold::call(const py::object& callable, double x, double y, double z) {
  PyObject* const answer = unless_python_ends([&] { return PyObject_CallFunction(callable.ptr(), "ddd", x, y, z); });
  if (answer == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(answer);
}

bool GilRelease::goes_on(const py::object& callback, double fraction, const std::string& stage) {
  take_back();
  struct Again {
    PyThreadState*& thread;
    ~Again() { thread = PyEval_SaveThread(); }
  };
  const Again again{thread_};
  // Not pybind11's call: where Python ends in the middle of it, nothing may be destroyed.
  PyObject* const answer =
      unless_python_ends([&] { return PyObject_CallFunction(callback.ptr(), "ds", fraction, stage.c_str()); });
  if (answer == nullptr) throw py::error_already_set();
  const auto owned = py::reinterpret_steal<py::object>(answer);
  return owned.is_none() || owned.cast<bool>();
}

}  // namespace fragmotion::bindings
