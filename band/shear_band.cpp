// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/shear_band.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "common/elementary_functions.hpp"

namespace polargrain::band {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHalfMaximumWidth = 2.354820045;  // of a Gaussian, in standard deviations
constexpr int kMostSteps = 200;
/// Of a profile: more has only what lies in few places far from each other.
constexpr double kMostValues = 1e5;
constexpr double kSettled = 1e-6;  ///< last turn (rad) and shift (thicknesses) of the fit

/// Mean shear along lines of one inclination, over their distance from the origin of the samples.
struct Profile {
  double first = 0.0;  ///< distance of the first value, m
  double step = 0.0;
  std::vector<double> values;
  std::vector<double> chords;  ///< area a width: length of the line within the body, m
  double least_chord = 0.0;
  double mean = 0.0;  ///< of all samples

  [[nodiscard]] bool valid(std::size_t i) const { return chords[i] >= least_chord; }
  /// How far a value stands out from the mean, in units of its own scatter: a mean over a longer line
  /// scatters less.
  [[nodiscard]] double prominence(std::size_t i) const { return (values[i] - mean) * std::sqrt(chords[i]); }
  [[nodiscard]] double distance(double place) const { return first + step * place; }
};

Eigen::Vector2d along(double inclination) {
  return {cosine(inclination), sine(inclination)};
}
Eigen::Vector2d across(double inclination) {
  return {-sine(inclination), cosine(inclination)};
}

/// Sizes that the search goes by.
struct Scales {
  double spacing = 0.0;  ///< mean distance of the samples
  double kernel = 0.0;   ///< standard deviation of the smoothing across
  double chord = 0.0;    ///< shortest line of a valid profile value
  double mean_shear = 0.0;
  double extent = 0.0;  ///< of all samples, corner to corner
};

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

Profile profile_of(const Samples& samples, const Scales& scales, double inclination) {
  const Eigen::Vector2d normal = across(inclination);
  std::vector<double> distances;
  distances.reserve(samples.size());
  for (const Sample& sample : samples) distances.push_back(normal.dot(sample.position));
  const auto [low, high] = std::minmax_element(distances.begin(), distances.end());
  Profile profile;
  profile.step = 0.5 * scales.kernel;
  profile.first = *low;
  const auto count = static_cast<std::size_t>(std::ceil((*high - *low) / profile.step)) + 1;
  std::vector<double> sums(count, 0.0);
  profile.chords.assign(count, 0.0);
  profile.least_chord = scales.chord;
  profile.mean = scales.mean_shear;
  constexpr double reach = 3.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double place = (distances[k] - *low) / profile.step;
    const double spread = reach * scales.kernel / profile.step;
    const auto begin = static_cast<std::size_t>(std::max(0.0, std::ceil(place - spread)));
    const auto end = std::min(count, static_cast<std::size_t>(std::floor(place + spread)) + 1);
    for (std::size_t i = begin; i < end; ++i) {
      const double z = (static_cast<double>(i) - place) * profile.step / scales.kernel;
      const double weight =
          samples[k].area * exponential(-0.5 * z * z) / (scales.kernel * std::sqrt(2.0 * std::numbers::pi));
      sums[i] += weight * samples[k].shear;
      profile.chords[i] += weight;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    profile.values.push_back(profile.chords[i] > 0.0 ? sums[i] / profile.chords[i] : 0.0);
  return profile;
}

/// Place of the most prominent valid value. @returns nothing when no value is valid
std::optional<std::size_t> peak_of(const Profile& profile) {
  std::optional<std::size_t> peak;
  for (std::size_t i = 0; i < profile.values.size(); ++i)
    if (profile.valid(i) && (!peak || profile.prominence(i) > profile.prominence(*peak))) peak = i;
  return peak;
}

double background_of(const Profile& profile) {
  std::vector<double> values;
  for (std::size_t i = 0; i < profile.values.size(); ++i)
    if (profile.valid(i)) values.push_back(profile.values[i]);
  const auto quartile = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), quartile, values.end());
  return *quartile;
}

/// Distance where the profile falls below a level, from the peak towards one side.
std::optional<double> crossing(const Profile& profile, std::size_t peak, double level, int direction) {
  const auto count = static_cast<std::ptrdiff_t>(profile.values.size());
  for (auto i = static_cast<std::ptrdiff_t>(peak);; i += direction) {
    const std::ptrdiff_t next = i + direction;
    if (next < 0 || next >= count || !profile.valid(static_cast<std::size_t>(next))) return std::nullopt;
    const double here = profile.values[static_cast<std::size_t>(i)];
    const double there = profile.values[static_cast<std::size_t>(next)];
    if (there < level)
      return profile.distance(static_cast<double>(i) + direction * (here - level) / (here - there));
  }
}

