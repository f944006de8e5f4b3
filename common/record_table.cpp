// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/record_table.hpp"

#include <fmt/format.h>

#include <sstream>

namespace polargrain {

std::vector<Column> columns_of_member(const FieldNotes& notes, std::size_t components) {
  const std::string name(notes.name);
  const std::string unit(notes.unit);
  const std::string meaning(notes.meaning);
  if (notes.components.empty() && components == 1) return {{name, unit, meaning}};
  std::vector<Column> columns;
  std::istringstream endings{std::string(notes.components)};
  for (std::string ending; endings >> ending;) columns.push_back({name + ending, unit, meaning});
  if (columns.size() != components) {
    throw std::logic_error(
        fmt::format("the description of '{}' names {} components of {}", name, columns.size(), components));
  }
  return columns;
}

std::vector<std::string> joined_names(std::vector<std::string> first, const std::vector<std::string>& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

std::string markdown_table(const std::vector<Column>& columns) {
  std::string table = "| name | unit | meaning |\n|---|---|---|\n";
  for (auto column = columns.begin(); column != columns.end();) {
    std::string names;
    const Column& first = *column;
    for (; column != columns.end() && column->meaning == first.meaning; ++column)
      names += fmt::format("{}`{}`", names.empty() ? "" : ", ", column->name);
    table += fmt::format("| {} | {} | {} |\n", names, first.unit, first.meaning);
  }
  return table;
}

}  // namespace polargrain
