// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/memory_archive.hpp"

#include <fmt/format.h>

#include "common/error.hpp"

namespace polargrain {
namespace {

template <class Value>
void put(std::map<std::string, std::vector<Value>>& arrays, const std::string& name,
         std::span<const Value> values) {
  if (!arrays.emplace(name, std::vector<Value>(values.begin(), values.end())).second) {
    throw RunError(fmt::format("'{}' is written twice to one archive", name));
  }
}

template <class Value>
const std::vector<Value>& take(const std::map<std::string, std::vector<Value>>& arrays,
                               const std::string& name, const char* kind) {
  const auto place = arrays.find(name);
  if (place == arrays.end()) throw RunError(fmt::format("there are no {} called '{}'", kind, name));
  return place->second;
}

}  // namespace

void MemoryArchive::write(const std::string& name, std::span<const double> values) {
  put(doubles_, name, values);
}
void MemoryArchive::write(const std::string& name, std::span<const std::int64_t> values) {
  put(integers_, name, values);
}
void MemoryArchive::write(const std::string& name, std::span<const StatePointer> states) {
  put(states_, name, states);
}

std::vector<double> MemoryArchive::doubles(const std::string& name) {
  return take(doubles_, name, "numbers");
}
std::vector<std::int64_t> MemoryArchive::integers(const std::string& name) {
  return take(integers_, name, "whole numbers");
}
std::vector<StatePointer> MemoryArchive::states(const std::string& name) {
  return take(states_, name, "states");
}

}  // namespace polargrain
