// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "common/record.hpp"

namespace polargrain {

/// The values of records, sorted by kind, each kind in the order of the descriptions: the content of messages and
/// archives. Matrices row by row; before the members of a list, how many there are (a whole number).
struct RecordValues {
  std::vector<double> numbers;
  std::vector<std::int64_t> integers;  ///< whole numbers, truths, enumerations
  std::vector<std::string> texts;
  std::vector<StatePointer> states;
};

/// Appends the values of a record. @param with_costs also the fields of FieldUse::cost
template <Described Record>
void append(RecordValues& values, const Record& record, bool with_costs);

/// Whether every number of a record is finite.
template <Described Record>
bool is_finite(const Record& record) {
  RecordValues values;
  append(values, record, true);
  return std::ranges::all_of(values.numbers, [](double number) { return std::isfinite(number); });
}

/// Takes records out of values, in the order in which they were appended.
class RecordReader {
 public:
  /// @param values must outlive the reader @param what the values are, for messages
  RecordReader(const RecordValues& values, std::string what, bool with_costs)
      : values_(values), what_(std::move(what)), with_costs_(with_costs) {}

  /// @throws RunError when values are missing, or a field cannot have its value
  template <Described Record>
  Record read();
  /// @throws RunError when values are left
  void end() const;

 private:
  template <Described Record>
  void fill(Record& record);
  template <class Member>
  void take(std::string_view name, Member& member);
  template <class Kind>
  const Kind& next(const std::vector<Kind>& all, std::size_t& place, std::string_view name) {
    if (place == all.size()) throw RunError(what_ + " ends before its field '" + std::string(name) + "'");
    return all[place++];
  }
  std::int64_t next_integer(std::string_view name, std::int64_t least, std::int64_t most);

  const RecordValues& values_;
  std::string what_;
  bool with_costs_;
  std::size_t number_ = 0;
  std::size_t integer_ = 0;
  std::size_t text_ = 0;
  std::size_t state_ = 0;
};

// ---- how each kind of member is appended and taken

template <class Member>
void append_member(RecordValues& values, const Member& member, bool with_costs) {
  if constexpr (std::same_as<Member, double>) {
    values.numbers.push_back(member);
  } else if constexpr (FixedMatrix<Member>) {
    for (Eigen::Index row = 0; row < member.rows(); ++row)
      for (Eigen::Index column = 0; column < member.cols(); ++column)
        values.numbers.push_back(member(row, column));
  } else if constexpr (record::is_array<Member>) {
    values.numbers.insert(values.numbers.end(), member.begin(), member.end());
  } else if constexpr (std::same_as<Member, std::string>) {
    values.texts.push_back(member);
  } else if constexpr (std::same_as<Member, StatePointer>) {
    values.states.push_back(member);
  } else if constexpr (record::is_list<Member>) {
    values.integers.push_back(static_cast<std::int64_t>(member.size()));
    for (const auto& item : member) append(values, item, with_costs);
  } else if constexpr (Described<const Member>) {
    append(values, member, with_costs);
  } else {
    static_assert(std::integral<Member> || std::is_enum_v<Member>,
                  "no kind of member that a record may have");
    values.integers.push_back(static_cast<std::int64_t>(member));
  }
}

template <Described Record>
void append(RecordValues& values, const Record& record, bool with_costs) {
  describe(record, [&](const FieldNotes& notes, const auto& member) {
    if (with_costs || notes.use == FieldUse::result) append_member(values, member, with_costs);
  });
}

template <Described Record>
Record RecordReader::read() {
  Record record;
  fill(record);
  return record;
}

template <Described Record>
void RecordReader::fill(Record& record) {
  describe(record, [this](const FieldNotes& notes, auto& member) {
    if (with_costs_ || notes.use == FieldUse::result) take(notes.name, member);
  });
}

template <class Member>
void RecordReader::take(std::string_view name, Member& member) {
  if constexpr (std::same_as<Member, double>) {
    member = next(values_.numbers, number_, name);
  } else if constexpr (FixedMatrix<Member>) {
    for (Eigen::Index row = 0; row < member.rows(); ++row)
      for (Eigen::Index column = 0; column < member.cols(); ++column)
        member(row, column) = next(values_.numbers, number_, name);
  } else if constexpr (record::is_array<Member>) {
    for (double& value : member) value = next(values_.numbers, number_, name);
  } else if constexpr (std::same_as<Member, std::string>) {
    member = next(values_.texts, text_, name);
  } else if constexpr (std::same_as<Member, StatePointer>) {
    member = next(values_.states, state_, name);
  } else if constexpr (record::is_list<Member>) {
    // Every item has a number at least: a count that is made up reserves no memory for nothing.
    const auto most = static_cast<std::int64_t>(values_.numbers.size() - number_);
    member.resize(static_cast<std::size_t>(next_integer(name, 0, most)));
    for (auto& item : member) fill(item);
  } else if constexpr (Described<Member>) {
    fill(member);
  } else if constexpr (std::is_enum_v<Member>) {
    const Choices choices = choices_of(member);
    member = static_cast<Member>(next_integer(name, choices.least, choices.least + choices.count - 1));
  } else if constexpr (std::same_as<Member, bool>) {
    member = next_integer(name, 0, 1) != 0;
  } else {
    using Limits = std::numeric_limits<Member>;
    member = static_cast<Member>(next_integer(name, Limits::min(), Limits::max()));
  }
}

}  // namespace polargrain
