// SPDX-License-Identifier: GPL-2.0-or-later
// Units inside the formulas of monitors.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/remarks/formula_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"
#include "fem/element/dofs.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// Numbers that formulas hold without a unit for reasons of their own: counts, halves, conversions.
bool is_innocent(double value) {
  for (const double known : {0.0, 0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 0.57735,
                             0.70711, 1.41421, 1.73205, 3.14159265358979, 57.2957795130823})
    if (std::abs(value - known) <= 2e-3 * known) return true;
  for (double power = 1e-9; power < 2e9; power *= 1e3)
    if (std::abs(value / power - 1.0) < 1e-9) return true;
  return false;
}

/// How many times a pressure is off the nearest one of the case; 1 where no pressure is known.
double off_pressures(const Scene& scene, double value) {
  double nearest = 1e300;
  const auto compare = [&](double other) {
    if (other != 0.0 && value != 0.0)
      nearest = std::min(nearest, std::max(std::abs(value / other), std::abs(other / value)));
  };
  for (const SceneRegion& region : scene.regions()) {
    compare(Scene::pressure_of(region));
    if (const auto confining =
            scene.quantity({"materials", region.material, "confining"}, coupler::Dimension::pressure))
      compare(*confining);
    if (const auto cohesion =
            scene.quantity({"materials", region.material, "cohesion"}, coupler::Dimension::pressure))
      compare(*cohesion);
    // A stress over a modulus is meant where it is that modulus; others are far above all stresses.
    for (const char* const key : {"E", "G", "Gc"})
      if (const auto modulus =
              scene.quantity({"materials", region.material, key}, coupler::Dimension::pressure))
        if (std::abs(value - *modulus) <= 0.01 * *modulus) return 1.0;
  }
  scene.with_problem([&](const auto& problem) {
    for (const auto& load : problem.boundary_loads) {
      compare(load.pressure.largest_magnitude());
      for (const fem::TimeTable& table : load.traction) compare(table.largest_magnitude());
    }
    for (const auto& load : problem.body_loads)
      compare(load.density(problem.mesh.nodes.front()).norm() * scene.body().height());
  });
  return nearest == 1e300 ? 1.0 : nearest;
}

void look_at_numbers(const Scene& scene, const coupler::Entry& place, const std::string& name,
                     const FormulaUnits& units, Remarks& remarks) {
  constexpr double kFarPressure = 30.0;
  for (const FormulaNumber& number : units.numbers) {
    if (!number.has_unit || number.is_one || number.value == 0.0) continue;
    if (number.dimension == coupler::Dimension::length) {
      // A width of a part of the boundary is some elements at least.
      const double least = std::min(0.02 * scene.body().smaller_side(), 0.2 * scene.body().mean_element);
      const double small = least / number.value;
      const double large = number.value / (20.0 * scene.body().larger_side());
      if (std::max(small, large) > 1.0)
        remarks.push_back(
            {Rank::wrong, std::max(small, large),
             place.fault(fmt::format("monitor '{}': '{}' is far from every length of the body ({:.3g} m)",
                                     name, number.text, fmt::join(scene.body().sides, " m by "))),
             "check its unit"});
    }
    if (number.dimension == coupler::Dimension::pressure)
      if (const double off = off_pressures(scene, number.value); off > kFarPressure)
        remarks.push_back(
            {Rank::wrong, off,
             place.fault(fmt::format("monitor '{}': '{}' is {:.3g} times off every pressure of the case",
                                     name, number.text, off)),
             "check its unit"});
  }
}

bool is_about(double value, double other) {
  return std::abs(value - other) <= 0.005 * std::abs(other);
}

/// A section that forces along one axis act on: a length of the plane, m, an area of space, m2.
struct Section {
  std::string name;
  double size;
};

/// The section of the whole body across an axis.
Section section_of(const Scene& scene, int axis) {
  const std::vector<double>& sides = scene.body().sides;
  if (sides.size() == 2) return axis == 1 ? Section{"width", sides[0]} : Section{"height", sides[1]};
  const int one = axis == 0 ? 1 : 0;
  const int other = axis == 2 ? 1 : 2;
  return {fmt::format("section along {} and {}", one + 1, other + 1),
          sides[static_cast<std::size_t>(one)] * sides[static_cast<std::size_t>(other)]};
}

/// The size of the place of a monitor across its axis: of the box around its nodes.
double size_across(const Scene& scene, const coupler::Monitor& monitor) {
  return scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    fem::BoxAround<dim> box{Cosserat<dim>::Place::Constant(1e300), Cosserat<dim>::Place::Constant(-1e300)};
    for (const int node : problem.mesh.nodes_on(monitor.on)) {
      const auto& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
      box.least = box.least.cwiseMin(place);
      box.largest = box.largest.cwiseMax(place);
    }
    double size = 1.0;
    for (int i = 0; i < dim; ++i)
      if (i != fem::axis_of(monitor.dof)) size *= box.sides()(i);
    return size;
  });
}

