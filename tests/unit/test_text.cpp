// SPDX-License-Identifier: BSD-3-Clause
// Texts prepared for terminals and readers.
#include "input/text.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_text {
namespace {

TEST(Printable, KeepsWhatIsWritten) {
  for (const char* text :
       {"", "plain 'text'\n\tof lines", "\u00b5m, \u00c5, \u2207\u00b7u, 18 \u00b0", "\u6db2\u6ef4",
        "\U0001f4a7"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, LeavesNothingThatCommandsATerminal) {
  EXPECT_EQ(printable("a\x1b[2Jb\x7f\r"), "a?[2Jb??");
  EXPECT_EQ(printable("\u0080\u009b\u009f\u00a0"), "???\u00a0");
  for (const char* turned : {"\u061c", "\u200b", "\u200e", "\u200f", "\u2028", "\u202a", "\u202e",
                             "\u2066", "\u2069", "\ufeff", "\U000e0041"})
    EXPECT_EQ(printable(std::string("a") + turned + "b"), "a?b");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a?b");
}

TEST(Printable, ReplacesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("a\x9b\x62"), "a?b");          // of eight bits, a control character
  EXPECT_EQ(printable("\xc0\x9b"), "??");            // overlong
  EXPECT_EQ(printable("\xe0\x80\x9b"), "???");       // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // half of a pair of UTF-16
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // beyond Unicode
  EXPECT_EQ(printable("a\xe2\x82"), "a??");          // cut off
}

TEST(Readable, ShortensLongQuotations) {
  const std::string formula(1'000'000, 'x');
  const std::string message = readable("s.toml:1:1: mu: neither ('" + formula + "' ends) nor '" +
                                       formula + "y'; allowed is 'a'");
  EXPECT_LT(message.size(), 1000U);
  EXPECT_EQ(message.find("s.toml:1:1: mu: neither ('xxx"), 0U);
  EXPECT_NE(message.find("xxx' ends) nor 'xxx"), std::string::npos);
  EXPECT_NE(message.find("(1000001 characters)"), std::string::npos);
  EXPECT_NE(message.find("xy'; allowed is 'a'"), std::string::npos);
  const std::string short_one = "body 'drop' isn't 'there'; it's 'a'\nnor is 'b";
  EXPECT_EQ(readable(short_one), short_one);
  const std::string list =
      "'a' is unknown; allowed are " + std::string(500, 'l') + "; did you mean 'b'?";
  EXPECT_EQ(readable(list), list);
  EXPECT_LT(readable(std::string(1'000'000, 'q')).size(), 9000U);
  std::string accents;
  for (int i = 0; i < 1000; ++i) accents += "\u00e9";
  const std::string cut = readable("'" + accents + "'");
  EXPECT_EQ(cut.find('?'), std::string::npos);
  EXPECT_EQ(printable(cut), cut);  // no character was cut in two
}

}  // namespace
}  // namespace meniscus::test_text
