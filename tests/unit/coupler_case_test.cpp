// SPDX-License-Identifier: GPL-2.0-or-later
// The small parts a case is read with.
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "coupler/case/expression.hpp"
#include "coupler/case/quantity.hpp"
#include "coupler/case/section.hpp"
#include "coupler/pool/state_book.hpp"
#include "coupler/pool/state_cache.hpp"
#include "coupler/pool/task_queue.hpp"

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

TEST(Nearest, KnowsOtherNamesOfTheSameThing) {
  const std::vector<std::string> known{"E", "nu", "friction_angle", "dilatancy_angle"};
  EXPECT_EQ(nearest("dilation_angle", known),
            "dilatancy_angle");  // by its letters it is as near to friction_angle
  EXPECT_EQ(nearest("Poisson_ratio", known), "nu");
  EXPECT_EQ(nearest("e", known), "E");
  EXPECT_EQ(nearest("dilation_angle", {"count", "cut"}), "");  // what is not asked for is not proposed
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
  EXPECT_EQ(value_of("18 kN/m3 * 2 m"), 36e3);
  EXPECT_EQ(value_of("a / 4 kN/m"), 8.0 / 4e3);
  EXPECT_EQ(value_of("4 kN / b"), 2e3);  // b is no unit
  EXPECT_EQ(value_of("4 mm/b"), 2e-3);
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
  EXPECT_EQ(error_of("a b"), "expected an operator, one of + - * /, at character 3 of 'a b'");
  EXPECT_EQ(
      error_of("3 apples"),
      "'apples' is no unit (%, m, mm, cm, um, km, Pa, kPa, MPa, GPa, rad, deg, mrad, N, kN, Nm, kNm, N/m, kN/m, "
      "MN/m, N/m3, kN/m3, MN/m3, kg/m3, t/m3, Pa/m, kPa/m, MPa/m, GPa/m, s, min, h, d, a) at character 3 of '3 apples'");
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

TEST(StateCache, HoldsUpToHalfOfItsBytes) {
  StateCache cache(400);
  const StatePointer a = state_of(100, 1);
  const StatePointer b = state_of(100, 2);
  EXPECT_TRUE(cache.hold(a));
  EXPECT_TRUE(cache.hold(b));
  EXPECT_TRUE(cache.hold(b));
  EXPECT_FALSE(cache.hold(state_of(1, 3)));
  for (int fill = 4; fill < 10; ++fill) cache.keep(state_of(100, fill));
  EXPECT_EQ(cache.bytes(), 400u);
  EXPECT_EQ(cache.find(a->name()), a);
  cache.let_go(a->name());
  EXPECT_EQ(cache.find(a->name()), a);
  for (int fill = 4; fill < 10; ++fill) cache.keep(state_of(100, fill));
  EXPECT_EQ(cache.find(a->name()), nullptr);
  EXPECT_EQ(cache.find(b->name()), b);
  cache.forget(b->name());
  EXPECT_TRUE(cache.hold(state_of(200, 3)));
}

StatePointer elsewhere(const StatePointer& state) {
  return std::make_shared<const State>(state->name(), state->size());
}

TEST(StateBook, TellsAWorkerWhatNobodyPointsToAnyMore) {
  StateBook book;
  const StatePointer start = state_of(10, 1);
  StatePointer trial = book.enter(elsewhere(state_of(10, 2)), 7, {0, {start, {}}});
  EXPECT_EQ(book.home(trial->name()), 7u);
  ASSERT_NE(book.origin(trial->name()), nullptr);
  EXPECT_EQ(book.origin(trial->name())->request.state, start);
  const ContentName name = trial->name();
  EXPECT_TRUE(book.take_released(7).empty());
  trial = nullptr;
  EXPECT_EQ(book.take_released(7), std::vector{name});
  EXPECT_TRUE(book.take_released(7).empty());
  EXPECT_EQ(book.origin(name), nullptr);
  EXPECT_EQ(book.home(name), 0u);
}

TEST(StateBook, WhatHasArrivedNeedsNoOrigin) {
  StateBook book;
  const StatePointer full = state_of(10, 2);
  StatePointer start = book.enter(state_of(10, 1), 7, {});
  const ContentName start_name = start->name();
  StatePointer trial = book.enter(elsewhere(full), 7, {0, {start, {}}});
  start = nullptr;
  EXPECT_NE(book.find_here(start_name), nullptr);  // the trial could not be made again without it
  EXPECT_EQ(book.find_here(full->name()), nullptr);
  const StatePointer here = book.arrived(full, 7);
  EXPECT_EQ(book.find_here(full->name()), here);
  EXPECT_EQ(book.origin(full->name()), nullptr);
  EXPECT_EQ(book.find_here(start_name), nullptr);
  trial = nullptr;  // the pointer of old does not take the entry with it
  EXPECT_EQ(book.find_here(full->name()), here);
  EXPECT_EQ(book.take_released(7), std::vector{start_name});
}

TEST(StateBook, BytesStayWhileSomebodyHoldsTheStateWithoutThem) {
  StateBook book;
  const StatePointer full = state_of(10, 2);
  StatePointer trial = book.enter(elsewhere(full), 7, {});
  StatePointer here = book.arrived(full, 7);
  here = nullptr;
  EXPECT_NE(book.find_here(full->name()), nullptr);
  trial = nullptr;
  EXPECT_EQ(book.find_here(full->name()), nullptr);
  EXPECT_EQ(book.take_released(7), std::vector{full->name()});
}

TEST(StateBook, OneKeeperIsEnough) {
  StateBook book;
  const StatePointer full = state_of(10, 2);
  const StatePointer first = book.enter(elsewhere(full), 7, {});
  EXPECT_EQ(book.enter(elsewhere(full), 8, {}), first);
  EXPECT_EQ(book.take_released(7), std::vector{full->name()});
  EXPECT_EQ(book.home(full->name()), 8u);
  const StatePointer here = book.arrived(full, 9);
  EXPECT_EQ(book.take_released(8), std::vector{full->name()});
  EXPECT_EQ(book.enter(elsewhere(full), 7, {}), here);
  EXPECT_EQ(book.take_released(7), std::vector{full->name()});
}

using Numbers = std::vector<std::size_t>;
const auto kAnything = [](const Task&) { return true; };

TEST(TaskQueue, AWorkerTakesItsOwnFirstAndNeverNothing) {
  std::vector<Task> tasks(8);
  TaskQueue queue;
  queue.begin(tasks);
  for (const std::size_t task : {0, 1, 2}) queue.add_for(7, task);
  for (const std::size_t task : {3, 4}) queue.add_for(8, task);
  queue.add(5);
  const auto two = [](const Task&) { return std::size_t{2}; };
  EXPECT_EQ(queue.take(8, kAnything, two), (Numbers{3, 4}));
  EXPECT_EQ(queue.take(8, kAnything, two), Numbers{5});
  EXPECT_EQ(queue.take(8, kAnything, two), (Numbers{2, 1}));  // what its owner would come to last
  EXPECT_EQ(queue.take(7, kAnything, two), Numbers{0});
  EXPECT_EQ(queue.take(7, kAnything, two), Numbers{});
  EXPECT_EQ(queue.size(), 0u);
}

TEST(TaskQueue, AWorkerIsGivenOnlyWhatItMayHave) {
  std::vector<Task> tasks(2);
  tasks[0].definition = 1;
  TaskQueue queue;
  queue.begin(tasks);
  for (const std::size_t task : {0, 1}) queue.add(task);
  const auto one = [](const Task&) { return std::size_t{1}; };
  const auto not_the_first = [](const Task& task) { return task.definition != 1; };
  EXPECT_EQ(queue.take(7, not_the_first, one), Numbers{1});
  EXPECT_EQ(queue.take(7, not_the_first, one), Numbers{});
  EXPECT_EQ(queue.take(8, kAnything, one), Numbers{0});
}

TEST(TaskQueue, OnlyTheKeeperOfAStateIsAskedForIt) {
  std::vector<Task> tasks(2);
  for (Task& task : tasks) task.kind = Task::Kind::fetch;
  TaskQueue queue;
  queue.begin(tasks);
  for (const std::size_t task : {0, 1}) queue.add_for(7, task);
  const auto ten = [](const Task&) { return std::size_t{10}; };
  EXPECT_EQ(queue.take(8, kAnything, ten), Numbers{});
  EXPECT_EQ(queue.take_all_of(7), (Numbers{0, 1}));
  EXPECT_EQ(queue.size(), 0u);
}

TEST(TaskQueue, WhatDoesNotGoTogetherGoesApart) {
  std::vector<Task> tasks(4);
  tasks[1].definition = tasks[2].definition = 1;
  tasks[2].alone = true;
  TaskQueue queue;
  queue.begin(tasks);
  for (std::size_t task = 0; task < tasks.size(); ++task) queue.add(task);
  const auto ten = [](const Task&) { return std::size_t{10}; };
  for (std::size_t task = 0; task < tasks.size(); ++task)
    EXPECT_EQ(queue.take(7, kAnything, ten), Numbers{task});
}

}  // namespace
}  // namespace polargrain::coupler
