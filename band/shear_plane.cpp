// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/shear_plane.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "band/least_squares.hpp"
#include "band/profile.hpp"
#include "common/elementary_functions.hpp"

namespace polargrain::band {
namespace {

constexpr std::size_t kLeastSamples = 50;
constexpr int kDirections = 500;  ///< of the first search, on the half sphere

/// The samples as a profile takes them.
struct Columns {
  std::vector<double> volumes;
  std::vector<double> shears;

  explicit Columns(const SpaceSamples& samples) {
    for (const SpaceSample& sample : samples) {
      volumes.push_back(sample.volume);
      shears.push_back(sample.shear);
    }
  }
};

Scales scales_of(const SpaceSamples& samples) {
  Scales scales;
  double volume = 0.0;
  Eigen::Vector3d low = samples.front().position;
  Eigen::Vector3d high = low;
  for (const SpaceSample& sample : samples) {
    volume += sample.volume;
    scales.mean_shear += sample.volume * sample.shear;
    low = low.cwiseMin(sample.position);
    high = high.cwiseMax(sample.position);
  }
  scales.mean_shear /= volume;
  scales.spacing = power(volume / static_cast<double>(samples.size()), 1.0 / 3.0);
  scales.kernel = 0.5 * scales.spacing;
  Eigen::Vector3d sides = high - low;
  std::sort(sides.begin(), sides.end());
  scales.chord = 0.25 * sides(0) * sides(1);
  scales.extent = sides.norm();
  return scales;
}

std::vector<double> distances_along(const SpaceSamples& samples, const Eigen::Vector3d& normal) {
  std::vector<double> distances;
  distances.reserve(samples.size());
  for (const SpaceSample& sample : samples) distances.push_back(normal.dot(sample.position));
  return distances;
}

/// Evenly spread over the upper half sphere (a spiral of equal areas).
Eigen::Vector3d direction(int number) {
  const double height = (number + 0.5) / kDirections;
  const double angle = number * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double radius = std::sqrt(1.0 - height * height);
  return {radius * cosine(angle), radius * sine(angle), height};
}

Eigen::Vector3d starting_normal(const SpaceSamples& samples, const Columns& columns, const Scales& scales) {
  Eigen::Vector3d best = Eigen::Vector3d::UnitZ();
  double greatest = -std::numeric_limits<double>::infinity();
  for (int number = 0; number < kDirections; ++number) {
    const Eigen::Vector3d normal = direction(number);
    const Profile profile =
        rough_profile_of(distances_along(samples, normal), columns.volumes, columns.shears, scales);
    const std::optional<std::size_t> peak = peak_of(profile);
    if (peak && profile.prominence(*peak) > greatest) {
      greatest = profile.prominence(*peak);
      best = normal;
    }
  }
  return best;
}

/// Band of one normal, from its profile.
PlaneSearch measure(const SpaceSamples& samples, const Columns& columns, const Scales& scales,
                    const Eigen::Vector3d& normal) {
  const std::vector<double> distances = distances_along(samples, normal);
  const Profile profile = profile_of(distances, columns.volumes, columns.shears, scales);
  const std::optional<std::size_t> peak = peak_of(profile);
  if (!peak) return {std::nullopt, "the samples span no volume"};
  Plane plane;
  plane.normal = normal;
  plane.resolution = kHalfMaximumWidth * scales.kernel;
  plane.peak = profile.values[*peak];
  plane.background = background_of(profile);
  const double half = 0.5 * (plane.peak + plane.background);
  const std::optional<double> low = crossing(profile, *peak, half, -1);
  const std::optional<double> high = crossing(profile, *peak, half, +1);
  if (!low || !high) return {std::nullopt, "the shear does not fall to half its maximum on both sides"};
  plane.thickness = *high - *low;
  const double middle = 0.5 * (*low + *high);
  // The point of the middle plane that is nearest to the middle of the samples in the band.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double volume = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (std::abs(distances[k] - middle) <= 0.5 * plane.thickness) {
      mean += samples[k].volume * samples[k].position;
      volume += samples[k].volume;
    }
  if (volume == 0.0) return {std::nullopt, "no sample lies in the band: it is thinner than they are apart"};
  mean /= volume;
  plane.centre = mean + (middle - normal.dot(mean)) * normal;
  return {plane, ""};
}

/// Normal of the Gaussian band A exp(-s^2 / (2 w^2)) + B whose sum of squared differences from the shear, weighted with the
/// volume, is least, the band measured so far as the start. @returns nothing when it does not settle
std::optional<Eigen::Vector3d> normal_by_least_squares(const SpaceSamples& samples, const Plane& start) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const double length = start.thickness;  // unit of the lengths, so that all unknowns are of order one
  double volume = 0.0;
  for (const SpaceSample& sample : samples) volume += sample.volume;
  const Eigen::Vector3d first = start.normal.unitOrthogonal();
  const Eigen::Vector3d second = start.normal.cross(first);
  // Unknowns: the normal is start.normal + a first + b second, made a unit; shift, w, A, B.
  Vector6 unknowns;
  unknowns << 0.0, 0.0, 0.0, 1.0 / kHalfMaximumWidth, start.peak - start.background, start.background;
  const auto visit = [&](const Vector6& u, bool gives_derivatives, auto&& each) {
    const Eigen::Vector3d leaning = start.normal + u(0) * first + u(1) * second;
    const double size = leaning.norm();
    for (const SpaceSample& sample : samples) {
      const Eigen::Vector3d apart = (sample.position - start.centre) / length;
      const double projected = leaning.dot(apart) / size;
      const double s = projected - u(2);
      const double bell = exponential(-0.5 * s * s / (u(3) * u(3)));
      const double difference = u(4) * bell + u(5) - sample.shear;
      Vector6 by_unknowns = Vector6::Zero();
      if (gives_derivatives) {
        const double by_distance = -u(4) * bell * s / (u(3) * u(3));
        by_unknowns << by_distance * (first.dot(apart) - projected * u(0) / size) / size,
            by_distance * (second.dot(apart) - projected * u(1) / size) / size, -by_distance,
            -by_distance * s / u(3), bell, 1.0;
      }
      each(sample.volume / volume, difference, by_unknowns);
    }
  };
  const std::optional<Vector6> found = least_squares<6>(unknowns, 3, visit);
  if (!found) return std::nullopt;
  const Eigen::Vector3d normal = (start.normal + (*found)(0) * first + (*found)(1) * second).normalized();
  return normal.z() < 0.0 ? Eigen::Vector3d(-normal) : normal;
}

}  // namespace

