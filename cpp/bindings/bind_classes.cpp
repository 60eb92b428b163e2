// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <climits>
#include <cmath>

#include "arrays.hpp"
#include "classes/clustering.hpp"

namespace fragmotion::bindings {
namespace {

// Points [N, K, 3] as trajectories of one pose, padded as Dis wants them.
Trajectories to_trajectories(const Floats& points) {
  check_shape(points, "points", {-1, -1, 3});
  const auto values = points.unchecked<3>();
  const int count = static_cast<int>(values.shape(0)), size = static_cast<int>(values.shape(1));
  if (size > INT_MAX / 3 - TipRows::kBlock)
    throw std::invalid_argument("a fragment of " + std::to_string(size) + " points");
  Trajectories t;
  t.count = count;
  t.whole = TipRows(count, size);
  std::vector<float> row(t.whole.width());
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < size; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const float value = values(i, k, axis);
        if (!std::isfinite(value)) throw std::invalid_argument("point " + std::to_string(i) + " is not a number");
        row[static_cast<std::size_t>(axis) * t.whole.stride() + k] = value;
      }
    }
    t.whole.set(i, row.data());
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

}  // namespace

void bind_classes(py::module_& m) {
  m.attr("MOST_CLASSES") = kMostClasses;
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

}  // namespace fragmotion::bindings
