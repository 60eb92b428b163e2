// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <climits>
#include <cmath>

#include "arrays.hpp"
#include "fragmotion/character/character.hpp"
#include "fragmotion/classes/clustering.hpp"
#include "fragmotion/policy/anticipate.hpp"
#include "fragmotion/policy/greedy.hpp"
#include "fragmotion/policy/iterate.hpp"
#include "fragmotion/policy/optimal.hpp"
#include "fragmotion/policy/svm.hpp"

namespace fragmotion::bindings {
namespace {

using Floats = py::array_t<float, kPlain>;
using Indices = Doubles;  // of any kind, so that no number is cut or wrapped before it is looked at

constexpr py::ssize_t kPoints = ControlSpace::kPoints;
constexpr double kMostFeature = 1e6;  // class_features gives a few units; the SVM squares differences

// Points [N, K, 3] as trajectories of one pose, padded as Dis wants them.
Trajectories to_trajectories(const Floats& points) {
  check_shape(points, "points", {-1, -1, 3});
  const auto values = points.unchecked<3>();
  const int count = static_cast<int>(values.shape(0)), size = static_cast<int>(values.shape(1));
  if (size > INT_MAX / 3 - kLanes) throw std::invalid_argument("a fragment of " + std::to_string(size) + " points");
  Trajectories t;
  t.count = count;
  t.stride = padded(size);
  t.whole.assign(std::size_t{3} * count * t.stride, 0);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < size; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const float value = values(i, k, axis);
        if (!std::isfinite(value)) throw std::invalid_argument("point " + std::to_string(i) + " is not a number");
        t.whole[(std::size_t{3} * i + axis) * t.stride + k] = value;
      }
    }
  }
  return t;
}

std::vector<float> to_weights(const std::optional<Floats>& weights, py::ssize_t count) {
  if (!weights) return std::vector<float>(count, 1);
  check_shape(*weights, "weights", {count});
  std::vector<float> values(weights->data(), weights->data() + count);
  for (const float value : values) {
    if (!(value > 0 && std::isfinite(value))) throw std::invalid_argument("the weights must be over 0");
  }
  return values;
}

// The rows of tips [count, 3, stride] as [count, size, 3].
py::array_t<float> to_points(const std::vector<float>& rows, int count, int stride, int size) {
  py::array_t<float> points({count, size, 3});
  auto values = points.mutable_unchecked<3>();
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < size; ++k) {
      for (int axis = 0; axis < 3; ++axis) values(i, k, axis) = rows[(std::size_t{3} * i + axis) * stride + k];
    }
  }
  return points;
}

