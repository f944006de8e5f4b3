// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers of laws in closed form against each other and against the loads.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "app/remarks/bounds_of_laws.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/outline.hpp"
#include "app/remarks/stress_scale.hpp"
#include "fem/material/cone_matching.hpp"

namespace polargrain::app {
namespace {

/// Of Poisson's ratio; zero itself is taken for meant.
constexpr double kLeastPoisson = 0.08;
constexpr double kDegreeOfFriction = std::numbers::pi / 180.0;

/// The largest value of a key: of a number, a list, or a table [[shear, value], ...].
std::optional<double> largest_value(const Scene& scene, const SceneRegion& region, const char* key,
                                    coupler::Dimension dimension) {
  const coupler::Entry* const entry = scene.find({"materials", region.material, key});
  if (entry == nullptr) return {};
  if (entry->kind == coupler::Entry::Kind::scalar) return coupler::parse_quantity(entry->text, dimension);
  std::optional<double> largest;
  for (const coupler::Entry& item : entry->items) {
    const coupler::Entry& value = item.items.size() == 2 ? item.items[1] : item;
    if (const auto number = coupler::parse_quantity(value.text, dimension))
      largest = std::max(largest.value_or(*number), *number);
  }
  return largest;
}

/// Whether a law without a strength has the E of steel or of concrete, which loads of soil hardly strain.
bool is_of_a_structure(const Scene& scene, const SceneRegion& region, double young) {
  const bool steel = young >= 150e9 && young <= 230e9;  // Pa
  const bool concrete = young >= 20e9 && young <= 50e9;
  return (steel || concrete) && !is_strong(scene, region);
}

}  // namespace

void stiffness_of_laws(const Scene& scene, Remarks& remarks) {
  const double scale = stress_scale(scene);
  const double strain_of_run = scene.strain_of_run();
  for (const SceneRegion& region : scene.regions()) {
    const auto young = scene.quantity({"materials", region.material, "E"}, coupler::Dimension::pressure);
    if (region.cell != nullptr || !young || scale <= 0.0) continue;
    const double strain = scale / *young;
    const coupler::Entry& place = scene.place({"materials", region.material, "E"});
    if (strain > kMostElasticStrain)
      remarks.push_back(
          {Rank::wrong, strain / kMostElasticStrain,
           place.fault(fmt::format(
               "material '{}': E is {:.4g} kPa, and loads, weight and initial stress reach {:.4g} kPa: that "
               "alone is an elastic strain of {:.3g} %",
               region.material, 1e-3 * *young, 1e-3 * scale, 100.0 * strain)),
           "check the unit of E (soils: 5 to 500 MPa) and of the loads"});
    else if (strain < kLeastElasticStrain && !is_of_a_structure(scene, region, *young))
      remarks.push_back(
          {Rank::wrong, kLeastElasticStrain / strain,
           place.fault(fmt::format(
               "material '{}': E is {:.4g} GPa, and loads, weight and initial stress reach {:.4g} kPa: an elastic "
               "strain of {:.1e}",
               region.material, 1e-9 * *young, 1e-3 * scale, strain)),
           "check the unit of E (soils: 5 to 500 MPa) and of the loads"});
    const auto cohesion = largest_value(scene, region, "cohesion", coupler::Dimension::pressure);
    const double reached = std::max(scale, *young * strain_of_run);
    if (cohesion && *cohesion > kMostCohesion * reached)
      remarks.push_back(
          {Rank::doubtful, *cohesion / reached,
           scene.place({"materials", region.material, "cohesion"})
               .fault(fmt::format(
                   "material '{}': a cohesion of {:.4g} kPa against stresses of {:.4g} kPa: the body stays elastic",
                   region.material, 1e-3 * *cohesion, 1e-3 * reached)),
           "check the unit of the cohesion, or use 'model: elastic'"});
  }
}

namespace {

/// The cone that triaxial compression gives is far stronger in plane strain.
void look_at_plane_strain(const Scene& scene, Remarks& remarks) {
  if (!scene.the_case().space) return;
  const int axis = axis_of_plane_strain(*scene.the_case().space);
  if (axis < 0) return;
  for (const SceneRegion& region : scene.regions()) {
    const auto friction = largest_value(scene, region, "friction_angle", coupler::Dimension::angle);
    if (region.cell != nullptr || !friction || !(*friction > 0.0) ||
        scene.find({"materials", region.material, "match"}) != nullptr)
      continue;
    const auto dilatancy = largest_value(scene, region, "dilatancy_angle", coupler::Dimension::angle);
    const double degrees = *friction / kDegreeOfFriction;
    const auto there = fem::plane_strain_from_cone(fem::matched_cone(
        {degrees, dilatancy.value_or(0.0) / kDegreeOfFriction, 0.0}, fem::ConeMatch::triaxial_compression));
    remarks.push_back(
        {Rank::doubtful, there ? there->friction_angle / degrees : 10.0,
         scene.place({"materials", region.material, "friction_angle"})
             .fault(fmt::format(
                 "material '{}': {:.3g} deg hold in triaxial compression, the default in space, and both ends along {} are held: in "
                 "plane strain this cone has {}",
                 region.material, degrees, axis + 1,
                 there ? fmt::format("{:.3g} deg", there->friction_angle) : std::string("no limit"))),
         "match: plane_strain; or say 'match: triaxial_compression' if it is meant"});
  }
}

}  // namespace

void strength_of_laws(const Scene& scene, Remarks& remarks) {
  look_at_plane_strain(scene, remarks);
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell != nullptr) continue;
    if (const auto poisson = scene.quantity({"materials", region.material, "nu"}, coupler::Dimension::number);
        poisson && *poisson > 0.0 && *poisson < kLeastPoisson)
      remarks.push_back({Rank::doubtful, kLeastPoisson / *poisson,
                         scene.place({"materials", region.material, "nu"})
                             .fault(fmt::format("material '{}': nu is {:.3g} (ground: 0.15 to 0.45)",
                                                region.material, *poisson)),
                         "check the decimal point; nu decides the stress against walls"});
    const auto friction = largest_value(scene, region, "friction_angle", coupler::Dimension::angle);
    const coupler::Entry& place = scene.place({"materials", region.material, "friction_angle"});
    if (friction && *friction > 55.0 * kDegreeOfFriction)
      remarks.push_back(
          {Rank::doubtful, *friction / (50.0 * kDegreeOfFriction),
           place.fault(fmt::format("material '{}': a friction angle of {:.3g} deg (sand: 28 to 50)",
                                   region.material, *friction / kDegreeOfFriction)),
           "check the number and its unit (deg, rad)"});
    else if (friction && *friction > 0.0 && *friction < 5.0 * kDegreeOfFriction)
      remarks.push_back(
          {Rank::wrong, 5.0 * kDegreeOfFriction / *friction,
           place.fault(fmt::format("material '{}': a friction angle of {:.3g} deg (sand: 28 to 50)",
                                   region.material, *friction / kDegreeOfFriction)),
           "check the unit: 0.6 rad is 34 deg; for undrained clay write 0"});
    const auto shear =
        scene.quantity({"materials", region.material, "hardening_shear"}, coupler::Dimension::number);
    if (shear && *shear > 1.0)
      remarks.push_back(
          {Rank::doubtful, *shear,
           scene.place({"materials", region.material, "hardening_shear"})
               .fault(fmt::format(
                   "material '{}': hardening_shear: strength changes over a plastic shear of {:.3g} %",
                   region.material, 100.0 * *shear)),
           "it is a strain: 0.1 or '10 %' is usual"});
  }
}

