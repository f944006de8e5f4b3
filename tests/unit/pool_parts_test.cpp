// SPDX-License-Identifier: GPL-2.0-or-later
// Small parts that decide what is believed of others.
#include <gtest/gtest.h>

#include "common/plain_text.hpp"
#include "coupler/pool/attempts.hpp"

namespace polargrain {
namespace {

TEST(PlainText, KeepsWhatIsPlain) {
  const std::string plain = "residual 1e-3 (m\xc2\xb2), \xe2\x82\xac, \xf0\x9f\x98\x80";
  EXPECT_EQ(plain_text(plain), plain);
  EXPECT_EQ(plain_text(""), "");
}

TEST(PlainText, TakesControlOutOfWords) {
  EXPECT_EQ(plain_text("\x1b[31mred\x07\r\n\tend\x7f"), "?[31mred?   end?");
  EXPECT_EQ(plain_text(std::string_view("a\0b", 3)), "a?b");
  EXPECT_EQ(plain_text("\xc2\x9b"
                       "31m"),
            "??31m");  // the one-character form of ESC [
  EXPECT_EQ(plain_text("\xff\xc3(\xe2\x82"), std::string("?") + "?(" + "??");  // no UTF-8, or cut short
}

TEST(PlainText, CutsAndSaysSo) {
  const std::string text = plain_text(std::string(5'000'000, 'x'));
  EXPECT_EQ(text.size(), kLongestWords);
  EXPECT_TRUE(text.ends_with("x ... (cut, 5000000 bytes)")) << text;
  EXPECT_EQ(plain_text(text), text);
  // Never in the middle of a character.
  std::string wide;
  while (wide.size() < 5000) wide += "\xe2\x82\xac";
  EXPECT_EQ(plain_text(wide).find('?'), std::string::npos);
}

using coupler::Attempt;
using coupler::Attempts;
using coupler::Candidate;

Attempts attempts_of(const std::vector<Attempt>& list) {
  Attempts attempts;
  for (const Attempt& attempt : list) attempts.add(attempt);
  return attempts;
}
constexpr Attempt::End kWork = Attempt::End::by_work;
constexpr Attempt::End kRefused = Attempt::End::refused;

TEST(Attempts, OfOneWorkerProveNothingBesideAnother) {
  const Attempts refused_twice = attempts_of({{kRefused, 1, "key"}, {kRefused, 1, "key"}});
  EXPECT_FALSE(refused_twice.are_enough({{1, "key"}, {2, ""}}));
  EXPECT_FALSE(refused_twice.may_try({1, "key"}, {{1, "key"}, {2, ""}}));
  EXPECT_TRUE(refused_twice.may_try({2, ""}, {{1, "key"}, {2, ""}}));
  // Alone it has the last word.
  EXPECT_TRUE(refused_twice.are_enough({{1, "key"}}));
  EXPECT_TRUE(refused_twice.may_try({1, "key"}, {{1, "key"}}));
}

TEST(Attempts, OfAGuestThatComesAgainUnderAnotherNumberProveNothing) {
  const Attempts attempts = attempts_of({{kRefused, 3, "key"}, {kWork, 4, "key"}});
  EXPECT_FALSE(attempts.are_enough({{5, "key"}, {1, ""}}));
  EXPECT_FALSE(attempts.may_try({5, "key"}, {{5, "key"}, {1, ""}}));
  // Where all have one key, its workers are the only witnesses there are.
  EXPECT_TRUE(attempts.are_enough({{5, "key"}}));
}

TEST(Attempts, OfTwoProcessesOfOursAreEnough) {
  EXPECT_FALSE(attempts_of({{kWork, 1, ""}}).are_enough({{2, ""}}));
  EXPECT_TRUE(attempts_of({{kWork, 1, ""}, {kWork, 2, ""}}).are_enough({{3, ""}}));
  EXPECT_TRUE(attempts_of({{kWork, 1, ""}, {kRefused, 4, "key"}}).are_enough({{3, ""}, {5, "other"}}));
}

TEST(Attempts, EndedFromOutsideCountToTen) {
  Attempts attempts;
  for (int k = 1; k < 10; ++k) {
    attempts.add({Attempt::End::from_outside, static_cast<std::uint64_t>(k), ""});
    EXPECT_FALSE(attempts.are_enough({{99, ""}}));
  }
  attempts.add({Attempt::End::from_outside, 10, ""});
  EXPECT_TRUE(attempts.are_enough({{99, ""}}));
}

}  // namespace
}  // namespace polargrain
