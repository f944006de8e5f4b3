// SPDX-License-Identifier: GPL-2.0-or-later
// Steps in real time: masses, and motions that are given by their accelerations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "common/csv_table.hpp"
#include "common/error.hpp"
#include "coupler/case/data_files.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;

constexpr double kLight = 300.0;            // kg/m^3
constexpr double kHeavy = 12e3;             // lead
constexpr double kElementsOfAWave = 4.0;    // of elements with middle nodes
constexpr double kLostMotion = 0.02;        // of a motion
constexpr double kMostAcceleration = 50.0;  // m/s2, five times gravity: an earthquake has 0.1 to 10

/// Speed of shear waves in a region, m/s; nothing where a modulus is not known.
std::optional<double> shear_speed(const Scene& scene, const SceneRegion& region) {
  double shear = 0.0;
  if (region.packing != nullptr) {
    shear = region.packing->moduli.shear;
  } else {
    const auto young = scene.quantity({"materials", region.material, "E"}, Dimension::pressure);
    const auto poisson = scene.quantity({"materials", region.material, "nu"}, Dimension::number);
    if (young && poisson) shear = 0.5 * *young / (1.0 + *poisson);
  }
  const double density = scene.with_problem([&](const auto& problem) {
    const auto found = problem.densities.find(region.name);
    return found == problem.densities.end() ? 0.0 : found->second;
  });
  if (!(shear > 0.0 && density > 0.0)) return {};
  return std::sqrt(shear / density);
}

/// @param frequency of the motion, Hz: half of its changes of sign, over its time
void look_at_waves(const Scene& scene, const Entry& place, double frequency, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    const auto speed = shear_speed(scene, region);
    if (!speed || frequency <= 0.0) continue;
    const double wave = *speed / frequency;
    const double element = usual_element(scene, region);
    if (kElementsOfAWave * element <= wave) continue;
    remarks.push_back(
        {Rank::doubtful, kElementsOfAWave * element / wave,
         place.fault(fmt::format(
             "boundary: the motion of '{}' has {:.3g} Hz in the mean, whose shear wave is {} long in region '{}': {:.2g} "
             "elements (at least {:g})",
             place.text, frequency, metres(wave), region.name, wave / element, kElementsOfAWave)),
         fmt::format("elements of {} and less, or a motion without its high frequencies",
                     metres(wave / kElementsOfAWave))});
  }
}

/// An offset of a record carries the base away, faster than it swings. A pulse is no record.
void look_at_drift(const Entry& place, const CsvTable& table, Remarks& remarks) {
  constexpr double kMostDrift = 1.0;  // of the largest speed of the record without its mean
  constexpr int kFewTurns = 3;
  const auto time = [&](std::size_t row) { return table.number(row, 0); };
  const std::size_t rows = table.rows();
  double speed = 0.0;
  for (std::size_t row = 1; row < rows; ++row)
    speed += 0.5 * (table.number(row, 1) + table.number(row - 1, 1)) * (time(row) - time(row - 1));
  const double mean = speed / (time(rows - 1) - time(0));
  double swing = 0.0;
  double most = 0.0;
  int turns = 0;
  double last = 0.0;  // that was not zero to round-off
  for (std::size_t row = 1; row < rows; ++row) {
    const double now = table.number(row, 1) - mean;
    const double before = table.number(row - 1, 1) - mean;
    if (std::abs(now) > 1e-9 * std::abs(mean)) {
      if (now * last < 0.0) ++turns;
      last = now;
    }
    swing += 0.5 * (now + before) * (time(row) - time(row - 1));
    most = std::max(most, std::abs(swing));
  }
  if (turns < kFewTurns || std::abs(speed) <= kMostDrift * most) return;
  remarks.push_back(
      {Rank::doubtful, std::abs(speed) / most,
       place.fault(fmt::format(
           "boundary: the motion of '{}' ends with {:.3g} mm/s and its swings reach {:.3g} mm/s: an offset of {:.3g} m/s2 "
           "carries the base away",
           place.text, 1e3 * speed, 1e3 * most, mean)),
       "let the accelerations of the file add up to no speed (a baseline correction)"});
}