namespace {

/// The text of the largest value of a load; empty where one of its values has a unit, or it was set by an option.
std::string plain_text_of(const coupler::Entry& entry) {
  if (entry.line == 0) return {};
  if (entry.kind == coupler::Entry::Kind::scalar)
    return coupler::is_plain_number(entry.text) ? entry.text : std::string();
  std::string text;
  double largest = 0.0;
  for (const coupler::Entry& item : entry.items) {
    if (item.items.size() != 2) return {};
    const auto value = coupler::parse_quantity(item.items[1].text, coupler::Dimension::pressure);
    if (!value || !coupler::is_plain_number(item.items[1].text)) return {};
    if (std::abs(*value) <= largest) continue;
    largest = std::abs(*value);
    text = item.items[1].text;
  }
  return text;
}

void look_at_plain(const std::string& what, const coupler::Entry* entry, double value, double scale,
                   Remarks& remarks) {
  constexpr double kTiny = 0.02;
  if (value == 0.0 || entry == nullptr || value > kTiny * scale) return;
  const std::string text = plain_text_of(*entry);
  if (text.empty()) return;
  remarks.push_back(
      {Rank::wrong, scale / value,
       entry->fault(fmt::format(
           "{}: '{}' has no unit and is {:g} Pa, {:.2g} % of the stresses of this case ({:.4g} kPa)", what,
           text, value, 100.0 * value / scale, 1e-3 * scale)),
       fmt::format("write '{0} kPa', or '{0} Pa' if you mean pascals", text)});
}

}  // namespace

