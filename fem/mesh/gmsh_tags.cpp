// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/gmsh_tags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace polargrain::fem {
namespace {

/// A line of $Elements: number, kind, number of tags, group, entity, further tags, nodes.
struct TaggedElement {
  std::pair<int, long> entity;  ///< dimension and number
  long group = 0;               ///< 0: it is in no group
  std::vector<long> nodes;      ///< in rising order
};

/// Dimension of a kind of element in Gmsh's manual, "MSH file format"; -1 for kinds that are not read.
int dimension_of_kind(long kind) {
  static const std::map<int, std::set<long>> kinds{
      {0, {15}}, {1, {1, 8}}, {2, {2, 3, 9, 10, 16}}, {3, {4, 5, 6, 7, 11, 12, 13, 14, 17, 18, 19}}};
  for (const auto& [dimension, of_dimension] : kinds)
    if (of_dimension.contains(kind)) return dimension;
  return -1;
}

std::optional<TaggedElement> element_of(const std::string& line) {
  std::vector<long> numbers;
  const char* at = line.c_str();
  for (char* end = nullptr;; at = end) {
    const long number = std::strtol(at, &end, 10);
    if (end == at) break;
    numbers.push_back(number);
  }
  constexpr std::size_t kBeforeTags = 3;
  if (numbers.size() < kBeforeTags || numbers[2] < 2) return {};
  const auto tags = static_cast<std::size_t>(numbers[2]);
  if (tags > numbers.size() - kBeforeTags) return {};
  TaggedElement element{
      .entity = {dimension_of_kind(numbers[1]), numbers[4]},
      .group = std::labs(std::max(numbers[3], -LONG_MAX)),  // negative: turned round
      .nodes = {numbers.begin() + static_cast<std::ptrdiff_t>(kBeforeTags + tags), numbers.end()}};
  if (element.entity.first < 0) return {};
  std::ranges::sort(element.nodes);
  return element;
}

/// Calls visit(element) for all elements of a file of version 2 in text.
template <class Visit>
void for_each_tagged(const std::filesystem::path& file, Visit visit) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::string before;
  bool among_elements = false;
  for (; std::getline(in, line); before = line) {
    if (before.starts_with("$MeshFormat")) {
      char* end = nullptr;
      const double version = std::strtod(line.c_str(), &end);
      if (version < 2.0 || version >= 3.0 || std::strtol(end, nullptr, 10) != 0) return;
    }
    if (line.starts_with('$'))
      among_elements = line.starts_with("$Elements");
    else if (among_elements)
      if (const auto element = element_of(line)) visit(*element);
  }
}

}  // namespace

std::optional<Fault> entity_of_several_groups(const std::filesystem::path& file) {
  std::map<std::pair<int, long>, std::set<long>> groups;
  for_each_tagged(file, [&](const TaggedElement& element) { groups[element.entity].insert(element.group); });
  std::erase_if(groups, [](const auto& of_entity) { return of_entity.second.size() < 2; });
  if (groups.empty()) return {};
  // An element in two groups has a line for each.
  std::map<std::pair<int, long>, std::map<std::vector<long>, std::set<long>>> groups_of_elements;
  for_each_tagged(file, [&](const TaggedElement& element) {
    if (groups.contains(element.entity))
      groups_of_elements[element.entity][element.nodes].insert(element.group);
  });
  static constexpr std::array<const char*, 4> kNames{"point", "curve", "surface", "volume"};
  for (const auto& [entity, elements] : groups_of_elements)
    for (const auto& [nodes, of_element] : elements) {
      const std::set<long>& all = groups.at(entity);
      if (of_element.size() == all.size()) continue;
      const auto missing =
          std::ranges::find_if(all, [&of = of_element](long group) { return !of.contains(group); });
      return Fault{
          file.string(), 0,
          fmt::format(
              "of its elements in {0} {1} only some are in physical group {2}, and Gmsh's library gives the group all of them: "
              "give its elements another number of {0} (second tag below $Elements), for instance that of their group",
              kNames.at(static_cast<std::size_t>(entity.first)), entity.second,
              *missing == 0 ? *of_element.begin() : *missing)};
    }
  return {};
}

}  // namespace polargrain::fem
