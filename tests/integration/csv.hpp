// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/integration/command.hpp"

namespace polargrain::testing {

/// A CSV file without quoted cells, its first line the names of the columns.
class Csv {
 public:
  explicit Csv(const std::filesystem::path& file) : file_(file.string()) {
    std::istringstream lines(content(file));
    std::string line;
    std::getline(lines, line);
    names_ = cells(line);
    while (std::getline(lines, line)) rows_.push_back(cells(line));
  }

  /// @throws std::runtime_error when there is no such column
  [[nodiscard]] std::vector<double> numbers(const std::string& name) const {
    std::vector<double> values;
    for (std::size_t row = 0; row < rows_.size(); ++row) values.push_back(std::stod(cell(row, name)));
    return values;
  }
  [[nodiscard]] const std::string& cell(std::size_t row, const std::string& name) const {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at == names_.end()) throw std::runtime_error(file_ + " has no column " + name);
    return rows_.at(row).at(static_cast<std::size_t>(at - names_.begin()));
  }
  /// The cells of a row by column. @throws std::runtime_error when they are not as many as the columns
  [[nodiscard]] std::map<std::string, std::string> row(std::size_t row) const {
    const std::vector<std::string>& cells = rows_.at(row);
    if (cells.size() != names_.size())
      throw std::runtime_error(file_ + ": row " + std::to_string(row + 1) + " has not a cell a column");
    std::map<std::string, std::string> found;
    for (std::size_t k = 0; k < names_.size(); ++k) found[names_[k]] = cells[k];
    return found;
  }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }

 private:
  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::istringstream text(line);
    for (std::string word; std::getline(text, word, ',');) found.push_back(word);
    return found;
  }
  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace polargrain::testing