/// A box along the axes: areas of other bodies are not known from their sides.
bool is_box(const Scene& scene) {
  return scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    double whole = 1.0;
    for (const double side : scene.body().sides) whole *= side;
    double sum = 0.0;
    for (const double side : scene.body().elements) sum += std::pow(side, dim);
    return is_about(sum, whole) && !problem.mesh.elements.empty();
  });
}

/// The numbers of a formula that are lengths.
struct Lengths {
  double product = 1.0;
  std::string text;  ///< as they are written
  int count = 0;
};

Lengths lengths_in(const FormulaUnits& units) {
  Lengths found;
  for (const FormulaNumber& number : units.numbers) {
    if (number.dimension != coupler::Dimension::length) continue;
    found.text += fmt::format("{}'{}'", found.count++ > 0 ? " times " : "", number.text);
    found.product *= number.value;
  }
  return found;
}

/// A force over another section of the body than the one it acts on.
void look_at_section(const Scene& scene, const coupler::Entry& place, const std::string& name,
                     const Lengths& lengths, const coupler::Monitor& force, Remarks& remarks) {
  const int dim = scene.dimension();
  if (lengths.count != dim - 1 || !is_box(scene)) return;
  const int axis = fem::axis_of(force.dof);
  const double right = size_across(scene, force);
  // Only a place that spans the whole body, so that no other size can be meant.
  if (!is_about(right, section_of(scene, axis).size) || is_about(lengths.product, right)) return;
  for (int other = 0; other < dim; ++other) {
    const Section section = section_of(scene, other);
    if (other == axis || !is_about(lengths.product, section.size)) continue;
    const char* const unit = dim == 2 ? "m" : "m2";
    remarks.push_back({Rank::doubtful, std::max(right / section.size, section.size / right),
                       place.fault(fmt::format(
                           "monitor '{}': {} is the {} of the body, and the boundary of '{}' is {:.4g} {}",
                           name, lengths.text, section.name, force.name, right, unit)),
                       fmt::format("divide by {:.4g} {}, if a stress is meant", right, unit)});
    return;
  }
}

/// A force of space over one length, as in the plane, where forces are of a metre of thickness.
void look_at_thickness(const Scene& scene, const coupler::Entry& place, const std::string& name,
                       const Lengths& lengths, const coupler::Monitor& force, const Powers& result,
                       Remarks& remarks) {
  const bool is_missing = result == Powers{1, -1, 0} || result == Powers{0, 1, 0};
  const double right = size_across(scene, force);
  if (scene.dimension() != 3 || lengths.count != 1 || !is_missing || is_about(lengths.product, right)) return;
  remarks.push_back(
      {Rank::wrong, 10.0,
       place.fault(
           fmt::format("monitor '{}': '{}' is in {}: a force in space acts on an area, and {} is a length",
                       name, place.text, text_of(result), lengths.text)),
       fmt::format("divide by both sides of the boundary of '{}', {:.4g} m2 together", force.name, right)});
}

/// A shortening along the last axis over another side than that along it.
void look_at_height(const Scene& scene, const coupler::Entry& place, const std::string& name,
                    const Lengths& lengths, const coupler::Monitor& displacement, Remarks& remarks) {
  const std::vector<double>& sides = scene.body().sides;
  const double height = scene.body().height();
  if (lengths.count != 1 || fem::axis_of(displacement.dof) + 1 != scene.dimension() ||
      is_about(lengths.product, height))
    return;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    if (!is_about(lengths.product, sides[i])) continue;
    remarks.push_back(
        {Rank::doubtful, std::max(height / sides[i], sides[i] / height),
         place.fault(fmt::format("monitor '{}': {} is the {} of the body, and its height is {:.4g} m", name,
                                 lengths.text,
                                 sides.size() == 2 ? "width" : fmt::format("side along {}", i + 1), height)),
         fmt::format("divide by {:.4g} m, if a strain is meant", height)});
    return;
  }
}

/// The size that a formula divides one force by, m or m2; nothing where it is not of that form.
std::optional<double> divisor_of(const coupler::Expression& formula, const FormulaUnits& units) {
  const auto at = [&](double force) { return formula.evaluate([&](const std::string&) { return force; }); };
  const double one = at(1.0);
  if (!(std::abs(one) > 0.0) || !is_about(at(2.0), 2.0 * one)) return {};
  if (units.result == Powers{1, -2, 0}) return 1.0 / std::abs(one);
  std::optional<double> pressure;
  for (const FormulaNumber& number : units.numbers) {
    if (number.dimension != coupler::Dimension::pressure) continue;
    if (pressure) return {};
    pressure = number.value;
  }
  if (!pressure || units.result != Powers{}) return {};
  return 1.0 / std::abs(one * *pressure);
}

