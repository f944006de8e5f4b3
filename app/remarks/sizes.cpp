// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/base_motions.hpp"
#include "app/remarks/in_units.hpp"
#include "app/remarks/lengths.hpp"
#include "coupler/case/parts.hpp"

namespace polargrain::app {
namespace {

/// Measured, cases/biaxial: 19,244 evaluations in 23 steps at 200 points, of 120 DEM steps for a strain of 1e-3 at the default rate.
/// Grain by grain: the loops with AVX2, what belongs to an evaluation included; the tangents of 400 discs, 1,000 spheres.
constexpr double kIterations = 5.0;
constexpr double kStepsOfStrain = 120.0 / 1e-3;
constexpr double kDefaultRate = 6e-4;
constexpr double kSecondsOfDisc = 15e-9;
constexpr double kSecondsOfSphere = 40e-9;
constexpr double kSecondsOfTangentOfDisc = 1.3e-6;
constexpr double kSecondsOfTangentOfSphere = 14e-6;
/// Measured with H20R, H8 and H8R of an elastoplastic law, the solution of the equations included: 13 to 30 kB, directly and by
/// iterations (bench/space_solve_bench.cpp).
constexpr double kBytesOfUnknownInSpace = 25e3;
/// Measured (RSS), 13,824 boxes of 1,000 spheres and 3,200 of 400 discs: a grain of a box that stays with its worker, and twice its
/// state with the coordinator, which has the last one and the one before while boxes are read out.
constexpr double kBytesOfResidentSphere = 0.7e3;
constexpr double kBytesOfResidentDisc = 0.4e3;
constexpr double kBytesOfStatesOfSphere = 0.45e3;
constexpr double kBytesOfStatesOfDisc = 0.25e3;
/// Below, no machine lacks it.
constexpr double kBytesWorthTelling = 1e9;

std::string seconds(double s) {
  if (s < 120.0) return fmt::format("{:.0f} s", std::max(1.0, s));
  return s < 7200.0 ? fmt::format("{:.0f} min", s / 60.0) : fmt::format("{:.1f} h", s / 3600.0);
}

std::string of_region(const Scene& scene, const SceneRegion& region) {
  std::string text = fmt::format("region '{}' ({})", region.name, region.material);
  const auto length = scene.quantity({"materials", region.material, "lc"}, coupler::Dimension::length);
  const double element = usual_element(scene, region);
  text += fmt::format(": elements of {}", metres(element));
  if (length && *length > 0.0) text += fmt::format(", {:.3g} lc", element / *length);
  if (region.cell == nullptr) return text + "\n";
  const double diameter = 2.0 * region.cell->packing.mean_radius();
  if (length) text += fmt::format("; lc {:.3g} mean diameters ({})", *length / diameter, metres(diameter));
  text += fmt::format("; {} grains a cell", region.cell->packing.grains.size());
  if (region.packing != nullptr && region.packing->elastic_strain() > 0.0)
    text += fmt::format("; a step strains the body by {:.2g}, {:.2g} elastic strains of the packing",
                        scene.strain_of_step(), scene.strain_of_step() / region.packing->elastic_strain());
  return text + "\n";
}

std::string of_motions(const Scene& scene) {
  std::string text;
  for_each_base_motion(scene, [&](const coupler::Entry::Member& member, const CsvTable& motion) {
    if (motion.rows() == 0) return;
    const double largest = largest_acceleration(motion);
    text +=
        fmt::format("motion of '{}' along {}: {:.4g} s, at most {:.3g} m/s2 ({:.3g} g)\n", member.value.text,
                    member.key, motion.number(motion.rows() - 1, 0), largest, largest / kGravity);
  });
  return text;
}

/// DEM steps of a box that stays with its worker through all explicit steps; 0 where boxes are asked.
double dem_steps_of_resident(const Scene& scene) {
  const coupler::Case& the_case = scene.the_case();
  if (!the_case.is_explicit() || the_case.is_automatic() || the_case.real_time) return 0.0;
  double steps = 0.0;
  for (const coupler::StepTarget& target : the_case.plan) steps += target.explicit_steps;
  return steps * coupler::dem_steps_of(scene.document());
}

/// Steps in real time of 0.25 h / c, and DEM steps of 0.36 d / c: measured on elements with middle nodes and on discs.
std::string of_real_time(const Scene& scene) {
  constexpr double kStep = 0.25;
  constexpr double kDemStep = 0.36;
  const double duration = scene.the_case().plan.back().amount;
  double steps = 0.0;
  double dem_steps = 0.0;
  double core_seconds = 0.0;
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell == nullptr || region.packing == nullptr) continue;
    const coupler::NetworkModuli& moduli = region.packing->moduli;
    const double confined = 2.0 * moduli.shear * (1.0 - moduli.poisson) / (1.0 - 2.0 * moduli.poisson);
    const double density = scene.the_case().problem.densities.at(region.name);
    if (!(confined > 0.0)) continue;
    const double speed = std::sqrt(confined / density);
    const Packing& packing = region.cell->packing;
    const double of_box = duration * speed / (kDemStep * 2.0 * packing.mean_radius());
    double points = 0.0;
    for (const int element : region.elements)
      points += static_cast<double>(
          scene.mesh().elements[static_cast<std::size_t>(element)].type->quadrature.size());
    steps = std::max(steps, duration * speed / (kStep * usual_element(scene, region)));
    dem_steps = std::max(dem_steps, of_box);
    core_seconds += points * of_box * kSecondsOfDisc * static_cast<double>(packing.grains.size());
  }
  if (steps == 0.0) return {};
  return fmt::format(
      "to be expected: some {:.2g} explicit steps, {:.2g} DEM steps of each box, {} of one core\n", steps,
      dem_steps, seconds(core_seconds));
}

