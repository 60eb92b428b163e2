// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <stdexcept>

#include "base/decode_text.hpp"
#include "base/random.hpp"
#include "base/utf8.hpp"

namespace fragmotion {
namespace {

using namespace std::string_literals;

TEST(DecodeText, ReadsUtf16OfAnyLetter) {
  EXPECT_EQ(decode_text("\xFE\xFF\0a\0\xFC\x8A\xB0\xD8\x3D\xDE\x00"s, "f"), "a\xC3\xBC\xE8\xAA\xB0\xF0\x9F\x98\x80"s);
  EXPECT_EQ(decode_text("\xFF\xFE"s + "a\0\xFC\0"s, "f"), "a\xC3\xBC");
  EXPECT_EQ(decode_text("\xFE\xFF\xD8\x3D\0a"s, "f"), "\xEF\xBF\xBD"s + "a") << "half a pair";
}

TEST(DecodeText, LeavesOtherTextsAndDropsTheirMark) {
  EXPECT_EQ(decode_text("\xEF\xBB\xBFhips", "f"), "hips");
  EXPECT_EQ(decode_text("\xFCrs", "f"), "\xC3\xBCrs");
  EXPECT_EQ(decode_text("", "f"), "");
  EXPECT_EQ(decode_text("h", "f"), "h");
}

TEST(DecodeText, IsUtf8OfAnyBytes) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = i % 2 == 0 ? "\xFF\xFE"s : "\0a"s;
    for (int length = random.below(9); length > 0; --length) bytes += static_cast<char>(random.below(256));
    EXPECT_TRUE(is_utf8(decode_text(bytes, "f")));
  }
}

TEST(DecodeText, NamesArchives) {
  for (const auto& [start, kind] : {std::pair{"PK\x03\x04", "ZIP"}, {"Rar!", "RAR"}, {"7z\xBC\xAF", "7z"}}) {
    try {
      decode_text(std::string(start) + "rest", "walk.bvh");
      ADD_FAILURE() << kind;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "walk.bvh: no text but a "s + kind + " archive: unpack it, and take what is inside");
    }
  }
}

}  // namespace
}  // namespace fragmotion
