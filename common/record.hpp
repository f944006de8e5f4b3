// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "common/state.hpp"

namespace polargrain {

/// The use of a value of a field.
enum class FieldUse {
  result,  ///< part of a result: kept, compared, shown
  cost     ///< of this one computation (seconds): travels once with the answer and is not kept
};

/// The notes on a field, given once, where its record is defined.
struct FieldNotes {
  std::string_view name;     ///< as columns, fields of VTU files and tables of the documentation name it
  std::string_view unit;     ///< "1" for a pure number, "" for values that are not numbers
  std::string_view meaning;  ///< of one line, for tables; also sign and reference where they matter
  /// Endings of the names of the columns of a matrix or a list, separated by spaces: "_11 _22 _12".
  std::string_view components = {};
  FieldUse use = FieldUse::result;
};

/// A record is a plain struct that is described once, beside its definition, by a function template found by
/// argument-dependent lookup:
///
///     template <RecordOf<CellDiagnostics> Record, class Visit>
///     void describe(Record& record, Visit&& visit) {
///       visit(FieldNotes{"void_ratio", "1", "volume of the voids over that of the grains"}, record.void_ratio);
///       ...
///     }
///
/// Messages, archives, columns of tables and fields of VTU files, and the tables of the documentation follow
/// from it (record_values.hpp, record_archive.hpp, record_table.hpp): adding a field is a line there.
///
/// A member may be: double, a whole number, bool, an enumeration with `choices_of`, std::string, a matrix of
/// fixed size, std::array of doubles, StatePointer, another record, or a std::vector of records.
template <class Type, class Record>
concept RecordOf = std::same_as<std::remove_const_t<Type>, Record>;

/// How many values an enumeration has, counted from its least one; each described enumeration has an overload
/// `Choices choices_of(Enumeration)`.
struct Choices {
  std::int64_t least = 0;
  std::int64_t count = 0;
};

namespace record {
struct NoVisit {
  template <class Member>
  void operator()(const FieldNotes&, Member&) const {}
};
template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <std::size_t count>
inline constexpr bool is_array<std::array<double, count>> = true;
}  // namespace record

template <class T>
concept Described = requires(T& value, record::NoVisit visit) {
  describe(value, visit);
};

template <class T>
concept FixedMatrix = std::derived_from<T, Eigen::MatrixBase<T>> && T::SizeAtCompileTime != Eigen::Dynamic;

}  // namespace polargrain