Quality to_quality(const Doubles& smoothness, const Doubles& match) {
  const py::ssize_t n = smoothness.ndim() > 0 ? smoothness.shape(0) : 0;
  if (n == 0) throw std::invalid_argument("smoothness must have at least one class");
  check_shape(smoothness, "smoothness", {n, n});
  check_shape(match, "match", {n, kPoints});
  return {static_cast<int>(n), to_vector(smoothness, "smoothness", 0, 1), to_vector(match, "match", 0, 1)};
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

std::vector<int> to_controls(const Indices& trace) {
  check_shape(trace, "a trace of controls", {-1});
  return to_indices(trace, "a trace of controls", kPoints);
}

std::vector<std::vector<int>> to_traces(const std::vector<Indices>& traces) {
  std::vector<std::vector<int>> result;
  for (const Indices& trace : traces) result.push_back(to_controls(trace));
  return result;
}

std::vector<double> to_features(const Doubles& features, int classes) {
  check_shape(features, "features", {classes, -1});
  return to_vector(features, "features", -kMostFeature, kMostFeature);
}

py::array_t<int> to_table(Policy policy) { return to_array(std::move(policy.next), {policy.classes, kPoints}); }

Policy to_policy(const Indices& table, int classes) {
  check_shape(table, "table", {classes, kPoints});
  return {"table", classes, to_indices(table, "a table of classes", classes)};
}

void bind_measuring(py::module_& m) {
  m.def(
      "trajectories",
      [](const Character& c, int poses) {
        const Trajectories t = without_gil([&] { return trajectories(c.pool, poses); });
        const int tips = static_cast<int>(measured_bones(c.pool.skeleton).size());
        return py::make_tuple(to_points(t.whole, t.count, t.stride, poses * tips),
                              to_points(t.first, t.count, t.pose_stride, tips),
                              to_points(t.last, t.count, t.pose_stride, tips));
      },
      py::arg("character"), py::arg("poses") = kPoses);
  m.def(
      "cluster",
      [](const Floats& points, int classes, const std::optional<Floats>& weights, int restarts, std::uint64_t seed,
         int threads, const py::object& progress) {
        const Trajectories t = to_trajectories(points);
        const std::vector<float> counted = to_weights(weights, t.count);
        ClusterOptions options;
        options.classes = classes;
        options.restarts = restarts;
        options.seed = seed;
        options.threads = threads;
        Classes found =
            without_gil(progress, [&](const Progress& told) { return cluster(t, counted, options, {}, told); });
        return py::make_tuple(to_array(std::move(found.labels), {t.count}),
                              to_array(std::move(found.representatives), {found.count}), found.inertia);
      },
      py::arg("points"), py::arg("classes"), py::arg("weights") = py::none(), py::arg("restarts") = 4,
      py::arg("seed") = 1, py::arg("threads") = 0, py::arg("progress") = py::none());
}

void bind_paths(py::module_& m) {
  m.def(
      "optimal_path",
      [](const Doubles& smoothness, const Doubles& match, const Indices& trace) {
        const Quality quality = to_quality(smoothness, match);
        const std::vector<int> controls = to_controls(trace);
        OptimalPath path = without_gil([&] { return optimal_path(quality, controls); });
        const auto count = static_cast<py::ssize_t>(path.classes.size());
        return py::make_tuple(to_array(std::move(path.classes), {count}), path.quality);
      },
      py::arg("smoothness"), py::arg("match"), py::arg("trace"));
  m.def(
      "percent_of_optimal",
      [](const Doubles& smoothness, const Doubles& match, const Indices& table, const Indices& trace) {
        const Quality quality = to_quality(smoothness, match);
        const Policy policy = to_policy(table, quality.classes);
        const std::vector<int> controls = to_controls(trace);
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
      [](const std::vector<Indices>& traces, double stays, double goes_anywhere) {
        return to_array(control_model(to_traces(traces), {stays, goes_anywhere}), {kPoints, kPoints});
      },
      py::arg("traces"), py::arg("stays") = kAnyPlayer.stays, py::arg("goes_anywhere") = kAnyPlayer.goes_anywhere);
  m.def(
      "anticipate_table",
      [](const Doubles& smoothness, const Doubles& match, const std::vector<Indices>& traces) {
        return to_table(anticipate_policy(to_quality(smoothness, match), to_traces(traces)));
      },
      py::arg("smoothness"), py::arg("match"), py::arg("traces"));
  m.def(
      "iterate_table",
      [](const Doubles& smoothness, const Doubles& match, const std::vector<Indices>& traces, double discount,
         double tolerance) {
        const Quality quality = to_quality(smoothness, match);
        const std::vector<std::vector<int>> controls = to_traces(traces);
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
        const std::vector<double> described = to_features(features, quality.classes);
        const std::vector<std::vector<int>> controls = to_traces(traces);
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
        const std::vector<double> described = to_features(features, quality.classes);
        const std::vector<std::vector<int>> controls = to_traces(traces);
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

void bind_stages(py::module_& m) {
  bind_measuring(m);
  bind_paths(m);
  bind_policies(m);
  bind_svm(m);
}

}  // namespace fragmotion::bindings