/// A sector of a cylinder carries a half or a quarter of the force.
void look_at_sector(const Scene& scene, const coupler::Entry& place, const coupler::Monitor& formula,
                    const FormulaUnits& units, const coupler::Monitor& force, Remarks& remarks) {
  constexpr double kPolygon = 0.04;  // a polygon for the circle, and pi in three digits
  if (scene.find({"mesh", "cylinder", "sector"}) == nullptr) return;
  const auto size = divisor_of(*formula.formula, units);
  double area = 0.0;
  const fem::Mesh<3>& mesh = scene.problem_of<3>().mesh;
  for (const std::string& name : force.on)
    if (mesh.boundaries.contains(name))
      for (const OutlineSide<3>& side : sides_of(mesh, name)) area += side.size;
  if (!size || area <= 0.0) return;
  for (const double share : {0.25, 0.5, 2.0, 4.0}) {
    if (std::abs(*size / area / share - 1.0) > kPolygon) continue;
    remarks.push_back(
        {Rank::doubtful, std::max(share, 1.0 / share),
         place.fault(
             fmt::format("monitor '{}': '{}' divides by {:.4g} m2, and the boundary of '{}' has {:.4g} m2 in "
                         "this sector: {:g} times",
                         formula.name, place.text, *size, force.name, area, share)),
         fmt::format("divide by {:.4g} m2, if a stress is meant", area)});
    return;
  }
}

/// Lengths that a reaction or a displacement is divided by, against those of the body.
void look_at_sizes(const Scene& scene, const coupler::Entry& place, const coupler::Monitor& formula,
                   const FormulaUnits& units, Remarks& remarks) {
  if (formula.formula->names().size() != 1) return;
  const Lengths lengths = lengths_in(units);
  const bool is_ratio = units.result == Powers{} || units.result == Powers{1, -2, 0};
  for (const coupler::Monitor& monitor : scene.the_case().monitors) {
    if (monitor.name != formula.formula->names().front() || fem::is_rotation(monitor.dof)) continue;
    if (monitor.kind == coupler::Monitor::Kind::reaction) {
      look_at_sector(scene, place, formula, units, monitor, remarks);
      if (is_ratio) look_at_section(scene, place, formula.name, lengths, monitor, remarks);
      look_at_thickness(scene, place, formula.name, lengths, monitor, units.result, remarks);
    }
    if (monitor.kind == coupler::Monitor::Kind::displacement && is_ratio)
      look_at_height(scene, place, formula.name, lengths, monitor, remarks);
  }
}

/// A side of the body written in millimetres or centimetres without its unit.
void look_at_plain_lengths(const Scene& scene, const coupler::Entry& place, const std::string& name,
                           const FormulaUnits& units, Remarks& remarks) {
  for (const FormulaNumber& number : units.numbers) {
    if (number.has_unit || is_innocent(number.value)) continue;
    for (const double side : scene.body().sides)
      for (const auto& [unit, share] : {std::pair{"mm", 1e-3}, std::pair{"cm", 1e-2}}) {
        if (!is_about(share * number.value, side)) continue;
        remarks.push_back({Rank::wrong, 1.0 / share,
                           place.fault(fmt::format(
                               "monitor '{}': '{}' in '{}' has no unit, and a side of the body is {} {}",
                               name, number.text, place.text, number.text, unit)),
                           fmt::format("write '{} {}', or '{:.4g} m'", number.text, unit, side)});
        return;
      }
  }
}

}  // namespace

void formulas(const Scene& scene, Remarks& remarks) {
  const int work = scene.dimension() - 2;  // J/m in the plane, J in space
  std::map<std::string, Powers> known{{"external_work", {1, work, 0}}, {"internal_work", {1, work, 0}}};
  for (const coupler::Monitor& monitor : scene.the_case().monitors) {
    if (monitor.kind != coupler::Monitor::Kind::formula) {
      known[monitor.name] = powers_of(monitor, scene.dimension());
      continue;
    }
    const coupler::Entry& place = scene.place({"monitors", monitor.name});
    const FormulaUnits units =
        units_of_formula(place.text, [&](const std::string& name) { return known[name]; });
    known[monitor.name] = units.result;
    if (!units.clash.empty())
      remarks.push_back(
          {Rank::wrong, 10.0,
           place.fault(fmt::format("monitor '{}': '{}' adds {}", monitor.name, place.text, units.clash)),
           scene.dimension() == 2
               ? "forces are of a metre of thickness, N/m: give each summand the same dimension"
               : "give each summand the same dimension"});
    look_at_numbers(scene, place, monitor.name, units, remarks);
    look_at_sizes(scene, place, monitor, units, remarks);
    look_at_plain_lengths(scene, place, monitor.name, units, remarks);
    const bool any_unit =
        std::ranges::any_of(units.numbers, [](const FormulaNumber& number) { return number.has_unit; });
    const auto plain = std::ranges::find_if(units.numbers, [](const FormulaNumber& number) {
      return !number.has_unit && !is_innocent(number.value);
    });
    if (any_unit && plain != units.numbers.end() && units.result != Powers{})
      remarks.push_back(
          {Rank::wrong, 10.0,
           place.fault(fmt::format(
               "monitor '{}': '{}' in '{}' has no unit, and another number has: the value is in {}",
               monitor.name, plain->text, place.text, text_of(units.result))),
           fmt::format("write its unit: '{} kPa', for example", plain->text)});
  }
}

}  // namespace polargrain::app
