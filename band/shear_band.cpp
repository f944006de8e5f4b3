// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/shear_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "band/layer_in_samples.hpp"
#include "band/least_squares.hpp"
#include "common/elementary_functions.hpp"

namespace polargrain::band {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
Eigen::Vector2d along(double inclination) {
  return {cosine(inclination), sine(inclination)};
}
Eigen::Vector2d across(double inclination) {
  return {-sine(inclination), cosine(inclination)};
}

SampleColumns<2> columns_of(const Samples& samples) {
  SampleColumns<2> columns;
  for (const Sample& sample : samples) {
    columns.positions.push_back(sample.position);
    columns.sizes.push_back(sample.area);
    columns.shears.push_back(sample.shear);
  }
  return columns;
}

/// Band of one inclination, from its profile.
BandSearch measure(const SampleColumns<2>& columns, double inclination) {
  const LayerSearch<2> search = measure_layer<2>(columns, across(inclination));
  if (!search.layer) return {std::nullopt, search.reason};
  const Layer<2>& layer = *search.layer;
  return {Band{layer.centre, inclination, layer.thickness, layer.peak, layer.background, layer.resolution},
          ""};
}

double starting_inclination(const SampleColumns<2>& columns) {
  double best = 0.0;
  double greatest = -std::numeric_limits<double>::infinity();
  for (int degree = -89; degree <= 90; ++degree) {
    const double inclination = degree * kDegree;
    const double prominence = prominence_of(profile_of(columns.distances_along(across(inclination)),
                                                       columns.sizes, columns.shears, columns.scales));
    if (prominence > greatest) {
      greatest = prominence;
      best = inclination;
    }
  }
  return best;
}

std::vector<double> distances_from(const Samples& samples, const Band& band) {
  std::vector<double> distances;
  distances.reserve(samples.size());
  for (const Sample& sample : samples) distances.push_back(band.distance(sample.position));
  return distances;
}

/// Line of the Gaussian band A exp(-s^2 / (2 w^2)) + B whose sum of squared differences from the shear,
/// weighted with the area, is least: Levenberg and Marquardt's method, the band measured so far as the start.
/// @returns nothing when it does not settle
std::optional<double> inclination_by_least_squares(const Samples& samples, const Band& start) {
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  const double length = start.thickness;  // unit of the lengths, so that all unknowns are of order one
  const double area = std::accumulate(samples.begin(), samples.end(), 0.0,
                                      [](double sum, const Sample& sample) { return sum + sample.area; });
  // Unknowns: turn of the line, its shift, w, A, B.
  const Vector5 unknowns(0.0, 0.0, 1.0 / kHalfMaximumWidth, start.peak - start.background, start.background);
  const auto visit = [&](const Vector5& u, bool gives_derivatives, auto&& each) {
    const Eigen::Vector2d direction = along(start.inclination + u(0));
    const Eigen::Vector2d normal = across(start.inclination + u(0));
    for (const Sample& sample : samples) {
      const Eigen::Vector2d apart = (sample.position - start.centre) / length;
      const double s = normal.dot(apart) - u(1);
      const double bell = exponential(-0.5 * s * s / (u(2) * u(2)));
      const double difference = u(3) * bell + u(4) - sample.shear;
      const double by_distance = gives_derivatives ? -u(3) * bell * s / (u(2) * u(2)) : 0.0;
      each(sample.area / area, difference,
           Vector5(-by_distance * direction.dot(apart), -by_distance, -by_distance * s / u(2), bell, 1.0));
    }
  };
  const std::optional<Vector5> found = least_squares<5>(unknowns, 2, visit);
  if (!found) return std::nullopt;
  return start.inclination + (*found)(0);
}

double folded(double inclination) {
  const double angle = std::remainder(inclination, std::numbers::pi);
  return angle > -0.5 * std::numbers::pi ? angle : angle + std::numbers::pi;
}

}  // namespace

double Band::distance(const Eigen::Vector2d& position) const {
  return across(inclination).dot(position - centre);
}

BandSearch find_band(const Samples& samples, const BandOptions& options) {
  if (samples.size() < 20) return {std::nullopt, "fewer than 20 samples"};
  SampleColumns<2> columns = columns_of(samples);
  std::string reason;
  if (!columns.scale(reason)) return {std::nullopt, reason};
  BandSearch search = measure(columns, starting_inclination(columns));
  if (!search.band) return search;
  const std::optional<double> inclination = inclination_by_least_squares(samples, *search.band);
  if (!inclination) return {std::nullopt, "the fit of a line does not settle: no straight band"};
  search = measure(columns, folded(*inclination));
  if (!search.band) return search;
  const Band& band = *search.band;
  reason = doubt_of_band(distances_from(samples, band), columns.shears, band.thickness, band.resolution,
                         band.peak, band.background, options.contrast);
  return reason.empty() ? search : BandSearch{std::nullopt, reason};
}

InsideOutside means(const Samples& samples, const Band& band, double Sample::*value) {
  std::vector<double> values;
  for (const Sample& sample : samples) values.push_back(sample.*value);
  return means_beside(distances_from(samples, band), columns_of(samples).sizes, values, band.thickness);
}

double localisation(const Samples& samples, const Band& band) {
  return localisation_of(means(samples, band, &Sample::shear));
}

std::optional<double> onset_strain(const std::vector<double>& strains,
                                   const std::vector<double>& localisations, double threshold) {
  if (strains.empty() || localisations.back() < threshold) return std::nullopt;
  std::size_t first = localisations.size() - 1;
  while (first > 0 && localisations[first - 1] >= threshold) --first;
  if (first == 0) return strains.front();
  const double before = localisations[first - 1];
  const double share = (threshold - before) / (localisations[first] - before);
  return strains[first - 1] + share * (strains[first] - strains[first - 1]);
}

}  // namespace polargrain::band
