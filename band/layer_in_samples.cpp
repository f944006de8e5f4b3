// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/layer_in_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/elementary_functions.hpp"

namespace polargrain::band {
namespace {

constexpr const char* kNoSide = "no sample lies on one side of the band's edge";

template <int dim>
const char* name_of_size() {
  return dim == 2 ? "area" : "volume";
}

}  // namespace

template <int dim>
bool SampleColumns<dim>::scale(std::string& reason) {
  for (std::size_t k = 0; k < sizes.size(); ++k)
    if (!(sizes[k] > 0.0) || !std::isfinite(sizes[k] + shears[k]) || !positions[k].allFinite()) {
      reason = fmt::format("a sample has no {}, or no strain", name_of_size<dim>());
      return false;
    }
  double size = 0.0;
  Vector low = positions.front();
  Vector high = low;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    size += sizes[k];
    scales.mean_shear += sizes[k] * shears[k];
    low = low.cwiseMin(positions[k]);
    high = high.cwiseMax(positions[k]);
  }
  scales.mean_shear /= size;
  const double share = size / static_cast<double>(sizes.size());
  scales.spacing = dim == 2 ? std::sqrt(share) : power(share, 1.0 / 3.0);
  scales.kernel = 0.5 * scales.spacing;
  Vector sides = high - low;
  std::sort(sides.begin(), sides.end());
  scales.chord = dim == 2 ? 0.5 * sides(0) : 0.25 * sides(0) * sides(1);
  scales.extent = (high - low).norm();
  if (scales.extent / scales.kernel < kMostValues) return true;
  reason = fmt::format("the samples span no {}", name_of_size<dim>());
  return false;
}

template <int dim>
std::vector<double> SampleColumns<dim>::distances_along(const Vector& normal) const {
  std::vector<double> distances;
  distances.reserve(positions.size());
  for (const Vector& position : positions) distances.push_back(normal.dot(position));
  return distances;
}

double prominence_of(const Profile& profile) {
  const std::optional<std::size_t> peak = peak_of(profile);
  return peak ? profile.prominence(*peak) : -std::numeric_limits<double>::infinity();
}

template <int dim>
LayerSearch<dim> measure_layer(const SampleColumns<dim>& samples,
                               const Eigen::Matrix<double, dim, 1>& normal) {
  const std::vector<double> distances = samples.distances_along(normal);
  const Profile profile = profile_of(distances, samples.sizes, samples.shears, samples.scales);
  const std::optional<std::size_t> peak = peak_of(profile);
  if (!peak) return {std::nullopt, fmt::format("the samples span no {}", name_of_size<dim>())};
  Layer<dim> layer;
  layer.normal = normal;
  layer.resolution = kHalfMaximumWidth * samples.scales.kernel;
  layer.peak = profile.values[*peak];
  layer.background = background_of(profile);
  const double half = 0.5 * (layer.peak + layer.background);
  const std::optional<double> low = crossing(profile, *peak, half, -1);
  const std::optional<double> high = crossing(profile, *peak, half, +1);
  if (!low || !high) return {std::nullopt, "the shear does not fall to half its maximum on both sides"};
  layer.thickness = *high - *low;
  const double middle = 0.5 * (*low + *high);
  // The point of the middle that is nearest to the mean of the samples in the band.
  Eigen::Matrix<double, dim, 1> mean = Eigen::Matrix<double, dim, 1>::Zero();
  double size = 0.0;
  for (std::size_t k = 0; k < distances.size(); ++k)
    if (std::abs(distances[k] - middle) <= 0.5 * layer.thickness) {
      mean += samples.sizes[k] * samples.positions[k];
      size += samples.sizes[k];
    }
  if (size == 0.0) return {std::nullopt, "no sample lies in the band: it is thinner than they are apart"};
  mean /= size;
  layer.centre = mean + (middle - normal.dot(mean)) * normal;
  return {layer, ""};
}

std::string doubt_of_band(const std::vector<double>& distances, const std::vector<double>& shears,
                          double thickness, double resolution, double peak, double background,
                          double contrast) {
  const auto has_sample = [&](auto is_there) {
    return std::ranges::any_of(distances, [&](double distance) { return is_there(std::abs(distance)); });
  };
  if (!has_sample([&](double distance) { return distance <= 0.5 * thickness; }) ||
      !has_sample([&](double distance) { return distance > thickness; }))
    return kNoSide;
  if (peak < contrast * background)
    return fmt::format("the shear at its greatest is only {:.2f} times the background", peak / background);
  if (peak - background < 5.0 * standard_error(distances, shears, thickness, resolution))
    return "the shear at its greatest is within the scatter of the samples";
  return {};
}

InsideOutside means_beside(const std::vector<double>& distances, const std::vector<double>& sizes,
                           const std::vector<double>& values, double thickness) {
  InsideOutside sums;
  InsideOutside shares;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const double distance = std::abs(distances[k]);
    if (distance <= 0.5 * thickness) {
      sums.inside += sizes[k] * values[k];
      shares.inside += sizes[k];
    } else if (distance > thickness) {
      sums.outside += sizes[k] * values[k];
      shares.outside += sizes[k];
    }
  }
  if (shares.inside == 0.0 || shares.outside == 0.0) throw std::invalid_argument(kNoSide);
  return {sums.inside / shares.inside, sums.outside / shares.outside};
}

double localisation_of(const InsideOutside& shear) {
  if (shear.inside == shear.outside) return 1.0;  // also where nothing deforms
  return shear.inside / shear.outside;
}

template struct SampleColumns<2>;
template struct SampleColumns<3>;
template LayerSearch<2> measure_layer<2>(const SampleColumns<2>&, const Eigen::Vector2d&);
template LayerSearch<3> measure_layer<3>(const SampleColumns<3>&, const Eigen::Vector3d&);

}  // namespace polargrain::band
