// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "base/progress.hpp"

namespace fragmotion::bindings {

namespace py = pybind11;

/// Lets other Python threads run as long as it lives. Where Python ends meanwhile, the thread that made it goes no
/// further, as any does from Python 3.14 on: before, CPython unwinds it, which no C++ function in between survives.
class GilRelease {
 public:
  GilRelease() : thread_(PyEval_SaveThread()) {}
  ~GilRelease() { take_back(); }
  GilRelease(const GilRelease&) = delete;
  GilRelease& operator=(const GilRelease&) = delete;

  /// What a Python callable of a fraction and a stage's name (or None) wants, from the thread that made this: to go on
  /// where it returns None or True. What it raises is thrown.
  bool goes_on(const py::object& callback, double fraction, const std::string& stage);

 private:
  void take_back();

  PyThreadState* thread_;
};

/// Has the GIL as long as it lives, in a thread that may have let it go; where Python ends, likewise.
class GilHold {
 public:
  GilHold();
  ~GilHold() { PyGILState_Release(state_); }
  GilHold(const GilHold&) = delete;
  GilHold& operator=(const GilHold&) = delete;

  /// What a callable of three numbers returns; what it raises is thrown.
  static py::object call(const py::object& callable, double x, double y, double z);

 private:
  PyGILState_STATE state_;
};

/// What `work` returns; meanwhile other Python threads run, so it must touch no Python object but the values of arrays.
template <typename Work>
auto without_gil(const Work& work) {
  const GilRelease released;
  return work();
}

/// The same of work(progress), which tells a Python callable, or nobody where that is None.
template <typename Work>
auto without_gil(const py::object& callback, const Work& work) {
  if (!callback.is_none() && PyCallable_Check(callback.ptr()) == 0) throw py::type_error("progress is not callable");
  const bool told = !callback.is_none();
  GilRelease released;
  const Progress progress = [&](double fraction, const std::string& stage) {
    return released.goes_on(callback, fraction, stage);
  };
  return work(told ? progress : Progress());
}

/// An object for one call at a time, as calls that change it let other threads run: the core's classes do not lock.
/// All but the work itself happens under the GIL.
template <typename T>
class OneCallAtATime {
 public:
  template <typename... Given>
  explicit OneCallAtATime(std::string name, Given&&... given)
      : name_(std::move(name)), object_(std::forward<Given>(given)...) {}

  /// Access for as long as it lives. Throws std::runtime_error while there is another.
  class Call {
   public:
    explicit Call(OneCallAtATime& of) : of_(of) {
      if (of.called_) {
        throw std::runtime_error("this " + of.name_ +
                                 " is in the middle of another call, of another thread or one whose progress callback "
                                 "this is: wait until it returns, or make a " +
                                 of.name_ + " for each");
      }
      of.called_ = true;
    }
    ~Call() { of_.called_ = false; }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    T* operator->() const { return &of_.object_; }
    T& operator*() const { return of_.object_; }

   private:
    OneCallAtATime& of_;
  };

 private:
  std::string name_;
  T object_;
  bool called_ = false;
};

}  // namespace fragmotion::bindings