/// Two digits.
std::string gigabytes(double bytes) {
  constexpr double kTen = 1e10;
  return bytes < kTen ? fmt::format("{:.2g}", 1e-9 * bytes) : fmt::format("{:.0f}", 1e-9 * bytes);
}

std::string of_memory(const Scene& scene, const Expectation& expected) {
  std::string boxes;
  if (expected.bytes_of_boxes >= kBytesWorthTelling)
    boxes = fmt::format("up to {} GB for the boxes", gigabytes(expected.bytes_of_boxes));
  if (scene.dimension() == 2) return boxes.empty() ? boxes : boxes + "\n";
  std::size_t points = 0;
  std::size_t cells = 0;
  const std::size_t nodes = scene.with_problem([](const auto& problem) { return problem.mesh.nodes.size(); });
  for (const SceneRegion& region : scene.regions()) {
    points += scene.points_of(region);
    if (region.cell != nullptr) cells += scene.points_of(region);
  }
  return fmt::format("{} points, of which {} have boxes of grains; some {} GB for the elements{}{}\n", points,
                     cells,
                     gigabytes(kBytesOfUnknownInSpace * Cosserat<3>::dofs * static_cast<double>(nodes)),
                     boxes.empty() ? "" : ", ", boxes);
}

}  // namespace

std::string Expectation::work() const {
  std::string words;
  if (evaluations > 0.0) words = fmt::format("{:.2g} evaluations of cells", evaluations);
  if (dem_steps_of_box > 0.0)
    words += fmt::format("{}{:.2g} DEM steps of each box", words.empty() ? "" : ", ", dem_steps_of_box);
  return words;
}

Expectation expectation_of(const Scene& scene) {
  Expectation sum;
  const double resident = dem_steps_of_resident(scene);
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell == nullptr) continue;
    const auto points = static_cast<double>(scene.points_of(region));
    const coupler::Entry* const model = scene.find({"materials", region.material, "model"});
    const bool spheres = region.cell->packing.dimension == 3;
    const double of_step = spheres ? kSecondsOfSphere : kSecondsOfDisc;
    const auto grains = static_cast<double>(region.cell->packing.grains.size());
    sum.bytes_of_boxes += points * grains * (spheres ? kBytesOfStatesOfSphere : kBytesOfStatesOfDisc);
    const bool stays = model != nullptr && model->text == "cell" && scene.the_case().is_explicit();
    if (stays)
      sum.bytes_of_boxes += points * grains * (spheres ? kBytesOfResidentSphere : kBytesOfResidentDisc);
    if (stays && resident > 0.0) {
      sum.dem_steps_of_box = resident;
      sum.core_seconds += points * resident * grains * of_step;
      continue;
    }
    const bool informed = model != nullptr && model->text == "informed";
    const double evaluations = points * scene.the_case().steps() * (informed ? 1.0 : kIterations);
    const CellControl& control = region.cell->control;
    const double dem_steps =
        std::max<double>(control.least_steps, scene.strain_of_run() / std::max(1, scene.the_case().steps()) *
                                                  kStepsOfStrain * kDefaultRate / control.inertial_number);
    const bool has_tangents = model == nullptr || model->text != "cell" ||
                              (!scene.the_case().is_explicit() && control.tangent != CellTangent::secant);
    const double tangent = spheres ? kSecondsOfTangentOfSphere : kSecondsOfTangentOfDisc;
    sum.evaluations += evaluations;
    sum.core_seconds += evaluations * grains * (dem_steps * of_step + (has_tangents ? tangent : 0.0));
  }
  return sum;
}

std::string sizes_text(const Scene& scene) {
  std::string sides;
  for (const double side : whole_sides(scene)) sides += (sides.empty() ? "" : " by ") + metres(side);
  if (const coupler::Entry* const sector = scene.find({"mesh", "cylinder", "sector"});
      sector != nullptr && sector->text != "whole")
    sides += fmt::format(" (the mesh is a {} of it)", sector->text);
  std::string text =
      fmt::format("body {}, elements {} on average; largest movement {}, {:.3g} % of the smaller side\n",
                  sides, metres(scene.body().mean_element), metres(scene.largest_movement()),
                  100.0 * scene.largest_movement() / smaller_whole_side(scene));
  if (const double spread = scene.the_case().spread; spread > 0.0)
    text += fmt::format("slips are spread over {}\n", metres(spread));
  for (const SceneRegion& region : scene.regions()) text += of_region(scene, region);
  const Expectation expected = expectation_of(scene);
  if (scene.the_case().real_time)
    return text + of_motions(scene) + of_real_time(scene) + of_memory(scene, expected);
  if (const std::string work = expected.work(); !work.empty())
    text += fmt::format("to be expected: some {}{}, {} of one core\n", work,
                        expected.evaluations > 0.0 ? " at most" : "", seconds(expected.core_seconds));
  return text + of_memory(scene, expected);
}

}  // namespace polargrain::app