/// Band of one inclination, from its profile.
BandSearch measure(const Samples& samples, const Scales& scales, double inclination) {
  const Profile profile = profile_of(samples, scales, inclination);
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

double starting_inclination(const Samples& samples, const Scales& scales) {
  double best = 0.0;
  double greatest = -std::numeric_limits<double>::infinity();
  for (int degree = -89; degree <= 90; ++degree) {
    const Profile profile = profile_of(samples, scales, degree * kDegree);
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
  using Matrix5 = Eigen::Matrix<double, 5, 5>;
  const double length = start.thickness;  // unit of the lengths, so that all unknowns are of order one
  const double area = std::accumulate(samples.begin(), samples.end(), 0.0,
                                      [](double sum, const Sample& sample) { return sum + sample.area; });
  // Unknowns: turn of the line, its shift, w, A, B.
  Vector5 unknowns(0.0, 0.0, 1.0 / kHalfMaximumWidth, start.peak - start.background, start.background);
  const auto sum_of_squares = [&](const Vector5& u, Vector5* gradient, Matrix5* curvature) {
    double sum = 0.0;
    if (gradient) gradient->setZero();
    if (curvature) curvature->setZero();
    const Eigen::Vector2d direction = along(start.inclination + u(0));
    const Eigen::Vector2d normal = across(start.inclination + u(0));
    for (const Sample& sample : samples) {
      const Eigen::Vector2d apart = (sample.position - start.centre) / length;
      const double s = normal.dot(apart) - u(1);
      const double bell = exponential(-0.5 * s * s / (u(2) * u(2)));
      const double difference = u(3) * bell + u(4) - sample.shear;
      const double weight = sample.area / area;
      sum += weight * difference * difference;
      if (!gradient) continue;
      const double by_distance = -u(3) * bell * s / (u(2) * u(2));
      const Vector5 by_unknowns(-by_distance * direction.dot(apart), -by_distance, -by_distance * s / u(2),
                                bell, 1.0);
      *gradient += weight * difference * by_unknowns;
      *curvature += weight * by_unknowns * by_unknowns.transpose();
    }
    return sum;
  };
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps; ++step) {
    Vector5 gradient;
    Matrix5 curvature;
    const double before = sum_of_squares(unknowns, &gradient, &curvature);
    Vector5 move;
    for (;; damping *= 4.0) {
      if (damping > 1e12) return start.inclination + unknowns(0);  // no smaller sum to round-off
      Matrix5 damped = curvature;
      damped.diagonal() *= 1.0 + damping;
      move = -damped.ldlt().solve(gradient);
      if (sum_of_squares(unknowns + move, nullptr, nullptr) <= before) break;
    }
    damping *= 0.1;
    unknowns += move;
    if (std::abs(move(0)) < kSettled && std::abs(move(1)) < kSettled) return start.inclination + unknowns(0);
  }
  return std::nullopt;
}

double folded(double inclination) {
  const double angle = std::remainder(inclination, std::numbers::pi);
  return angle > -0.5 * std::numbers::pi ? angle : angle + std::numbers::pi;
}

/// Standard error of a profile value: scatter of the samples outside over the root of their number in a
/// kernel.
double standard_error(const Samples& samples, const Band& band) {
  double sum = 0.0;
  double squares = 0.0;
  double outside = 0.0;
  double inside = 0.0;
  for (const Sample& sample : samples) {
    const double distance = std::abs(band.distance(sample.position));
    if (distance <= 0.5 * band.thickness) inside += 1.0;
    if (distance <= band.thickness) continue;
    outside += 1.0;
    sum += sample.shear;
    squares += sample.shear * sample.shear;
  }
  if (outside < 2.0 || inside < 1.0) return 0.0;
  const double variance = std::max(0.0, squares / outside - sum * sum / outside / outside);
  const double in_kernel = inside * std::min(1.0, band.resolution / band.thickness);
  return std::sqrt(variance / std::max(1.0, in_kernel));
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
  BandSearch search = measure(samples, scales, starting_inclination(samples, scales));
  if (!search.band) return search;
  const std::optional<double> inclination = inclination_by_least_squares(samples, *search.band);
  if (!inclination) return {std::nullopt, "the fit of a line does not settle: no straight band"};
  search = measure(samples, scales, folded(*inclination));
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
  if (band.peak - band.background < 5.0 * standard_error(samples, band))
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
