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

/// The heading of the user guide that tells of a section of a case: "stage 'dig'" belongs to steps.
std::string heading_of(const std::string& section) {
  const std::string word = section.substr(0, section.find_first_of(" :"));
  for (const auto& [name, heading] : {std::pair("material", "materials"),
                                      {"interface", "interfaces, beams, anchors"},
                                      {"beam", "interfaces, beams, anchors"},
                                      {"anchor", "interfaces, beams, anchors"},
                                      {"stage", "steps"},
                                      {"initial_stress", "body and initial_stress"},
                                      {"monitor", "monitors"},
                                      {"case", "The case file"},
                                      {"continuum", "The case file"},
                                      {"profile", "profiles"}})
    if (word == name) return heading;
  return word;
}

/// Default cells of the tables of the user guide with three columns, by heading and key.
std::multimap<std::string, std::string> defaults_of_the_guide() {
  std::ifstream page(POLARGRAIN_SOURCE_DIRECTORY "/docs/user_guide.md");
  std::multimap<std::string, std::string> defaults;
  std::string heading;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) heading = trimmed(line.substr(line.find_first_not_of('#')));
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
    if (!line.starts_with("| `") || cells.size() < 4) continue;
    std::istringstream keys(cells[1]);
    for (std::string key; std::getline(keys, key, ',');)
      defaults.emplace(heading + ": " + trimmed(key), trimmed(cells[2]));
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
  std::set<std::string> held, without_row;
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
      const std::string key = heading_of(left.section) + ": " + left.key;
      const auto [first, last] = guide.equal_range(key);
      std::string cells;
      bool agrees = false;
      for (auto row = first; row != last; ++row) {
        cells += "\n  " + row->second;
        agrees = agrees || has_value(row->second, left.value);
      }
      if (in_words.contains(left.key)) continue;
      if (cells.empty()) {
        without_row.insert(key);
        continue;
      }
      held.insert(key);
      EXPECT_TRUE(agrees) << name << ": " << left.section << ": " << left.key << " is " << left.value
                          << "; docs/user_guide.md says" << cells;
    }
  }
  EXPECT_GE(held.size(), 40u);  // of those that these cases leave out
  // The guide states these in its text.
  EXPECT_EQ(without_row,
            (std::set<std::string>{"The case file: deformation", "body and initial_stress: surcharge",
                                   "interfaces, beams, anchors: cohesion_after_opening",
                                   "materials: confining", "materials: damping in explicit steps"}));
}

// Keys of schemes that are not in use are checked, and no more.
TEST(Defaults, AreThoseOfTheSchemeInUse) {
  const auto schemes_of = [](const char* setting) {
    std::set<std::string> schemes;
    for (const KeyLeft& left :
         read_case(POLARGRAIN_SOURCE_DIRECTORY "/cases/biaxial/case.yaml", {setting}).left)
      if (left.section.starts_with("material ")) schemes.insert(left.section);
    return schemes;
  };
  const std::string sand = "material 'sand'";
  EXPECT_EQ(schemes_of("materials.sand.model=cell"), (std::set<std::string>{sand}));
  EXPECT_EQ(schemes_of("materials.sand.model=adaptive"), (std::set<std::string>{sand, sand + ": adaptive"}));
  EXPECT_EQ(schemes_of("materials.sand.model=informed"), (std::set<std::string>{sand, sand + ": informed"}));
}

}  // namespace
}  // namespace polargrain::coupler
