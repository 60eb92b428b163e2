// SPDX-License-Identifier: MIT
#include "fuzzing.hpp"
#include "io/parse_text.hpp"

namespace {

/// A root, an arm of two bones, and a tail that no motion tells of.
const char* const kSkeleton =
    ":units\nlength 1\nangle deg\n:root\norder TX TY TZ RX RY RZ\n:bonedata\n"
    "begin\nname upper\ndirection 1 0 0\nlength 10\naxis 0 0 90 XYZ\ndof rx ry rz\nend\n"
    "begin\nname lower\ndirection 0 1 0\nlength 5\naxis 0 30 0 ZYX\ndof rx tx\nend\n"
    "begin\nname tail\ndirection 0 0 -1\nlength 2\naxis 0 0 0 XYZ\nend\n"
    ":hierarchy\nbegin\nroot upper tail\nupper lower\nend\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  static const AsfModel model = parse_asf(kSkeleton, "fuzz.asf");
  read_or_refuse([&] { check_take(parse_amc(text_of(data, size), "fuzz.amc", model, 120), size); });
  return 0;
}
