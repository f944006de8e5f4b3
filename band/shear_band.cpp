// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/shear_band.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "band/least_squares.hpp"
#include "band/profile.hpp"
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

Scales scales_of(const Samples& samples) {
  Scales scales;
  double area = 0.0;
  Eigen::Vector2d low = samples.front().position;
  Eigen::Vector2d high = low;
  for (const Sample& sample : samples) {
    area += sample.area;
    scales.mean_shear += sample.area * sample.shear;
    low = low.cwiseMin(sample.position);
    high = high.cwiseMax(sample.position);
  }
  scales.mean_shear /= area;
  scales.spacing = std::sqrt(area / static_cast<double>(samples.size()));
  scales.kernel = 0.5 * scales.spacing;
  scales.chord = 0.5 * (high - low).minCoeff();
  scales.extent = (high - low).norm();
  return scales;
}

/// The samples as a profile takes them.
struct Columns {
  std::vector<double> areas;
  std::vector<double> shears;

  explicit Columns(const Samples& samples) {
    for (const Sample& sample : samples) {
      areas.push_back(sample.area);
      shears.push_back(sample.shear);
    }
  }
};

Profile profile_of(const Samples& samples, const Columns& columns, const Scales& scales, double inclination) {
  const Eigen::Vector2d normal = across(inclination);
  std::vector<double> distances;
  distances.reserve(samples.size());
  for (const Sample& sample : samples) distances.push_back(normal.dot(sample.position));
  return profile_of(distances, columns.areas, columns.shears, scales);
}

/// Band of one inclination, from its profile.
BandSearch measure(const Samples& samples, const Columns& columns, const Scales& scales, double inclination) {
  const Profile profile = profile_of(samples, columns, scales, inclination);
  const std::optional<std::size_t> peak = peak_of(profile);
  if (!peak) return {std::nullopt, "the samples span no area"};
  Band band;
  band.inclination = inclination;
  band.resolution = kHalfMaximumWidth * scales.kernel;
  band.peak = profile.values[*peak];
  band.background = background_of(profile);
  const double half = 0.5 * (band.peak + band.background);
  const std::optional<double> low = crossing(profile, *peak, half, -1);
  const std::optional<double> high = crossing(profile, *peak, half, +1);
  if (!low || !high) return {std::nullopt, "the shear does not fall to half its maximum on both sides"};
  band.thickness = *high - *low;
  const double middle = 0.5 * (*low + *high);
  // The point of the middle line that is nearest to the middle of the samples in the band.
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double area = 0.0;
  for (const Sample& sample : samples)
    if (std::abs(across(inclination).dot(sample.position) - middle) <= 0.5 * band.thickness) {
      mean += sample.area * sample.position;
      area += sample.area;
    }
  if (area == 0.0) return {std::nullopt, "no sample lies in the band: it is thinner than they are apart"};
  mean /= area;
  band.centre = mean + (middle - across(inclination).dot(mean)) * across(inclination);
  return {band, ""};
}

double starting_inclination(const Samples& samples, const Columns& columns, const Scales& scales) {
  double best = 0.0;
  double greatest = -std::numeric_limits<double>::infinity();
  for (int degree = -89; degree <= 90; ++degree) {
    const Profile profile = profile_of(samples, columns, scales, degree * kDegree);
    const std::optional<std::size_t> peak = peak_of(profile);
    if (peak && profile.prominence(*peak) > greatest) {
      greatest = profile.prominence(*peak);
      best = degree * kDegree;
    }
  }
  return best;
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
  for (const Sample& sample : samples)
    if (!(sample.area > 0.0) || !std::isfinite(sample.area + sample.shear) || !sample.position.allFinite())
      return {std::nullopt, "a sample has no area, or no strain"};
  const Scales scales = scales_of(samples);
  if (!(scales.extent / scales.kernel < kMostValues)) return {std::nullopt, "the samples span no area"};
  const Columns columns(samples);
  BandSearch search = measure(samples, columns, scales, starting_inclination(samples, columns, scales));
  if (!search.band) return search;
  const std::optional<double> inclination = inclination_by_least_squares(samples, *search.band);
  if (!inclination) return {std::nullopt, "the fit of a line does not settle: no straight band"};
  search = measure(samples, columns, scales, folded(*inclination));
  if (!search.band) return search;
  const Band& band = *search.band;
  const auto has_sample = [&](auto is_there) {
    return std::any_of(samples.begin(), samples.end(), [&](const Sample& sample) {
      return is_there(std::abs(band.distance(sample.position)));
    });
  };
  if (!has_sample([&](double distance) { return distance <= 0.5 * band.thickness; }) ||
      !has_sample([&](double distance) { return distance > band.thickness; }))
    return {std::nullopt, "no sample lies on one side of the band's edge"};
  if (band.peak < options.contrast * band.background)
    return {std::nullopt, fmt::format("the shear at its greatest is only {:.2f} times the background",
                                      band.peak / band.background)};
  std::vector<double> distances;
  for (const Sample& sample : samples) distances.push_back(band.distance(sample.position));
  if (band.peak - band.background <
      5.0 * standard_error(distances, columns.shears, band.thickness, band.resolution))
    return {std::nullopt, "the shear at its greatest is within the scatter of the samples"};
  return search;
}

InsideOutside means(const Samples& samples, const Band& band, double Sample::*value) {
  InsideOutside sums;
  InsideOutside areas;
  for (const Sample& sample : samples) {
    const double distance = std::abs(band.distance(sample.position));
    if (distance <= 0.5 * band.thickness) {
      sums.inside += sample.area * sample.*value;
      areas.inside += sample.area;
    } else if (distance > band.thickness) {
      sums.outside += sample.area * sample.*value;
      areas.outside += sample.area;
    }
  }
  if (areas.inside == 0.0 || areas.outside == 0.0)
    throw std::invalid_argument("no sample lies on one side of the band's edge");
  return {sums.inside / areas.inside, sums.outside / areas.outside};
}

double localisation(const Samples& samples, const Band& band) {
  const InsideOutside shear = means(samples, band, &Sample::shear);
  if (shear.inside == shear.outside) return 1.0;  // also where nothing deforms
  return shear.inside / shear.outside;
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
