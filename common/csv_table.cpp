// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/csv_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "common/plain_text.hpp"
#include "common/regular_file.hpp"

namespace polargrain {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// Programs of tables begin a file with these bytes, which say that it is UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// "semicolons" or "tabs" where these part the names of columns. Nothing where commas do, or where there is one name.
std::string_view other_separators(std::string_view names) {
  std::string unquoted;
  bool is_quoted = false;
  for (const char letter : names) {
    if (letter == '"') is_quoted = !is_quoted;
    if (!is_quoted) unquoted += letter;
  }
  if (unquoted.find(',') != std::string::npos) return {};
  if (unquoted.find(';') != std::string::npos) return "semicolons";
  return unquoted.find('\t') != std::string::npos ? "tabs" : std::string_view();
}

/// Whether cells are whole numbers, or parts of numbers that a decimal comma has parted.
bool are_figures(const std::vector<std::string>& cells) {
  return std::ranges::all_of(cells, [](const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("0123456789+-eE") == std::string::npos;
  });
}

constexpr const char* kWritePoints = "decimals are written with a point, 0.5 and not 0,5";

/// The remedy for a cell that is no number, in words that follow. A cell of no known kind has an empty one.
std::string remedy_for(const std::string& cell) {
  const bool has_comma =
      std::ranges::count(cell, ',') == 1 && cell.find_first_of("0123456789") != std::string::npos;
  return has_comma ? fmt::format("; {}", kWritePoints) : "";
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file, std::vector<Fault>* faults) : file_(file) {
  if (const std::string reason = why_no_input(file); !reason.empty()) fail(0, reason);
  std::ifstream stream(file);
  std::string line;
  std::vector<Fault> ragged;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    if (trimmed(line).empty()) continue;
    if (line.front() == '#') {
      comments_.push_back(line);
    } else if (names_.empty()) {
      if (const std::string_view others = other_separators(trimmed(line)); !others.empty())
        fail(number,
             fmt::format("columns are parted by commas, and decimals have a point; this file has {}: export "
                         "it with commas",
                         others));
      names_ = cells_of(line, number);
      line_of_names_ = number;
    } else {
      std::vector<std::string> cells = cells_of(line, number);
      if (cells.size() == names_.size()) {
        rows_.push_back({number, std::move(cells)});
      } else {
        ragged.push_back(
            {file_.string(), number,
             plain_text(fmt::format(
                 "a value for each of {} ('{}', line {}) was expected, and {} here{}",
                 names_.size() == 1 ? std::string("one column") : fmt::format("{} columns", names_.size()),
                 fmt::join(names_, ","), line_of_names_,
                 cells.size() == 1 ? std::string("one is") : fmt::format("{} are", cells.size()),
                 cells.size() > names_.size() && are_figures(cells) ? fmt::format("; {}", kWritePoints)
                                                                    : ""))});
      }
    }
  }
  if (faults != nullptr) {
    *faults = std::move(ragged);
  } else if (!ragged.empty()) {
    throw InputError(ragged.front());
  }
  if (names_.empty()) fail(0, "is empty; a line with the names of the columns was expected");
}

std::vector<std::string> CsvTable::cells_of(const std::string& line, int number) const {
  std::vector<std::string> cells;
  for (std::string_view rest = trimmed(line);;) {
    std::string cell;
    rest = trimmed(rest);
    const bool is_quoted = !rest.empty() && rest.front() == '"';
    if (is_quoted) {
      rest.remove_prefix(1);
      for (;; rest.remove_prefix(1)) {
        if (rest.empty()) fail(number, "a quotation mark opens a value and no mark closes it");
        if (rest.front() == '"') {
          rest.remove_prefix(1);
          if (rest.empty() || rest.front() != '"') break;  // two stand for one
        }
        cell += rest.front();
      }
    }
    const std::size_t comma = rest.find(',');
    const std::string_view plain = trimmed(rest.substr(0, comma));
    if (is_quoted && !plain.empty()) fail(number, "a comma was expected behind a quoted value");
    cells.push_back(is_quoted ? cell : std::string(plain));
    if (comma == std::string_view::npos) return cells;
    rest.remove_prefix(comma + 1);
  }
}

std::size_t CsvTable::column(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end())
    fail(line_of_names_, fmt::format("there is no column '{}'; there are {}", name, fmt::join(names_, ", ")));
  if (std::find(found + 1, names_.end(), name) != names_.end())
    fail(line_of_names_, fmt::format("the column '{}' stands there twice; give it once", name));
  return static_cast<std::size_t>(found - names_.begin());
}

const std::string& CsvTable::cell(std::size_t row, std::size_t column) const {
  return rows_.at(row).cells.at(column);
}

std::optional<double> CsvTable::value(std::size_t row, std::size_t column) const {
  const std::string& text = cell(row, column);
  const char* const end = text.data() + text.size();
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [place, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || place != end) return std::nullopt;
  return value;
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const std::optional<double> found = value(row, column);
  if (!found || !std::isfinite(*found))
    fail(line_of(row), fmt::format("'{}' in column '{}' is not a number{}", cell(row, column), names_[column],
                                   remedy_for(cell(row, column))));
  return *found;
}

double CsvTable::figure(std::size_t row, std::size_t column) const {
  const std::optional<double> found = value(row, column);
  if (!found)
    fail(line_of(row), fmt::format("'{}' in column '{}' is not a number", cell(row, column), names_[column]));
  return *found;
}

std::vector<double> CsvTable::numbers(const std::string& name) const {
  const std::size_t place = column(name);
  std::vector<double> values;
  values.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row) values.push_back(number(row, place));
  return values;
}

void CsvTable::fail(int line, const std::string& message) const {
  throw InputError({file_.string(), line, plain_text(message)});
}

}  // namespace polargrain
