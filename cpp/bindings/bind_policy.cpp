// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "character/character.hpp"
#include "policy/anticipate.hpp"
#include "policy/greedy.hpp"
#include "policy/iterate.hpp"
#include "policy/optimal.hpp"
#include "policy/svm.hpp"

namespace fragmotion::bindings {
namespace {

using Indices = Doubles;  // of any kind, so that no number is cut or wrapped before it is looked at

constexpr int kMostControls = ControlLayout{kMostSpeeds, kMostDirections}.size();
constexpr double kMostFeature = 1e6;  // class_features gives a few units; the SVM squares differences

Quality to_quality(const Doubles& smoothness, const Doubles& match) {
  const py::ssize_t n = smoothness.ndim() > 0 ? smoothness.shape(0) : 0;
  if (n == 0) throw std::invalid_argument("smoothness must have at least one class");
  check_shape(smoothness, "smoothness", {n, n});
  check_shape(match, "match", {n, -1});
  const py::ssize_t controls = match.shape(1);
  if (controls == 0) throw std::invalid_argument("match must have at least one control");
  return {static_cast<int>(n), to_vector(smoothness, "smoothness", 0, 1), to_vector(match, "match", 0, 1),
          static_cast<int>(controls)};
}

// Whole numbers from 0 to under `count`.
std::vector<int> to_indices(const Indices& array, const std::string& name, py::ssize_t count) {
  std::vector<int> indices;
  for (const double index : to_vector(array, name, 0, static_cast<double>(count - 1))) {
    indices.push_back(static_cast<int>(index));
    if (indices.back() != index) throw std::invalid_argument(name + " must hold whole numbers");
  }
  return indices;
}

std::vector<int> to_controls(const Indices& trace, int controls) {
  check_shape(trace, "a trace of controls", {-1});
  return to_indices(trace, "a trace of controls", controls);
}

std::vector<std::vector<int>> to_control_traces(const std::vector<Indices>& traces, int controls) {
  std::vector<std::vector<int>> result;
  for (const Indices& trace : traces) result.push_back(to_controls(trace, controls));
  return result;
}

std::vector<double> to_features(const Doubles& features, int classes) {
  check_shape(features, "features", {classes, -1});
  return to_vector(features, "features", -kMostFeature, kMostFeature);
}

void check_controls_of(const ControlSpace& space, const Quality& quality) {
  if (space.size() == quality.controls) return;
  throw std::invalid_argument("match is of " + std::to_string(quality.controls) + " controls, and space has " +
                              std::to_string(space.size()));
}

py::array_t<int> to_table(Policy policy) { return to_array(std::move(policy.next), {policy.classes, policy.controls}); }

Policy to_policy(const Indices& table, const Quality& quality) {
  check_shape(table, "table", {quality.classes, quality.controls});
  return {"table", quality.classes, to_indices(table, "a table of classes", quality.classes), quality.controls};
}

void bind_paths(py::module_& m) {
  m.def(
      "optimal_path",
      [](const Doubles& smoothness, const Doubles& match, const Indices& trace) {
        const Quality quality = to_quality(smoothness, match);
        const std::vector<int> controls = to_controls(trace, quality.controls);
        OptimalPath path = without_gil([&] { return optimal_path(quality, controls); });
        const auto count = static_cast<py::ssize_t>(path.classes.size());
        return py::make_tuple(to_array(std::move(path.classes), {count}), path.quality);
      },
      py::arg("smoothness"), py::arg("match"), py::arg("trace"));
  m.def(
      "percent_of_optimal",
      [](const Doubles& smoothness, const Doubles& match, const Indices& table, const Indices& trace) {
        const Quality quality = to_quality(smoothness, match);
        const Policy policy = to_policy(table, quality);
        const std::vector<int> controls = to_controls(trace, quality.controls);
        return without_gil([&] { return percent_of_optimal(quality, policy, controls); });
      },
      py::arg("smoothness"), py::arg("match"), py::arg("table"), py::arg("trace"));
}

void bind_policies(py::module_& m) {
  m.def(
      "greedy_table",
      [](const Doubles& smoothness, const Doubles& match) {
        const Quality quality = to_quality(smoothness, match);
        return to_table(without_gil([&] { return greedy_policy(quality); }));
      },
      py::arg("smoothness"), py::arg("match"));
  m.def(
      "control_model",
      [](const std::vector<Indices>& traces, double stays, double goes_anywhere, int controls) {
        if (controls < 1 || controls > kMostControls)
          throw std::invalid_argument("controls must be 1 to " + std::to_string(kMostControls));
        return to_array(control_model(to_control_traces(traces, controls), {stays, goes_anywhere}, controls),
                        {controls, controls});
      },
      py::arg("traces"), py::arg("stays") = kGenericPrior.stays, py::arg("goes_anywhere") = kGenericPrior.goes_anywhere,
      py::arg("controls") = kPaperPoints);
  m.def(
      "anticipate_table",
      [](const Doubles& smoothness, const Doubles& match, const std::vector<Indices>& traces) {
        const Quality quality = to_quality(smoothness, match);
        return to_table(anticipate_policy(quality, to_control_traces(traces, quality.controls)));
      },
      py::arg("smoothness"), py::arg("match"), py::arg("traces"));
  m.def(
      "iterate_table",
      [](const Doubles& smoothness, const Doubles& match, const std::vector<Indices>& traces, double discount,
         double tolerance) {
        const Quality quality = to_quality(smoothness, match);
        const std::vector<std::vector<int>> controls = to_control_traces(traces, quality.controls);
        return to_table(without_gil([&] { return iterate_policy(quality, controls, {discount, tolerance}); }));
      },
      py::arg("smoothness"), py::arg("match"), py::arg("traces"), py::arg("discount") = IterateOptions().discount,
      py::arg("tolerance") = IterateOptions().tolerance);
}

void bind_svm(py::module_& m) {
  m.def(
      "class_features",
      [](const Character& c) {
        std::vector<double> features = without_gil([&] { return class_features(trajectories(c.pool), c.classes); });
        const py::ssize_t n = c.classes.count, width = static_cast<py::ssize_t>(features.size()) / n;
        return to_array(std::move(features), {n, width});
      },
      py::arg("character"));
  m.def(
      "svm_samples",
      [](const Doubles& smoothness, const Doubles& match, const std::vector<Indices>& traces, const Doubles& features,
         const ControlSpace& space) {
        const Quality quality = to_quality(smoothness, match);
        check_controls_of(space, quality);
        const std::vector<double> described = to_features(features, quality.classes);
        const std::vector<std::vector<int>> controls = to_control_traces(traces, quality.controls);
        SvmSamples samples = without_gil([&] { return svm_samples(quality, controls, described, space); });
        const auto count = static_cast<py::ssize_t>(samples.labels.size());
        return py::make_tuple(to_array(std::move(samples.inputs), {count, samples.width}),
                              to_array(std::move(samples.labels), {count}));
      },
      py::arg("smoothness"), py::arg("match"), py::arg("traces"), py::arg("features"), py::arg("space"));
  m.def(
      "svm_table",
      [](const Doubles& smoothness, const Doubles& match, const std::vector<Indices>& traces, const Doubles& features,
         const ControlSpace& space, double c, double gamma, int threads) {
        const Quality quality = to_quality(smoothness, match);
        check_controls_of(space, quality);
        const std::vector<double> described = to_features(features, quality.classes);
        const std::vector<std::vector<int>> controls = to_control_traces(traces, quality.controls);
        SvmOptions options;
        options.c = c;
        options.gamma = gamma;
        options.threads = threads;
        SvmPolicy trained = without_gil([&] { return svm_policy(quality, controls, described, space, options); });
        return py::make_tuple(to_table(std::move(trained.policy)), trained.c, trained.gamma, trained.accuracy);
      },
      py::arg("smoothness"), py::arg("match"), py::arg("traces"), py::arg("features"), py::arg("space"),
      py::arg("c") = 0.0, py::arg("gamma") = 0.0, py::arg("threads") = 0);
}

}  // namespace

void bind_policy(py::module_& m) {
  bind_paths(m);
  bind_policies(m);
  bind_svm(m);
}

}  // namespace fragmotion::bindings
