// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/remarks/scene.hpp"
#include "common/csv_table.hpp"
#include "coupler/case/data_files.hpp"

namespace polargrain::app {

inline constexpr double kGravity = 9.81;  // m/s2

/// Calls visit(member, table) for each motion that is given by its accelerations: the unknown with the name of the file, and the
/// times and accelerations in it.
template <class Visit>
void for_each_base_motion(const Scene& scene, Visit visit) {
  const coupler::Entry* const boundary = scene.find({"boundary"});
  if (!scene.the_case().real_time || boundary == nullptr) return;
  for (const coupler::Entry& item : boundary->items) {
    const coupler::Entry* const files = item.find("accelerate");
    if (files == nullptr) continue;
    for (const coupler::Entry::Member& member : files->members) {
      const auto file = coupler::find_data_file(member.value.text, scene.the_case().file.parent_path());
      if (!file) continue;
      try {
        visit(member, CsvTable(*file));
      } catch (const InputError&) {
        continue;  // the case says so itself
      }
    }
  }
}

/// The largest acceleration of a motion, m/s2.
inline double largest_acceleration(const CsvTable& motion) {
  double largest = 0.0;
  for (std::size_t row = 0; row < motion.rows(); ++row)
    largest = std::max(largest, std::abs(motion.number(row, 1)));
  return largest;
}

/// Speeds of waves in a region, m/s.
struct WaveSpeeds {
  double shear;
  double compression;
};

/// Nothing where a modulus is not known.
inline std::optional<WaveSpeeds> wave_speeds(const Scene& scene, const SceneRegion& region) {
  double shear = 0.0;
  double poisson = 0.0;
  if (region.packing != nullptr) {
    shear = region.packing->moduli.shear;
    poisson = region.packing->moduli.poisson;
  } else {
    const auto young = scene.quantity({"materials", region.material, "E"}, coupler::Dimension::pressure);
    const auto given = scene.quantity({"materials", region.material, "nu"}, coupler::Dimension::number);
    if (young && given) {
      shear = 0.5 * *young / (1.0 + *given);
      poisson = *given;
    }
  }
  const double density = scene.with_problem([&](const auto& problem) {
    const auto found = problem.densities.find(region.name);
    return found == problem.densities.end() ? 0.0 : found->second;
  });
  if (!(shear > 0.0 && density > 0.0)) return {};
  const double slow = std::sqrt(shear / density);
  const double ratio = poisson < 0.5 ? std::sqrt(2.0 * (1.0 - poisson) / (1.0 - 2.0 * poisson)) : HUGE_VAL;
  return WaveSpeeds{slow, slow * ratio};
}

inline std::optional<double> shear_speed(const Scene& scene, const SceneRegion& region) {
  const auto speeds = wave_speeds(scene, region);
  return speeds ? std::optional(speeds->shear) : std::nullopt;
}

}  // namespace polargrain::app
