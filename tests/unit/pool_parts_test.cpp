// SPDX-License-Identifier: GPL-2.0-or-later
// Small parts that decide what is believed of others.
#include <gtest/gtest.h>

#include "common/plain_text.hpp"
#include "coupler/pool/attempts.hpp"
#include "coupler/pool/opinions.hpp"

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

TEST(PlainText, LeavesLinesToTerminalsAndNothingThatSteersThem) {
  const std::string plain = "a line\n\tanother: \xe2\x82\xac, \xc3\xa9\n";
  EXPECT_EQ(without_control_characters(plain), plain);
  EXPECT_EQ(without_control_characters(std::string_view("a\x1b[2J\r\0\x07\x7f", 9)), "a?[2J????");
  // ESC [ in one character, in UTF-8 and as a byte alone; bytes of names in Latin-1 stay.
  EXPECT_EQ(without_control_characters("\xc2\x9b"
                                       "2J \x9b"
                                       "2J \xe9"
                                       "t\xe9"),
            "??2J ?2J \xe9"
            "t\xe9");
  for (int byte = 0; byte < 256; ++byte) {
    const std::string text = without_control_characters("x" + std::string(1, static_cast<char>(byte)) + "y");
    EXPECT_EQ(text.size(), 3U) << byte;
    const bool steers = (byte < 0x20 && byte != '\n' && byte != '\t') || (byte >= 0x7f && byte < 0xa0);
    EXPECT_EQ(text[1] == '?' && byte != '?', steers) << byte;
  }
}

TEST(PlainText, NamesTheFirstControlCharacter) {
  EXPECT_EQ(control_character_in("caf\xc3\xa9 \xe2\x82\xac"), "");
  EXPECT_EQ(control_character_in(std::string_view("a\0b\x1b", 4)), "U+0000");
  EXPECT_EQ(control_character_in("a\x1b"), "U+001B");
  EXPECT_EQ(control_character_in("a\nb"), "U+000A");
  EXPECT_EQ(control_character_in("a\x7f"), "U+007F");
  EXPECT_EQ(control_character_in("a\xc2\x85"), "U+0085");
  EXPECT_EQ(control_character_in("\xc2\xa0"), "");
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

TEST(Attempts, OfGuestsAloneProveNothingBesideAProcessOfOurOwn) {
  const Attempts attempts = attempts_of({{kWork, 3, "key a"}, {kRefused, 4, "key b"}, {kWork, 5, "key c"}});
  EXPECT_FALSE(attempts.are_enough({{6, "key d"}, {1, ""}}));
  EXPECT_FALSE(attempts.may_try({6, "key d"}, {{6, "key d"}, {1, ""}}));
  EXPECT_TRUE(attempts.may_try({1, ""}, {{6, "key d"}, {1, ""}}));
  EXPECT_TRUE(attempts.are_enough({{6, "key d"}}));
  // One of ours that was killed from outside has not tried.
  const Attempts with_a_kill =
      attempts_of({{Attempt::End::from_outside, 1, ""}, {kWork, 3, "key a"}, {kWork, 4, "key b"}});
  EXPECT_FALSE(with_a_kill.are_enough({{2, ""}}));
  EXPECT_TRUE(with_a_kill.may_try({2, ""}, {{6, "key d"}, {2, ""}}));
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

using coupler::Opinion;
using coupler::Opinions;

const Candidate kWorker1{1, "", "worker 1"};
const Candidate kWorker2{2, "", "worker 2"};
const Candidate kGuestA{3, "key a", "guest 1"};
const Candidate kGuestB{4, "key b", "guest 2"};

Opinion opinion_of(const Candidate& who, double stress) {
  CellReply reply;
  reply.response.stress(0, 0) = stress;
  return {who, who.name, who.party.empty() ? who.name : who.party, reply, coupler::name_of_answer(reply)};
}

TEST(Opinions, TwoWithTheSameBitsAreAnAnswer) {
  Opinions opinions;
  opinions.add(opinion_of(kWorker1, 0.0));
  EXPECT_FALSE(opinions.agreed());
  opinions.add(opinion_of(kWorker2, -0.0));  // equal, but not in bits
  EXPECT_FALSE(opinions.agreed());
  opinions.add(opinion_of(kGuestA, -0.0));
  EXPECT_EQ(opinions.agreed(), 1u);
}

TEST(Opinions, GuestsAloneDoNotOutvoteOneOfOurOwn) {
  Opinions opinions;
  opinions.add(opinion_of(kGuestA, 2.0));
  opinions.add(opinion_of(kWorker1, 1.0));
  opinions.add(opinion_of(kGuestB, 2.0));
  EXPECT_FALSE(opinions.agreed());
  opinions.add(opinion_of(kWorker2, 1.0));
  EXPECT_EQ(opinions.agreed(), 1u);
  Opinions guests;
  guests.add(opinion_of(kGuestA, 2.0));
  guests.add(opinion_of(kGuestB, 2.0));
  EXPECT_EQ(guests.agreed(), 0u);
}

TEST(Opinions, AreAskedOfWhoDiffersMost) {
  const std::vector<Candidate> all{kWorker1, kWorker2, kGuestA, kGuestB};
  Opinions opinions;
  opinions.add(opinion_of(kGuestA, 2.0));
  const std::vector<Candidate> others = opinions.others(all);
  EXPECT_EQ(others.size(), 3u);
  EXPECT_TRUE(opinions.may_answer(kWorker1, others));
  EXPECT_FALSE(opinions.may_answer(kGuestB, others));  // one of ours is there
  EXPECT_FALSE(opinions.may_answer(kGuestA, others));
  EXPECT_TRUE(opinions.may_answer(kGuestB, opinions.others({kGuestA, kGuestB})));
  // A process that took the place of one that has answered is no other witness.
  Opinions ours;
  ours.add(opinion_of(kWorker1, 1.0));
  EXPECT_TRUE(ours.others({{9, "", "worker 1"}}).empty());
  // Where two differ one of our own decides.
  ours.add(opinion_of(kGuestA, 2.0));
  EXPECT_TRUE(ours.may_answer(kWorker2, ours.others(all)));
  EXPECT_FALSE(ours.may_answer(kGuestB, ours.others(all)));
  ours.remove("key a");
  EXPECT_EQ(ours.list().size(), 1u);
}

}  // namespace
}  // namespace polargrain
