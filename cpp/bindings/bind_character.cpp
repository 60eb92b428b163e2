// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "build/exclude_classes.hpp"
#include "build/moves.hpp"
#include "build/styles.hpp"
#include "character/naming.hpp"
#include "character/policy_file.hpp"
#include "control/trace.hpp"
#include "fragments/able_trace.hpp"
#include "fragments/coverage.hpp"
#include "policy/optimal.hpp"

namespace fragmotion::bindings {
namespace {

using Holder = std::shared_ptr<Character>;

// A property that views a member's values as an array [rows, columns]; columns 0: one dimension.
template <typename T, typename Get>
auto viewed(Get get, int columns_of_classes) {
  return [=](const py::object& self) {
    const auto& c = self.cast<const Character&>();
    const std::vector<T>& values = get(c);
    const auto size = static_cast<py::ssize_t>(values.size());
    const py::ssize_t rows = c.classes.count;
    return columns_of_classes != 0 ? view(values, {rows, size / rows}, self) : view(values, {size}, self);
  };
}

// An array [fragments, width] of what `fill` appends for each fragment.
template <typename Fill>
auto of_fragments(int width, Fill fill) {
  return [=](const Character& c) {
    std::vector<double> values;
    for (const Fragment& f : c.pool.fragments) fill(c, f, values);
    const auto count = static_cast<py::ssize_t>(c.pool.fragments.size());
    return width > 1 ? to_array(std::move(values), {count, width}) : to_array(std::move(values), {count});
  };
}

void bind_pool(py::class_<Character, Holder>& character) {
  character
      .def_property_readonly("clip_names",
                             [](const Character& c) {
                               std::vector<std::string> names;
                               for (int i = 0; i < c.takes(); ++i) names.push_back(c.pool.clips[i].name);
                               return names;
                             })
      .def_property_readonly("fragment_clips",
                             [](const Character& c) {
                               std::vector<int> clips;
                               for (const Fragment& f : c.pool.fragments) clips.push_back(f.clip);
                               const auto count = static_cast<py::ssize_t>(clips.size());
                               return to_array(std::move(clips), {count});
                             })
      .def_property_readonly("fragment_ranges",
                             of_fragments(2,
                                          [](const Character& c, const Fragment& f, std::vector<double>& out) {
                                            const double rate = c.pool.clips[f.clip].rate;
                                            out.insert(out.end(), {f.begin / rate, f.end / rate});
                                          }))
      .def_property_readonly("fragment_durations",
                             of_fragments(1, [](const Character& c, const Fragment& f,
                                                std::vector<double>& out) { out.push_back(c.pool.seconds(f)); }))
      .def_property_readonly("fragment_origins",
                             [](const Character& c) {
                               std::vector<std::string> origins;
                               for (const Fragment& f : c.pool.fragments) origins.emplace_back(origin_name(f.origin));
                               return origins;
                             })
      .def_property_readonly("evident",
                             of_fragments(4, [](const Character&, const Fragment& f, std::vector<double>& out) {
                               out.insert(out.end(), {f.evident.x, f.evident.y, f.evident.turn, f.evident.jump});
                             }));
}

void bind_tables(py::class_<Character, Holder>& character) {
  const auto labels = [](const Character& c) -> const std::vector<int>& { return c.classes.labels; };
  const auto medoids = [](const Character& c) -> const std::vector<int>& { return c.classes.representatives; };
  const auto smoothness = [](const Character& c) -> const std::vector<double>& { return c.quality.smoothness; };
  const auto match = [](const Character& c) -> const std::vector<double>& { return c.quality.match; };
  const auto table = [](const Character& c) -> const std::vector<int>& { return c.policy().next; };
  const auto bridges = [](const Character& c) -> const std::vector<int>& { return c.bridges; };
  character.def_property_readonly("labels", viewed<int>(labels, 0))
      .def_property_readonly("representatives", viewed<int>(medoids, 0))
      .def_property_readonly("smoothness", viewed<double>(smoothness, 1))
      .def_property_readonly("match", viewed<double>(match, 1))
      .def_property_readonly("table", viewed<int>(table, 1))
      .def_property_readonly("bridges", viewed<int>(bridges, 1))
      .def_property_readonly("class_names", &class_names)
      .def_property_readonly(
          "coverage_counts",
          [](const Character& c) { return to_array(coverage(c.pool.fragments, c.space).counts, {c.space.size()}); })
      .def_property_readonly("coverage_distances", [](const Character& c) {
        return to_array(coverage(c.pool.fragments, c.space).distances, {c.space.size()});
      });
}

MoveClip new_move(const std::string& name, const Clip& clip, bool upper_body, double wait,
                  const std::array<double, 2>& loop) {
  check_name(name);
  check_move_times(name, (clip.frames - 1) / clip.rate, wait, loop);
  return {name, clip, upper_body, wait, loop};
}

void bind_move(py::module_& m) {
  py::class_<MoveClip>(m, "Move", py::module_local())
      .def(py::init(&new_move), py::arg("name"), py::arg("clip"), py::arg("upper_body") = false, py::arg("wait") = 0.5,
           py::arg("loop") = std::array<double, 2>{})
      .def_readonly("name", &MoveClip::name)
      .def_readonly("clip", &MoveClip::clip)
      .def_readonly("upper_body", &MoveClip::upper_body)
      .def_readonly("wait", &MoveClip::wait)
      .def_property_readonly("loop", [](const MoveClip& move) { return py::make_tuple(move.loop[0], move.loop[1]); });
}

std::vector<std::string> move_names(const Character& c) {
  std::vector<std::string> names;
  for (const Move& move : c.moves) names.push_back(move.name);
  return names;
}

void bind_moves(py::class_<Character, Holder>& character) {
  character.def_property_readonly("move_names", &move_names)
      .def_property_readonly("moves", &moves_of)
      .def(
          "with_moves",
          [](const Character& c, const std::vector<MoveClip>& moves) {
            return std::make_shared<Character>(with_moves(c, moves));
          },
          py::arg("moves"), py::call_guard<GilRelease>());
}

std::vector<std::string> style_names(const Character& c) {
  std::vector<std::string> names;
  for (int i = 0; i < c.style_count() && !c.style.empty(); ++i) names.push_back(c.in_style(i).style);
  return names;
}

// The character itself in its first style.
Holder in_style(const Holder& c, int style) {
  check_style(*c, style);
  return style == 0 ? c : std::const_pointer_cast<Character>(c->styles[style - 1]);
}

Character to_styled(const std::vector<std::pair<std::string, Holder>>& styles) {
  std::vector<StyledCharacter> named;
  for (const auto& [name, character] : styles) {
    check_name(name);
    if (character == nullptr) throw std::invalid_argument("style \"" + name + "\" has no character");
    named.push_back({name, character});
  }
  return with_styles(named);
}

void bind_styles(py::module_& m, py::class_<Character, Holder>& character) {
  character.def_property_readonly("style_names", &style_names).def("in_style", &in_style, py::arg("style"));
  m.def(
      "with_styles",
      [](const std::vector<std::pair<std::string, Holder>>& styles) {
        return std::make_shared<Character>(to_styled(styles));
      },
      py::arg("styles"), py::call_guard<GilRelease>());
}

py::array_t<double> able(const Character& c, const Doubles& trace) {
  return to_rows(able_trace(c.speeds, to_trace(trace)));
}

double percent(const Character& c, const Doubles& trace, const std::string& policy) {
  const Trace controls = to_trace(trace);
  return without_gil(
      [&] { return percent_of_optimal(c.quality, c.policy(policy), snap(c.space, able_trace(c.speeds, controls))); });
}

std::vector<std::string> policies_of(const Character& c) {
  std::vector<std::string> names;
  for (const Policy& policy : c.policies) names.push_back(policy.name);
  return names;
}

void bind_use(py::class_<Character, Holder>& character) {
  character
      .def(
          "save", [](const Character& c, const std::filesystem::path& path) { save_policy(path, c); }, py::arg("path"),
          py::call_guard<GilRelease>())
      .def_static(
          "load", [](const std::filesystem::path& path) { return std::make_shared<Character>(load_policy(path)); },
          py::arg("path"), py::call_guard<GilRelease>())
      .def("to_bytes", [](const Character& c) { return py::bytes(without_gil([&] { return to_bytes(c); })); })
      .def_static(
          "from_bytes",
          [](const py::bytes& data) {
            const std::string bytes(data);
            return without_gil([&] { return std::make_shared<Character>(from_bytes(bytes)); });
          },
          py::arg("data"))
      .def(
          "optimal",
          [](const Character& c, const Doubles& trace) {
            const Trace controls = to_trace(trace);
            OptimalPath path =
                without_gil([&] { return optimal_path(c.quality, snap(c.space, able_trace(c.speeds, controls))); });
            const auto count = static_cast<py::ssize_t>(path.classes.size());
            return py::make_tuple(to_array(std::move(path.classes), {count}), path.quality);
          },
          py::arg("trace"))
      .def("able", &able, py::arg("trace"))
      .def("percent_of_optimal", &percent, py::arg("trace"), py::arg("policy") = "")
      .def(
          "without",
          [](const Character& c, const std::vector<int>& excluded, int style) {
            return std::make_shared<Character>(without_classes(c, excluded, style));
          },
          py::arg("excluded"), py::arg("style") = 0, py::call_guard<GilRelease>());
}

}  // namespace

void bind_character(py::module_& m) {
  bind_move(m);
  py::class_<Character, Holder> character(m, "Character", py::module_local());
  character.def_property_readonly("skeleton", [](const Character& c) { return c.pool.skeleton; })
      .def_property_readonly("space", [](const Character& c) { return c.space; })
      .def_property_readonly("policies", &policies_of)
      .def_property_readonly("policy", [](const Character& c) { return c.policy().name; })
      .def_readonly("report", &Character::report);
  bind_pool(character);
  bind_tables(character);
  bind_use(character);
  bind_moves(character);
  bind_styles(m, character);
}

}  // namespace fragmotion::bindings
