// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/error.hpp"

namespace polargrain {

/// A CSV file: the names of the columns, then rows with a cell for each. Cells may be quoted as RFC 4180 says, but hold
/// no line ends. Spaces around cells do not count, nor do empty lines, those that begin with '#', and a byte order mark of UTF-8.
class CsvTable {
 public:
  /// @param faults gets a fault for each row that has not a cell for each column, and the table is without it; null:
  /// such rows are an error
  /// @throws InputError naming file and line: of the first such row, or because it cannot be read
  explicit CsvTable(const std::filesystem::path& file, std::vector<Fault>* faults = nullptr);

  /// The lines that begin with '#'.
  [[nodiscard]] const std::vector<std::string>& comments() const { return comments_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  /// The line of the file that a row stands in, for messages.
  [[nodiscard]] int line_of(std::size_t row) const { return rows_[row].line; }
  /// The line of the names of the columns.
  [[nodiscard]] int line_of_names() const { return line_of_names_; }
  /// @throws InputError naming the columns of the table when it has no such column, or when it has two: which is meant?
  [[nodiscard]] std::size_t column(const std::string& name) const;
  [[nodiscard]] const std::string& cell(std::size_t row, std::size_t column) const;
  [[nodiscard]] const std::string& cell(std::size_t row, const std::string& name) const {
    return cell(row, column(name));
  }
  /// @throws InputError naming file and line when the cell is no (finite) number
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  /// The same of a table that this program wrote: an undefined value, as of the quotient 0/0, stands as 'nan', and
  /// comes back as NaN. @throws InputError when the cell is something else
  [[nodiscard]] double figure(std::size_t row, std::size_t column) const;
  /// A whole column. @throws InputError as above
  [[nodiscard]] std::vector<double> numbers(const std::string& name) const;
  [[noreturn]] void fail(int line, const std::string& message) const;

 private:
  struct Row {
    int line;
    std::vector<std::string> cells;
  };
  [[nodiscard]] std::optional<double> value(std::size_t row, std::size_t column) const;
  [[nodiscard]] std::vector<std::string> cells_of(const std::string& line, int number) const;

  std::filesystem::path file_;
  std::vector<std::string> comments_;
  std::vector<std::string> names_;
  std::vector<Row> rows_;
  int line_of_names_ = 0;
};

}  // namespace polargrain
