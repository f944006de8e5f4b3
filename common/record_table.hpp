// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "common/record_values.hpp"

namespace polargrain {

/// One column of a table, or one field of a VTU file.
struct Column {
  std::string name;
  std::string unit;
  std::string meaning;
};

/// The names of the columns of one member: its own, or one for each component.
std::vector<Column> columns_of_member(const FieldNotes& notes, std::size_t components);
std::vector<std::string> joined_names(std::vector<std::string> first, const std::vector<std::string>& then);
/// The table of the documentation: `| name | unit | meaning |`, columns of one meaning in one line.
std::string markdown_table(const std::vector<Column>& columns);

/// The columns of a record: its results that are numbers, whole numbers and truths, in the order of its
/// description; nested records in their place, their names behind the
/// name of their field; costs and texts left out.
template <Described Record>
std::vector<Column> columns_of(const Record& record = {}) {
  std::vector<Column> columns;
  describe(record, [&columns]<class Member>(const FieldNotes& notes, const Member& member) {
    if (notes.use == FieldUse::cost) return;
    std::vector<Column> found;
    if constexpr (FixedMatrix<Member> || record::is_array<Member>) {
      found = columns_of_member(notes, static_cast<std::size_t>(member.size()));
    } else if constexpr (std::is_arithmetic_v<Member> || std::is_enum_v<Member>) {
      found = columns_of_member(notes, 1);
    } else if constexpr (Described<const Member>) {
      found = columns_of(member);
      for (Column& column : found) column.name = std::string(notes.name) + "_" + column.name;
    }
    columns.insert(columns.end(), found.begin(), found.end());
  });
  return columns;
}

/// The names of these columns.
template <Described Record>
std::vector<std::string> names_of_columns() {
  std::vector<std::string> names;
  for (const Column& column : columns_of<Record>()) names.push_back(column.name);
  return names;
}

/// The values of these columns.
template <Described Record>
std::vector<double> values_of(const Record& record) {
  std::vector<double> values;
  describe(record, [&values]<class Member>(const FieldNotes& notes, const Member& member) {
    if (notes.use == FieldUse::cost) return;
    if constexpr (std::is_arithmetic_v<Member> || std::is_enum_v<Member>) {
      values.push_back(static_cast<double>(member));
    } else if constexpr (FixedMatrix<Member> || record::is_array<Member>) {
      RecordValues found;
      append_member(found, member, false);
      values.insert(values.end(), found.numbers.begin(), found.numbers.end());
    } else if constexpr (Described<const Member>) {
      const std::vector<double> found = values_of(member);
      values.insert(values.end(), found.begin(), found.end());
    }
  });
  return values;
}

}  // namespace polargrain
