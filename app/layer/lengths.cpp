// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/lengths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace polargrain::app {
namespace {

/// The values that columns and layers are compared by.
using Compared = std::array<double, 3>;

Compared compared(const LayerFigures& figures) {
  return {std::log(figures.thickness), figures.halfway, figures.end};
}

/// Layers that happen to be alike say no more than this.
constexpr Compared kLeastDeviation{0.05, 0.01, 0.01};
constexpr int kParts = 100;  // between two candidates

/// Where a try lies between candidates.
struct Place {
  std::size_t lower = 0;
  double share = 0.0;
};

std::vector<Place> places(std::size_t candidates) {
  if (candidates < 2) return {Place{}};
  std::vector<Place> all;
  for (std::size_t lower = 0; lower + 1 < candidates; ++lower)
    for (int part = 0; part < kParts; ++part) all.push_back({lower, static_cast<double>(part) / kParts});
  all.push_back({candidates - 2, 1.0});
  return all;
}

double length_at(const std::vector<double>& candidates, const Place& place) {
  if (candidates.size() < 2) return candidates.front();
  return candidates[place.lower] *
         std::pow(candidates[place.lower + 1] / candidates[place.lower], place.share);
}

bool at_edge(std::size_t candidates, const Place& place) {
  return candidates > 1 &&
         ((place.lower == 0 && place.share == 0.0) || (place.lower + 2 == candidates && place.share == 1.0));
}

Compared interpolated(const Candidates& candidates, const Place& i, const Place& j) {
  const auto at = [&](std::size_t row, std::size_t column) {
    const auto& of_row = candidates.figures[std::min(row, candidates.figures.size() - 1)];
    return compared(of_row[std::min(column, of_row.size() - 1)]);
  };
  const Compared a = at(i.lower, j.lower);
  const Compared b = at(i.lower + 1, j.lower);
  const Compared c = at(i.lower, j.lower + 1);
  const Compared d = at(i.lower + 1, j.lower + 1);
  Compared value{};
  for (std::size_t k = 0; k < value.size(); ++k)
    value[k] = (1.0 - j.share) * ((1.0 - i.share) * a[k] + i.share * b[k]) +
               j.share * ((1.0 - i.share) * c[k] + i.share * d[k]);
  return value;
}

}  // namespace

FoundLengths lengths_like(const std::vector<LayerFigures>& layers, const Candidates& candidates) {
  Compared mean{};
  Compared deviation{};
  const auto count = static_cast<double>(layers.size());
  for (const LayerFigures& layer : layers)
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += compared(layer)[k] / count;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    double squares = 0.0;
    for (const LayerFigures& layer : layers) squares += std::pow(compared(layer)[k] - mean[k], 2);
    deviation[k] = std::max(kLeastDeviation[k], std::sqrt(squares / std::max(1.0, count - 1.0)));
  }
  FoundLengths found;
  found.misfit = std::numeric_limits<double>::infinity();
  for (const Place& i : places(candidates.first.size())) {
    for (const Place& j : places(candidates.second.size())) {
      const Compared value = interpolated(candidates, i, j);
      double squares = 0.0;
      for (std::size_t k = 0; k < mean.size(); ++k)
        squares += std::pow((value[k] - mean[k]) / deviation[k], 2) / static_cast<double>(mean.size());
      const double misfit = std::sqrt(squares);
      if (!(misfit < found.misfit)) continue;
      found.misfit = misfit;
      found.first = length_at(candidates.first, i);
      if (!candidates.second.empty()) found.second = length_at(candidates.second, j);
      found.at_edge = at_edge(candidates.first.size(), i) || at_edge(candidates.second.size(), j);
      found.figures.thickness = std::exp(value[0]);
      found.figures.halfway = value[1];
      found.figures.end = value[2];
    }
  }
  return found;
}

}  // namespace polargrain::app
