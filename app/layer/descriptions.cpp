// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/descriptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/mean_and_interval.hpp"

namespace polargrain::app {
namespace {

constexpr const char* kUndecided = "undecided";

const Description& least_of(const std::vector<Description>& descriptions) {
  return *std::ranges::min_element(
      descriptions, {}, [](const Description& one) { return mean_and_interval(one.misfits()).first; });
}

/// By how much the misfit is larger than another, packing by packing of cells: mean and half the interval.
std::pair<double, double> excess(const Description& one, const Description& other) {
  std::vector<double> differences;
  for (std::size_t k = 0; k < one.found.size(); ++k)
    differences.push_back(one.found[k].misfit - other.found[k].misfit);
  return mean_and_interval(differences);
}

std::string with_interval(const std::pair<double, double>& value) {
  return std::isfinite(value.second) ? fmt::format("{:.2f} +- {:.2f}", value.first, value.second)
                                     : fmt::format("{:.2f}", value.first);
}

}  // namespace

std::size_t Description::columns() const {
  return first.size() * std::max<std::size_t>(1, second.size());
}

std::vector<double> Description::misfits() const {
  std::vector<double> all;
  for (const FoundLengths& one : found) all.push_back(one.misfit);
  return all;
}

int Description::at_edge() const {
  return static_cast<int>(std::ranges::count_if(found, [](const FoundLengths& one) { return one.at_edge; }));
}

std::vector<Description> descriptions_of(const LayerOptions& options) {
  std::vector<Description> all{{"lc", options.internal_lengths, {}}};
  if (!options.plastic_lengths.empty())
    all.push_back({"lc and lp", options.internal_lengths, options.plastic_lengths});
  if (!options.spreads.empty()) all.push_back({"spread", options.spreads, {}, true});
  return all;
}

std::string preferred(const std::vector<Description>& descriptions) {
  const Description& least = least_of(descriptions);
  const bool is_less = std::ranges::all_of(descriptions, [&least](const Description& one) {
    const auto [mean, half] = excess(one, least);
    return &one == &least || mean > half;
  });
  return is_less ? least.name : kUndecided;
}

std::string comparison_of(const std::vector<Description>& descriptions) {
  const Description& least = least_of(descriptions);
  std::string text =
      "misfit, in standard deviations of a layer (more than the least, packing by packing of cells):\n";
  for (const Description& one : descriptions) {
    text += fmt::format("  {:<10} {:<14}", one.name, with_interval(mean_and_interval(one.misfits())));
    text += &one == &least ? "\n" : fmt::format(" ({})\n", with_interval(excess(one, least)));
  }
  if (descriptions.size() < 2) return text;
  const std::string name = preferred(descriptions);
  return text + (name == kUndecided ? "the layers prefer no description by more than the cells scatter\n"
                                    : fmt::format("the layers prefer this description: {}\n", name));
}

}  // namespace polargrain::app
