// SPDX-License-Identifier: MIT
#include "fuzzing.hpp"
#include "io/parse_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  read_or_refuse([&] {
    const AsfModel model = parse_asf(text_of(data, size), "fuzz.asf");
    require(model.bones.size() == model.skeleton.names.size(), "a bone of the skeleton for each of the file");
    // A motion of one frame that moves nothing: dofs and axes are used as an AMC file's frames use them.
    std::string motion = "1\n";
    for (const AsfBone& bone : model.bones) {
      if (bone.dofs.empty()) continue;
      motion += bone.name;
      for (std::size_t i = 0; i < bone.dofs.size(); ++i) motion += " 1";
      motion += '\n';
    }
    read_or_refuse([&] { check_take(parse_amc(motion, "fuzz.amc", model, 120), motion.size()); });
  });
  return 0;
}
