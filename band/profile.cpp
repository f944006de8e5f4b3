// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/profile.hpp"

#include <algorithm>
#include <numbers>

#include "common/elementary_functions.hpp"

namespace polargrain::band {

Profile profile_of(const std::vector<double>& distances, const std::vector<double>& sizes,
                   const std::vector<double>& shears, const Scales& scales) {
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
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const double place = (distances[k] - *low) / profile.step;
    const double spread = reach * scales.kernel / profile.step;
    const auto begin = static_cast<std::size_t>(std::max(0.0, std::ceil(place - spread)));
    const auto end = std::min(count, static_cast<std::size_t>(std::floor(place + spread)) + 1);
    for (std::size_t i = begin; i < end; ++i) {
      const double z = (static_cast<double>(i) - place) * profile.step / scales.kernel;
      const double weight =
          sizes[k] * exponential(-0.5 * z * z) / (scales.kernel * std::sqrt(2.0 * std::numbers::pi));
      sums[i] += weight * shears[k];
      profile.chords[i] += weight;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    profile.values.push_back(profile.chords[i] > 0.0 ? sums[i] / profile.chords[i] : 0.0);
  return profile;
}

Profile rough_profile_of(const std::vector<double>& distances, const std::vector<double>& sizes,
                         const std::vector<double>& shears, const Scales& scales) {
  const auto [low, high] = std::minmax_element(distances.begin(), distances.end());
  Profile profile;
  profile.step = scales.spacing;
  profile.first = *low;
  profile.least_chord = scales.chord;
  profile.mean = scales.mean_shear;
  profile.values.assign(static_cast<std::size_t>((*high - *low) / profile.step) + 2, 0.0);
  profile.chords = profile.values;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const double place = (distances[k] - *low) / profile.step;
    const auto below = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(below);
    const double size = sizes[k] / profile.step;
    profile.chords[below] += (1.0 - share) * size;
    profile.chords[below + 1] += share * size;
    profile.values[below] += (1.0 - share) * size * shears[k];
    profile.values[below + 1] += share * size * shears[k];
  }
  for (std::size_t i = 0; i < profile.values.size(); ++i)
    if (profile.chords[i] > 0.0) profile.values[i] /= profile.chords[i];
  return profile;
}

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

double standard_error(const std::vector<double>& distances, const std::vector<double>& shears,
                      double thickness, double resolution) {
  double sum = 0.0;
  double squares = 0.0;
  double outside = 0.0;
  double inside = 0.0;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const double distance = std::abs(distances[k]);
    if (distance <= 0.5 * thickness) inside += 1.0;
    if (distance <= thickness) continue;
    outside += 1.0;
    sum += shears[k];
    squares += shears[k] * shears[k];
  }
  if (outside < 2.0 || inside < 1.0) return 0.0;
  const double variance = std::max(0.0, squares / outside - sum * sum / outside / outside);
  const double in_kernel = inside * std::min(1.0, resolution / thickness);
  return std::sqrt(variance / std::max(1.0, in_kernel));
}

}  // namespace polargrain::band