double shear_strain(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(strain, Eigen::EigenvaluesOnly).eigenvalues();
  return principal(2) - principal(0);
}

double Plane::dip() const {
  return arc_tangent(std::hypot(normal.x(), normal.y()), normal.z());
}

double Plane::dip_direction() const {
  return normal.x() == 0.0 && normal.y() == 0.0 ? 0.0 : arc_tangent(normal.y(), normal.x());
}

PlaneSearch find_plane(const SpaceSamples& samples, const BandOptions& options) {
  if (samples.size() < kLeastSamples)
    return {std::nullopt, fmt::format("fewer than {} samples", kLeastSamples)};
  for (const SpaceSample& sample : samples)
    if (!(sample.volume > 0.0) || !std::isfinite(sample.volume + sample.shear) ||
        !sample.position.allFinite())
      return {std::nullopt, "a sample has no volume, or no strain"};
  const Scales scales = scales_of(samples);
  if (!(scales.extent / scales.kernel < kMostValues)) return {std::nullopt, "the samples span no volume"};
  const Columns columns(samples);
  PlaneSearch search = measure(samples, columns, scales, starting_normal(samples, columns, scales));
  if (!search.plane) return search;
  const std::optional<Eigen::Vector3d> normal = normal_by_least_squares(samples, *search.plane);
  if (!normal) return {std::nullopt, "the fit of a plane does not settle: no plane band"};
  search = measure(samples, columns, scales, *normal);
  if (!search.plane) return search;
  const Plane& plane = *search.plane;
  std::vector<double> distances;
  for (const SpaceSample& sample : samples) distances.push_back(plane.distance(sample.position));
  const auto has_sample = [&](auto is_there) {
    return std::ranges::any_of(distances, [&](double distance) { return is_there(std::abs(distance)); });
  };
  if (!has_sample([&](double distance) { return distance <= 0.5 * plane.thickness; }) ||
      !has_sample([&](double distance) { return distance > plane.thickness; }))
    return {std::nullopt, "no sample lies on one side of the band's edge"};
  if (plane.peak < options.contrast * plane.background)
    return {std::nullopt, fmt::format("the shear at its greatest is only {:.2f} times the background",
                                      plane.peak / plane.background)};
  if (plane.peak - plane.background <
      5.0 * standard_error(distances, columns.shears, plane.thickness, plane.resolution))
    return {std::nullopt, "the shear at its greatest is within the scatter of the samples"};
  return search;
}

InsideOutside means(const SpaceSamples& samples, const Plane& plane, double SpaceSample::*value) {
  InsideOutside sums;
  InsideOutside volumes;
  for (const SpaceSample& sample : samples) {
    const double distance = std::abs(plane.distance(sample.position));
    if (distance <= 0.5 * plane.thickness) {
      sums.inside += sample.volume * sample.*value;
      volumes.inside += sample.volume;
    } else if (distance > plane.thickness) {
      sums.outside += sample.volume * sample.*value;
      volumes.outside += sample.volume;
    }
  }
  if (volumes.inside == 0.0 || volumes.outside == 0.0)
    throw std::invalid_argument("no sample lies on one side of the band's edge");
  return {sums.inside / volumes.inside, sums.outside / volumes.outside};
}

double localisation(const SpaceSamples& samples, const Plane& plane) {
  const InsideOutside shear = means(samples, plane, &SpaceSample::shear);
  if (shear.inside == shear.outside) return 1.0;  // also where nothing deforms
  return shear.inside / shear.outside;
}

}  // namespace polargrain::band
