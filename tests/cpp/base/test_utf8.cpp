// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "base/random.hpp"
#include "base/utf8.hpp"

namespace fragmotion {
namespace {

TEST(Utf8, KnowsWhatItIs) {
  for (const char* text : {"", "hips", "\xC3\xBC", "\xE8\x85\xB0", "\xF0\x9F\x98\x80", "a\xED\x9F\xBF\xEE\x80\x80z",
                           "\xF4\x8F\xBF\xBF", "\xC2\x80"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
    EXPECT_EQ(as_utf8(text), text);
  }
  EXPECT_TRUE(is_utf8(std::string(1, '\0')));
}

TEST(Utf8, KnowsWhatItIsNot) {
  const char* const wrong[] = {"\x80",              // nothing goes on
                               "\xC3",              // it ends in the middle
                               "\xE8\x85",          //
                               "\xF0\x9F\x98",      //
                               "\xC3(",             // nothing goes on
                               "\xC0\xAF",          // too long for what it is
                               "\xE0\x80\xAF",      //
                               "\xF0\x80\x80\xAF",  //
                               "\xED\xA0\x80",      // a surrogate
                               "\xF4\x90\x80\x80",  // beyond U+10FFFF
                               "\xFF"};
  for (const char* text : wrong) {
    EXPECT_FALSE(is_utf8(text)) << text;
    EXPECT_FALSE(is_utf8(std::string("hips") + text + "spine")) << text;
  }
}

TEST(Utf8, TakesWhatItIsNotForLatin1) {
  EXPECT_EQ(as_utf8("R\xFC"
                    "cken"),
            "R\xC3\xBC"
            "cken");
  EXPECT_EQ(as_utf8("\x80\xFF"), "\xC2\x80\xC3\xBF");
}

TEST(Utf8, IsMadeOfAnyBytesAndKeepsThemApart) {
  Random random(1);
  std::set<std::string> given, made;
  for (int i = 0; i < 20000; ++i) {
    std::string text = "\xFF";  // no UTF-8, so that Latin-1 it is
    for (int length = random.below(6); length > 0; --length) text += static_cast<char>(random.below(256));
    const std::string now = as_utf8(text);
    EXPECT_TRUE(is_utf8(now));
    EXPECT_EQ(as_utf8(now), now);
    given.insert(text);
    made.insert(now);
  }
  EXPECT_EQ(made.size(), given.size());
}

}  // namespace
}  // namespace fragmotion
