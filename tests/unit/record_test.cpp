// SPDX-License-Identifier: GPL-2.0-or-later
// A record is described once: what is added to a description is found again in messages, archives, columns and
// tables.
#include "common/record.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <msgpack.hpp>

#include "common/cell.hpp"
#include "common/increment.hpp"
#include "common/memory_archive.hpp"
#include "common/record_archive.hpp"
#include "common/record_table.hpp"
#include "coupler/protocol/record_message.hpp"

namespace polargrain {
namespace {

enum class Weather { rain = -1, sun = 0 };
constexpr Choices choices_of(Weather) {
  return {-1, 2};
}

struct Inner {
  double temperature = 0.0;
  std::vector<Grain> grains;
};
template <RecordOf<Inner> Record, class Visit>
void describe(Record& inner, Visit&& visit) {
  visit(FieldNotes{"temperature", "K", "of the air"}, inner.temperature);
  visit(FieldNotes{"grains", "", "some grains"}, inner.grains);
}

struct Sample {
  double number = 0.0;
  int whole = 0;
  bool truth = false;
  Weather weather = Weather::sun;
  std::string text;
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  std::array<double, 2> list{};
  StatePointer state;
  Inner inner;
  double seconds = 0.0;
};
template <RecordOf<Sample> Record, class Visit>
void describe(Record& sample, Visit&& visit) {
  visit(FieldNotes{"number", "Pa", "a number"}, sample.number);
  visit(FieldNotes{"whole", "1", "a whole number"}, sample.whole);
  visit(FieldNotes{"truth", "1", "a truth"}, sample.truth);
  visit(FieldNotes{"weather", "1", "a choice"}, sample.weather);
  visit(FieldNotes{"text", "", "a text"}, sample.text);
  visit(FieldNotes{"matrix", "m", "a matrix", "_11 _12 _21 _22"}, sample.matrix);
  visit(FieldNotes{"list", "s", "a list", "_a _b"}, sample.list);
  visit(FieldNotes{"state", "", "a state"}, sample.state);
  visit(FieldNotes{"inner", "", "a record"}, sample.inner);
  visit(FieldNotes{"seconds", "s", "a cost", {}, FieldUse::cost}, sample.seconds);
}

Sample some_sample() {
  Sample sample{-0.0, -7, true, Weather::rain, "wet \n sand", {}, {3.0, 4.0}, {}, {281.5, {}}, 12.0};
  sample.matrix << 1.0, 2.0, 3.0, 4.0;
  sample.state = std::make_shared<const State>(std::vector<std::byte>(5, std::byte{9}));
  sample.inner.grains = {{4, {0.1, 0.2}, 0.3, 0.4, 0.5, 0.6}, {5, {1.1, 1.2}, 1.3, 1.4, 1.5, 1.6}};
  return sample;
}

void expect_same(const Sample& found, const Sample& expected) {
  EXPECT_TRUE(std::signbit(found.number));
  EXPECT_EQ(found.whole, expected.whole);
  EXPECT_EQ(found.truth, expected.truth);
  EXPECT_EQ(found.weather, expected.weather);
  EXPECT_EQ(found.text, expected.text);
  EXPECT_EQ(found.matrix, expected.matrix);
  EXPECT_EQ(found.list, expected.list);
  ASSERT_TRUE(found.state);
  EXPECT_EQ(found.state->name(), expected.state->name());
  EXPECT_EQ(found.inner.temperature, expected.inner.temperature);
  ASSERT_EQ(found.inner.grains.size(), 2u);
  EXPECT_EQ(found.inner.grains[1].id, 5);
  EXPECT_EQ(found.inner.grains[1].position, expected.inner.grains[1].position);
  EXPECT_EQ(found.inner.grains[1].height, 1.6);
}

std::string message_of(const Sample& sample) {
  std::string bytes;
  {
    coupler::ArrayWriter writer(bytes);
    coupler::write_record(writer, sample);
  }
  return bytes;
}

TEST(Record, EveryFieldTravels) {
  const std::string bytes = message_of(some_sample());
  const msgpack::object_handle handle = msgpack::unpack(bytes.data(), bytes.size());
  const auto found = coupler::read_record<Sample>(handle.get(), "a sample");
  expect_same(found, some_sample());
  EXPECT_EQ(found.seconds, 12.0);
}

TEST(Record, EveryResultIsKeptInArchives) {
  MemoryArchive archive;
  const std::vector<Sample> samples{some_sample(), some_sample()};
  write_records(archive, "samples", std::span<const Sample>(samples));
  const std::vector<Sample> found = read_records<Sample>(archive, "samples", 2);
  expect_same(found[0], samples[0]);
  expect_same(found[1], samples[1]);
  EXPECT_EQ(found[1].seconds, 0.0) << "a cost is not kept";
  EXPECT_THROW(read_records<Sample>(archive, "samples", 1), RunError);
  EXPECT_THROW(read_records<Sample>(archive, "samples", 3), RunError);
}

TEST(Record, EveryNumberIsAColumn) {
  const std::vector<std::string> expected{
      "number",    "whole",     "truth",  "weather", "matrix_11",        "matrix_12",
      "matrix_21", "matrix_22", "list_a", "list_b",  "inner_temperature"};
  EXPECT_EQ(names_of_columns<Sample>(), expected);
  const std::vector<double> values = values_of(some_sample());
  EXPECT_EQ(values, (std::vector<double>{-0.0, -7, 1, -1, 1, 2, 3, 4, 3, 4, 281.5}));
}

TEST(Record, ReadsNothingThatItsFieldsCannotBe) {
  const auto refused = [](const auto& spoil) {
    RecordValues values;
    append(values, some_sample(), true);
    spoil(values);
    RecordReader reader(values, "a sample", true);
    EXPECT_THROW(
        {
          (void)reader.read<Sample>();
          reader.end();
        },
        RunError);
  };
  refused([](RecordValues& values) { values.numbers.pop_back(); });
  refused([](RecordValues& values) { values.numbers.push_back(1.0); });
  refused([](RecordValues& values) { values.integers[0] = std::int64_t{1} << 40; });  // no int
  refused([](RecordValues& values) { values.integers[1] = 2; });                      // no truth
  refused([](RecordValues& values) { values.integers[2] = 1; });                      // no such choice
  refused([](RecordValues& values) { values.integers[3] = std::int64_t{1} << 50; });  // no such list
  refused([](RecordValues& values) { values.integers[3] = -1; });
  refused([](RecordValues& values) { values.texts.clear(); });
  refused([](RecordValues& values) { values.states.clear(); });
}

/// The tables of the documentation are the descriptions.
TEST(Record, DocumentationShowsEveryField) {
  std::ifstream file(POLARGRAIN_SOURCE_DIRECTORY "/docs/file_formats.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const std::string& table :
       {markdown_table(columns_of<CellDiagnostics>()), markdown_table(columns_of<Increment<2>>())})
    EXPECT_NE(page.find(table), std::string::npos) << "docs/file_formats.md must hold this table:\n" << table;
  std::string order;
  for (const Column& column : columns_of<CellIncrement>()) order += ' ' + column.name;
  EXPECT_NE(page.find("   " + order + '\n'), std::string::npos)
      << "docs/file_formats.md must hold this line:\n"
      << order;
}

}  // namespace
}  // namespace polargrain
