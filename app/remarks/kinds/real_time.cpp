// SPDX-License-Identifier: GPL-2.0-or-later
// Steps in real time: masses, and motions that are given by their accelerations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"
#include "common/csv_table.hpp"
#include "common/error.hpp"
#include "coupler/case/data_files.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;

constexpr double kLight = 300.0;            // kg/m^3
constexpr double kHeavy = 12e3;             // lead
constexpr double kLost = 0.02;              // of a motion
constexpr double kMostAcceleration = 50.0;  // m/s2, five times gravity: an earthquake has 0.1 to 10

void look_at_motion(const Scene& scene, const Entry& place, Remarks& remarks) {
  const auto end = scene.end_time();
  const auto file = coupler::find_data_file(place.text, scene.the_case().file.parent_path());
  if (!end || !file) return;
  const CsvTable table(*file);
  if (table.rows() < 2) return;
  double last = 0.0;
  double largest = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    last = std::max(last, table.number(row, 0));
    largest = std::max(largest, std::abs(table.number(row, 1)));
  }
  if (last > *end * (1.0 + kLost))
    remarks.push_back(
        {last > 2.0 * *end ? Rank::wrong : Rank::doubtful, last / *end,
         place.fault(fmt::format("boundary: the motion of '{}' lasts {:.4g} s, and the run ends at {:.4g} s",
                                 place.text, last, *end)),
         fmt::format("steps: duration: {:.4g} s; or check the unit of the file's times: s", last)});
  if (largest > kMostAcceleration)
    remarks.push_back(
        {Rank::wrong, largest / kMostAcceleration,
         place.fault(fmt::format("boundary: the motion of '{}' reaches {:.4g} m/s2, {:.2g} times gravity",
                                 place.text, largest, largest / 9.81)),
         "accelerations are in m/s2: check the unit of the file"});
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