void plain_loads(const Scene& scene, Remarks& remarks) {
  constexpr double kOfModulus = 1e-3;  // below it ground strains by less than 2e-5
  constexpr double kMost = 50e3;       // Pa: a kilopascal and more may be meant, however stiff the body
  double scale = stress_scale(scene);
  for (const SceneRegion& region : scene.regions()) {
    scale = std::max(scale, Scene::pressure_of(region));
    if (const auto young = scene.quantity({"materials", region.material, "E"}, coupler::Dimension::pressure))
      scale = std::max(scale, std::min(kOfModulus * *young, kMost));
  }
  scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) {
      look_at_plain(fmt::format("boundary: pressure on '{}'", load.on),
                    scene.boundary_value(load.on, "pressure"), load.pressure.largest_magnitude(), scale,
                    remarks);
      const coupler::Entry* const traction = scene.boundary_value(load.on, "traction");
      if (traction == nullptr) continue;
      for (std::size_t i = 0; i < dim; ++i)
        look_at_plain(fmt::format("boundary: traction along {} on '{}'", i + 1, load.on),
                      traction->find(fmt::format("u{}", i + 1)), load.traction[i].largest_magnitude(), scale,
                      remarks);
    }
  });
}

namespace {

/// Times at which the steps end, or an even few where the run finds the time.
std::vector<double> times_of(const Scene& scene) {
  if (!scene.end_time()) return {0.0, 0.5, 1.0};
  std::vector<double> times{0.0};
  for (const coupler::StepTarget& target : scene.the_case().plan) times.push_back(target.amount);
  return times;
}

template <int dim>
using Loads = std::vector<const fem::BoundaryLoad<dim>*>;

/// The loads on each side, whatever the names of their boundaries.
template <int dim>
std::map<std::pair<int, int>, Loads<dim>> loads_on_sides(const fem::Problem<dim>& problem) {
  std::map<std::pair<int, int>, Loads<dim>> loads;
  for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads)
    for (const fem::BoundarySide& side : problem.mesh.boundaries.at(load.on))
      loads[{side.element, side.side}].push_back(&load);
  return loads;
}

/// The sides under the same loads.
template <int dim>
struct Part {
  double size = 0.0;                                                     ///< of all
  typename Cosserat<dim>::Place normals = Cosserat<dim>::Place::Zero();  ///< sum, each times its size
};

/// The mean tension along the normals of a boundary, Pa.
template <int dim>
double pull_on(const std::map<Loads<dim>, Part<dim>>& parts, double time) {
  double pull = 0.0;
  double size = 0.0;
  for (const auto& [loads, part] : parts) {
    size += part.size;
    for (const fem::BoundaryLoad<dim>* const load : loads) {
      pull -= part.size * load->pressure.at(time);
      for (std::size_t i = 0; i < dim; ++i)
        pull += load->traction[i].at(time) * part.normals(static_cast<Eigen::Index>(i));
    }
  }
  return size > 0.0 ? pull / size : 0.0;
}

template <int dim>
void look_at_pulls(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  constexpr double kRounding = 1e-6;
  std::set<std::string> seen;
  const auto loads = loads_on_sides(problem);
  for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) {
    if (!seen.insert(load.on).second) continue;
    const std::vector<OutlineSide<dim>> sides = sides_of(problem.mesh, load.on);
    std::map<Loads<dim>, Part<dim>> parts;
    for (const OutlineSide<dim>& side : sides) {
      Part<dim>& part = parts[loads.at({side.element, side.number})];
      part.size += side.size;
      part.normals += side.size * side.normal;
    }
    double pull = 0.0;
    for (const double time : times_of(scene)) pull = std::max(pull, pull_on<dim>(parts, time));
    if (pull <= kRounding * stress_scale(scene)) continue;
    const bool grains = std::ranges::any_of(
        sides, [&](const OutlineSide<dim>& side) { return scene.region_of(side.element).cell != nullptr; });
    double cohesion = 0.0;
    for (const SceneRegion& region : scene.regions())
      cohesion = std::max(cohesion, largest_value(scene, region, "cohesion", coupler::Dimension::pressure)
                                        .value_or(is_strong(scene, region) ? 0.0 : 1e300));
    if (!grains && pull <= cohesion) continue;
    const coupler::Entry* const pressure = scene.boundary_value(load.on, "pressure");
    const coupler::Entry* const entry =
        pressure != nullptr ? pressure : scene.boundary_value(load.on, "traction");
    remarks.push_back(
        {Rank::wrong, 1e3,
         (entry != nullptr ? *entry : scene.place({"boundary"}))
             .fault(fmt::format(
                 "boundary: a {} of {:.4g} kPa on '{}' pulls, and the material there has no such strength in tension",
                 pressure != nullptr ? "pressure" : "traction", (pressure != nullptr ? -1e-3 : 1e-3) * pull,
                 load.on)),
         pressure != nullptr
             ? "a pressure pushes into the body where it is positive: remove the sign"
             : "a traction acts along the axes, whatever the boundary looks to: turn its sign, or give a pressure"});
  }
}

}  // namespace

void tension(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_pulls(scene, problem, remarks); });
}

}  // namespace polargrain::app
