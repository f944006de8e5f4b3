// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/shear_plane.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "band/layer_in_samples.hpp"
#include "band/least_squares.hpp"
#include "common/elementary_functions.hpp"

namespace polargrain::band {
namespace {

constexpr std::size_t kLeastSamples = 50;
constexpr int kDirections = 500;  ///< of the first search, on the half sphere

SampleColumns<3> columns_of(const SpaceSamples& samples) {
  SampleColumns<3> columns;
  for (const SpaceSample& sample : samples) {
    columns.positions.push_back(sample.position);
    columns.sizes.push_back(sample.volume);
    columns.shears.push_back(sample.shear);
  }
  return columns;
}

/// Evenly spread over the upper half sphere (a spiral of equal areas).
Eigen::Vector3d direction(int number) {
  const double height = (number + 0.5) / kDirections;
  const double angle = number * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double radius = std::sqrt(1.0 - height * height);
  return {radius * cosine(angle), radius * sine(angle), height};
}

Eigen::Vector3d starting_normal(const SampleColumns<3>& columns) {
  Eigen::Vector3d best = Eigen::Vector3d::UnitZ();
  double greatest = -std::numeric_limits<double>::infinity();
  for (int number = 0; number < kDirections; ++number) {
    const Eigen::Vector3d normal = direction(number);
    const double prominence = prominence_of(
        rough_profile_of(columns.distances_along(normal), columns.sizes, columns.shears, columns.scales));
    if (prominence > greatest) {
      greatest = prominence;
      best = normal;
    }
  }
  return best;
}

/// Plane of one normal, from its profile.
PlaneSearch measure(const SampleColumns<3>& columns, const Eigen::Vector3d& normal) {
  const LayerSearch<3> search = measure_layer<3>(columns, normal);
  if (!search.layer) return {std::nullopt, search.reason};
  const Layer<3>& layer = *search.layer;
  return {Plane{layer.centre, normal, layer.thickness, layer.peak, layer.background, layer.resolution}, ""};
}

std::vector<double> distances_from(const SpaceSamples& samples, const Plane& plane) {
  std::vector<double> distances;
  distances.reserve(samples.size());
  for (const SpaceSample& sample : samples) distances.push_back(plane.distance(sample.position));
  return distances;
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
  SampleColumns<3> columns = columns_of(samples);
  std::string reason;
  if (!columns.scale(reason)) return {std::nullopt, reason};
  PlaneSearch search = measure(columns, starting_normal(columns));
  if (!search.plane) return search;
  const std::optional<Eigen::Vector3d> normal = normal_by_least_squares(samples, *search.plane);
  if (!normal) return {std::nullopt, "the fit of a plane does not settle: no plane band"};
  search = measure(columns, *normal);
  if (!search.plane) return search;
  const Plane& plane = *search.plane;
  reason = doubt_of_band(distances_from(samples, plane), columns.shears, plane.thickness, plane.resolution,
                         plane.peak, plane.background, options.contrast);
  return reason.empty() ? search : PlaneSearch{std::nullopt, reason};
}

InsideOutside means(const SpaceSamples& samples, const Plane& plane, double SpaceSample::*value) {
  std::vector<double> values;
  for (const SpaceSample& sample : samples) values.push_back(sample.*value);
  return means_beside(distances_from(samples, plane), columns_of(samples).sizes, values, plane.thickness);
}

double localisation(const SpaceSamples& samples, const Plane& plane) {
  return localisation_of(means(samples, plane, &SpaceSample::shear));
}

}  // namespace polargrain::band
