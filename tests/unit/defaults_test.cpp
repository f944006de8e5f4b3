// SPDX-License-Identifier: GPL-2.0-or-later
// What a case leaves out has the value that the user guide states.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "coupler/case/case.hpp"

namespace polargrain::coupler {
namespace {

std::string trimmed(std::string text) {
  std::erase(text, '`');
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Default cells of the tables of the user guide with three columns, by key.
std::multimap<std::string, std::string> defaults_of_the_guide() {
  std::ifstream page(POLARGRAIN_SOURCE_DIRECTORY "/docs/user_guide.md");
  std::multimap<std::string, std::string> defaults;
  for (std::string line; std::getline(page, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
    if (!line.starts_with("| `") || cells.size() < 4) continue;
    std::istringstream keys(cells[1]);
    for (std::string key; std::getline(keys, key, ',');) defaults.emplace(trimmed(key), trimmed(cells[2]));
  }
  return defaults;
}

/// Whether "1e-5; 1e-3 with cells" has the value: as a number of some dimension, or as a word.
bool has_value(const std::string& cell, const std::string& value) {
  std::istringstream alternatives(cell);
  for (std::string one; std::getline(alternatives, one, ';');) {
    one = trimmed(one);
    for (const char* const where : {" with ", " in space", " in explicit", ","})
      one = one.substr(0, one.find(where));
    one.erase(0, one.starts_with("in space ") ? 9 : 0);
    if (one == value) return true;
    for (int kind = 0; kind <= static_cast<int>(Dimension::rate); ++kind) {
      const auto dimension = static_cast<Dimension>(kind);
      const auto here = parse_quantity(one, dimension);
      const auto there = parse_quantity(value, dimension);
      if (here && there && std::abs(*here - *there) <= 1e-5 * std::abs(*there)) return true;
    }
  }
  return false;
}

TEST(Defaults, OfTheUserGuideAreThoseOfCases) {
  const auto guide = defaults_of_the_guide();
  const std::set<std::string> in_words = {"moment_tolerance", "element", "GA", "name"};  // of other keys
  std::set<std::string> held;
  const auto setting = [](const char* text) { return std::vector<std::string>{text}; };
  for (const auto& [name, settings] : {std::pair("biaxial", std::vector<std::string>{}),
                                       {"biaxial", setting("materials.sand.model=adaptive")},
                                       {"biaxial", setting("materials.sand.model=informed")},
                                       {"biaxial", setting("steps={method: explicit, count: 3}")},
                                       {"biaxial", setting("steps={method: automatic, count: 3}")},
                                       {"excavation", {}},
                                       {"footing", {}},
                                       {"footing_cells", {}},
                                       {"quay", {}},
                                       {"slope", {}},
                                       {"spheres", {}},
                                       {"toyoura", {}}}) {
    const Case the_case =
        read_case(std::string(POLARGRAIN_SOURCE_DIRECTORY "/cases/") + name + "/case.yaml", settings);
    for (const KeyLeft& left : the_case.left) {
      const auto [first, last] = guide.equal_range(left.key);
      std::string cells;
      bool agrees = false;
      for (auto row = first; row != last; ++row) {
        cells += "\n  " + row->second;
        agrees = agrees || has_value(row->second, left.value);
      }
      if (cells.empty() || in_words.contains(left.key)) continue;
      held.insert(left.key);
      EXPECT_TRUE(agrees) << name << ": " << left.section << ": " << left.key << " is " << left.value
                          << "; docs/user_guide.md says" << cells;
    }
  }
  EXPECT_GE(held.size(), 45u);  // of those that these cases leave out
}

}  // namespace
}  // namespace polargrain::coupler
