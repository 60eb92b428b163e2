// SPDX-License-Identifier: MIT
#include "peers/ozz.hpp"

namespace fragmotion::benchmarks {

void register_ozz_frame(const std::string&, const std::shared_ptr<const Character>&) {}

}  // namespace fragmotion::benchmarks
