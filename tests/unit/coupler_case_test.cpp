// SPDX-License-Identifier: GPL-2.0-or-later
// The small parts a case is read with.
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "coupler/case/expression.hpp"
#include "coupler/case/quantity.hpp"
#include "coupler/case/section.hpp"
#include "coupler/pool/state_cache.hpp"

namespace polargrain::coupler {
namespace {

TEST(Quantity, ReadsNumbersAndUnits) {
  EXPECT_EQ(parse_quantity("5e-4", Dimension::number), 5e-4);
  EXPECT_EQ(parse_quantity(" +3 ", Dimension::number), 3.0);
  EXPECT_EQ(parse_quantity("5 %", Dimension::number), 5 * 1e-2);
  EXPECT_EQ(parse_quantity("100 kPa", Dimension::pressure), 100e3);
  EXPECT_EQ(parse_quantity("1mm", Dimension::length), 1e-3);
  EXPECT_EQ(parse_quantity("-2.5 GPa", Dimension::pressure), -2.5e9);
  EXPECT_EQ(parse_quantity("180 deg", Dimension::angle), 180 * (std::numbers::pi / 180.0));
  for (const char* wrong : {"", "kPa", "1 mm", "1 kpa", "0x10", "1,5", "nan", "inf", "1e999", "1 2", "--1"}) {
    EXPECT_FALSE(parse_quantity(wrong, Dimension::pressure)) << wrong;
  }
}

TEST(Nearest, FindsSlipsAndNothingElse) {
  const std::vector<std::string> known{"count", "cut", "iterations", "tolerance"};
  EXPECT_EQ(nearest("cuont", known), "count");
  EXPECT_EQ(nearest("tolerence", known), "tolerance");
  EXPECT_EQ(nearest("iteration", known), "iterations");
  EXPECT_EQ(nearest("colour", known), "");
}

double value_of(const std::string& text) {
  return Expression(text).evaluate([](const std::string& name) { return name == "a" ? 8.0 : 2.0; });
}

TEST(Expression, FollowsTheRulesOfArithmetic) {
  EXPECT_EQ(value_of("1 + 2 * 3"), 7.0);
  EXPECT_EQ(value_of("(1 + 2) * 3"), 9.0);
  EXPECT_EQ(value_of("8 / 4 / 2"), 1.0);
  EXPECT_EQ(value_of("8 - 4 - 2"), 2.0);
  EXPECT_EQ(value_of("-a / (b * 2)"), -2.0);
  EXPECT_EQ(value_of("--1"), 1.0);
  EXPECT_EQ(value_of("2 mm * 100 kPa"), 2e-3 * 100e3);
  EXPECT_EQ(value_of("50 % * a"), 4.0);
  EXPECT_EQ(Expression("a + b / a").names(), (std::vector<std::string>{"a", "b"}));
}

TEST(Expression, SaysWhatIsWrong) {
  const auto error_of = [](const std::string& text) -> std::string {
    try {
      Expression expression(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(error_of("1 +"), "expected a number, a name or '(' at character 4 of '1 +'");
  EXPECT_EQ(error_of("a b"), "expected an operator at character 3 of 'a b'");
  EXPECT_EQ(error_of("3 apples"), "'apples' is no unit at character 3 of '3 apples'");
  EXPECT_EQ(error_of("(a"), "expected ')' at character 3 of '(a'");
  EXPECT_NE(error_of(std::string(100000, '(')).find("nested too deeply"), std::string::npos);
}

StatePointer state_of(std::size_t bytes, int fill) {
  return std::make_shared<const State>(std::vector<std::byte>(bytes, static_cast<std::byte>(fill)));
}

TEST(StateCache, ForgetsWhatWasUsedLongestAgo) {
  StateCache cache(300);
  const StatePointer a = state_of(100, 1);
  const StatePointer b = state_of(100, 2);
  const StatePointer c = state_of(100, 3);
  const StatePointer d = state_of(100, 4);
  for (const StatePointer& state : {a, b, c}) cache.keep(state);
  EXPECT_EQ(cache.find(a->name()), a);
  cache.keep(d);
  EXPECT_EQ(cache.find(b->name()), nullptr);
  EXPECT_EQ(cache.find(a->name()), a);
  EXPECT_EQ(cache.bytes(), 300u);
  cache.keep(state_of(301, 5));
  EXPECT_EQ(cache.count(), 3u);
  cache.forget(a->name());
  EXPECT_FALSE(cache.use(a->name()));
  EXPECT_EQ(cache.bytes(), 200u);
}

}  // namespace
}  // namespace polargrain::coupler
