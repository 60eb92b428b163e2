// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "character/character.hpp"
#include "fragments/acts.hpp"
#include "fragments/distance.hpp"

namespace fragmotion::bindings {
namespace {

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

}  // namespace

void bind_fragments(py::module_& m) {
  m.def(
      "names_idle", [](const std::string& clip) { return words_beside_idle(clip) >= 0; }, py::arg("clip"));
  m.def(
      "trajectories",
      [](const Character& c, int poses) {
        const Trajectories t = without_gil([&] { return trajectories(c.pool, poses); });
        const int tips = static_cast<int>(measured_bones(c.pool.skeleton).size());
        return py::make_tuple(to_points(t.whole.values(), t.count, t.whole.stride(), poses * tips),
                              to_points(t.first, t.count, t.pose_stride, tips),
                              to_points(t.last, t.count, t.pose_stride, tips));
      },
      py::arg("character"), py::arg("poses") = kPoses);
}

}  // namespace fragmotion::bindings
