// SPDX-License-Identifier: GPL-2.0-or-later
// Steps in real time: masses, and motions that are given by their accelerations.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "app/remarks/base_motions.hpp"
#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/weights.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;

constexpr double kLight = 300.0;            // kg/m^3
constexpr double kHeavy = 12e3;             // lead
constexpr double kElementsOfAWave = 4.0;    // of elements with middle nodes
constexpr double kLostMotion = 0.02;        // of a motion
constexpr double kMostAcceleration = 50.0;  // m/s2, five times gravity: an earthquake has 0.1 to 10
constexpr double kMostInGravity = 1.5;      // the largest number that a record in g has

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

/// Whether a text has the word g with no number before it: "in units of g", "quake_g.csv"; "0.1 g" is an intensity.
bool names_gravity(const std::string& text) {
  char before = ' ';  // the last one that is no space
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto is_letter = [&](std::size_t k) {
      return k < text.size() && std::isalpha(static_cast<unsigned char>(text[k])) != 0;
    };
    const bool is_word = !is_letter(at + 1) && (at == 0 || !is_letter(at - 1));
    if ((text[at] == 'g' || text[at] == 'G') && is_word &&
        std::isdigit(static_cast<unsigned char>(before)) == 0)
      return true;
    if (text[at] != ' ') before = text[at];
  }
  return false;
}

/// A record in g whose numbers are taken for m/s2 is ten times too weak. Names of columns that say so are a fault.
void look_at_unit(const Entry& place, const CsvTable& table, double largest, Remarks& remarks) {
  const bool file_says = names_gravity(std::filesystem::path(place.text).filename().string());
  if (largest >= kMostInGravity || !(file_says || std::ranges::any_of(table.comments(), names_gravity)))
    return;
  remarks.push_back(
      {Rank::wrong, kGravity,
       place.fault(fmt::format(
           "boundary: the motion of '{}' reaches {:.3g} m/s2, {:.2g} times gravity, and {} of the "
           "file says 'g'",
           place.text, largest, largest / kGravity, file_says ? "the name" : "a comment")),
       "accelerations are in m/s2: multiply those in g by 9.81"});
}

void look_at_motion(const Scene& scene, const Entry& place, const CsvTable& table, Remarks& remarks) {
  const auto end = scene.end_time();
  if (!end || table.rows() < 2) return;
  double last = 0.0;
  double turns = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (row > 0 && table.number(row, 1) * table.number(row - 1, 1) < 0.0) ++turns;
    last = std::max(last, table.number(row, 0));
  }
  const double largest = largest_acceleration(table);
  look_at_unit(place, table, largest, remarks);
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
                                 place.text, largest, largest / kGravity)),
         "accelerations are in m/s2: check the unit of the file"});
  if (last > 0.0) look_at_waves(scene, place, 0.5 * turns / last, remarks);
}

/// The weight of a region against that of its density. Submerged ground has the mass of its water and not its weight; in a
/// centrifuge all weighs many times as much.
void look_at_mass(const Scene& scene, const SceneRegion& region, Remarks& remarks) {
  constexpr double kSlackOfMass = 0.15;
  constexpr double kSubmerged = 14e3;  // N/m^3 at most
  constexpr double kCentrifuge = 5.0;  // times gravity at least
  const double density = scene.with_problem([&](const auto& problem) {
    const auto found = problem.densities.find(region.name);
    return found == problem.densities.end() ? 0.0 : found->second;
  });
  const double weight = weight_at_start(scene, region.name);
  const double of_mass = kGravity * density;
  const double lifted = of_mass - 1e3 * kGravity;
  if (!(weight > 0.0 && density >= kLight && density <= kHeavy) || scene.find({"water"}) != nullptr ||
      std::abs(of_mass - weight) <= kSlackOfMass * weight || weight > kCentrifuge * of_mass ||
      (weight < kSubmerged && std::abs(lifted - weight) <= kSlackOfMass * weight))
    return;
  remarks.push_back(
      {Rank::doubtful, std::max(of_mass / weight, weight / of_mass),
       scene.place({"materials", region.material, "density"})
           .fault(fmt::format(
               "material '{}': a density of {:.4g} kg/m3 weighs {:.3g} kN/m3, and region '{}' has {:.3g} kN/m3 below body",
               region.material, density, 1e-3 * of_mass, region.name, 1e-3 * weight)),
       fmt::format("a weight of {:.3g} kN/m3 has a density of {:.0f} kg/m3", 1e-3 * weight,
                   weight / kGravity)});
}

}  // namespace

void densities(const Scene& scene, Remarks& remarks) {
  if (!scene.the_case().real_time) return;
  for (const SceneRegion& region : scene.regions()) look_at_mass(scene, region, remarks);
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
  for_each_base_motion(scene, [&](const Entry::Member& member, const CsvTable& table) {
    look_at_motion(scene, member.value, table, remarks);
  });
}

}  // namespace polargrain::app