void look_at_motion(const Scene& scene, const Entry& place, Remarks& remarks) {
  const auto end = scene.end_time();
  const auto file = coupler::find_data_file(place.text, scene.the_case().file.parent_path());
  if (!end || !file) return;
  const CsvTable table(*file);
  if (table.rows() < 2) return;
  double last = 0.0;
  double largest = 0.0;
  double turns = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (row > 0 && table.number(row, 1) * table.number(row - 1, 1) < 0.0) ++turns;
    last = std::max(last, table.number(row, 0));
    largest = std::max(largest, std::abs(table.number(row, 1)));
  }
  if (last > *end * (1.0 + kLostMotion))
    remarks.push_back(
        {last > 2.0 * *end ? Rank::wrong : Rank::doubtful, last / *end,
         place.fault(fmt::format("boundary: the motion of '{}' lasts {:.4g} s, and the run ends at {:.4g} s",
                                 place.text, last, *end)),
         fmt::format("steps: duration: {:.4g} s; or check the unit of the file's times: s", last)});
  // Mean acceleration of each interval; where it ends the base keeps its speed.
  double speed = 0.0;
  double most = 0.0;
  for (std::size_t row = 1; row < table.rows(); ++row) {
    speed += 0.5 * (table.number(row, 1) + table.number(row - 1, 1)) *
             (table.number(row, 0) - table.number(row - 1, 0));
    most = std::max(most, std::abs(speed));
  }
  if (last < *end * (1.0 - kLostMotion) && std::abs(speed) > kLostMotion * most)
    remarks.push_back(
        {Rank::doubtful, 2.0,
         place.fault(
             fmt::format("boundary: the motion of '{}' ends at {:.4g} s with {:.3g} mm/s, and the base "
                         "keeps that speed up to {:.4g} s",
                         place.text, last, 1e3 * speed, *end)),
         "let the accelerations of the file add up to no speed (a baseline correction), or end the run there"});
  look_at_drift(place, table, remarks);
  if (largest > kMostAcceleration)
    remarks.push_back(
        {Rank::wrong, largest / kMostAcceleration,
         place.fault(fmt::format("boundary: the motion of '{}' reaches {:.4g} m/s2, {:.2g} times gravity",
                                 place.text, largest, largest / 9.81)),
         "accelerations are in m/s2: check the unit of the file"});
  if (last > 0.0) look_at_waves(scene, place, 0.5 * turns / last, remarks);
}

}  // namespace

void densities(const Scene& scene, Remarks& remarks) {
  if (!scene.the_case().real_time) return;
  for (const SceneRegion& region : scene.regions()) {
    const auto density = scene.quantity({"materials", region.material, "density"}, Dimension::density);
    if (!density || (*density >= kLight && *density <= kHeavy)) continue;
    remarks.push_back(
        {Rank::wrong, std::max(kLight / *density, *density / kHeavy),
         scene.place({"materials", region.material, "density"})
             .fault(
                 fmt::format("material '{}': a density of {:.4g} kg/m3 (ground 1400 to 2300, concrete 2400)",
                             region.material, *density)),
         "check the unit: 2.0 t/m3 is 2000 kg/m3"});
  }
}

void motions(const Scene& scene, Remarks& remarks) {
  const Entry* const boundary = scene.find({"boundary"});
  if (!scene.the_case().real_time || boundary == nullptr) return;
  for (const Entry& item : boundary->items) {
    const Entry* const files = item.find("accelerate");
    if (files == nullptr) continue;
    for (const Entry::Member& member : files->members) {
      try {
        look_at_motion(scene, member.value, remarks);
      } catch (const InputError&) {
        continue;  // the case says so itself
      }
    }
  }
}

}  // namespace polargrain::app
