// SPDX-License-Identifier: MIT
#include "arrays.hpp"

PYBIND11_MODULE(fragmotion_core, m) {
  namespace b = fragmotion::bindings;
  m.doc() = "Fragment-based responsive character motion (Cheng, Liu, Pan and Tang 2009).";
  m.attr("__version__") = FRAGMOTION_VERSION;
  b::bind_errors(m);
  b::bind_skeleton(m);
  b::bind_motion(m);
  b::bind_io(m);
  b::bind_retarget(m);
  b::bind_doctor(m);
  b::bind_control(m);
  b::bind_fragments(m);
  b::bind_classes(m);
  b::bind_policy(m);
  b::bind_character(m);
  b::bind_build(m);
  b::bind_player_options(m);
  b::bind_evaluate(m);
  b::bind_bake(m);
  b::bind_runtime(m);  // whose Player.run returns what evaluate binds
  b::bind_pins(m);
  b::bind_direct(m);
}
