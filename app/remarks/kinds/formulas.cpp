// SPDX-License-Identifier: GPL-2.0-or-later
// Units inside the formulas of monitors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/remarks/formula_units.hpp"
#include "app/remarks/kinds.hpp"

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
  for (const fem::BoundaryLoad<2>& load : scene.problem().boundary_loads)
    for (const fem::TimeTable* const table : {&load.pressure, &load.traction[0], &load.traction[1]})
      compare(table->largest_magnitude());
  for (const fem::BodyLoad<2>& load : scene.problem().body_loads)
    compare(load.density(scene.body().least).norm() * scene.body().size().y());
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
      const double large = number.value / (20.0 * scene.body().size().maxCoeff());
      if (std::max(small, large) > 1.0)
        remarks.push_back(
            {Rank::wrong, std::max(small, large),
             place.fault(
                 fmt::format("monitor '{}': '{}' is far from every length of the body ({:.3g} m by {:.3g} m)",
                             name, number.text, scene.body().size().x(), scene.body().size().y())),
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

/// How long the place of a monitor is, m: its extent along 1 where forces along 2 are read, and the other way round.
double length_across(const Scene& scene, const coupler::Monitor& monitor) {
  const Eigen::Index i = monitor.dof == fem::Dof::u2 ? 0 : 1;
  double least = 1e300;
  double largest = -1e300;
  for (const int node : scene.mesh().nodes_on(monitor.on)) {
    const double x = scene.mesh().nodes[static_cast<std::size_t>(node)](i);
    least = std::min(least, x);
    largest = std::max(largest, x);
  }
  return largest - least;
}

bool is_about(double value, double other) {
  return std::abs(value - other) <= 0.005 * std::abs(other);
}

/// A reaction over the height in place of the width it acts on, a shortening over the width in place of the height.
void look_at_side(const Scene& scene, const coupler::Entry& place, const coupler::Monitor& formula,
                  const FormulaUnits& units, Remarks& remarks) {
  const auto is_length = [](const FormulaNumber& n) { return n.dimension == coupler::Dimension::length; };
  const Powers pressure{1, -2, 0};
  if (std::ranges::count_if(units.numbers, is_length) != 1 || formula.formula->names().size() != 1 ||
      (units.result != Powers{} && units.result != pressure))
    return;
  const FormulaNumber& number = *std::ranges::find_if(units.numbers, is_length);
  for (const coupler::Monitor& monitor : scene.the_case().monitors) {
    if (monitor.name != formula.formula->names().front() || monitor.kind == coupler::Monitor::Kind::formula ||
        monitor.dof == fem::Dof::w)
      continue;
    const bool reaction = monitor.kind == coupler::Monitor::Kind::reaction;
    if (!reaction && monitor.dof != fem::Dof::u2) continue;  // over the width or the height, as it is meant
    const Eigen::Vector2d size = scene.body().size();
    const double width = size.x();
    const double height = size.y();
    // Only what spans the whole body, so that no other length can be meant.
    const double right = reaction ? length_across(scene, monitor) : height;
    const double other = reaction && monitor.dof == fem::Dof::u1 ? width : reaction ? height : width;
    const double spanned = reaction && monitor.dof == fem::Dof::u1 ? height : width;
    if (is_about(right, other) || (reaction && !is_about(right, spanned)) || !is_about(number.value, other))
      continue;
    remarks.push_back(
        {Rank::doubtful, std::max(right / other, other / right),
         place.fault(fmt::format(
             "monitor '{}': '{}' is the {} of the body, and {} is {:.4g} m", formula.name, number.text,
             is_about(other, height) ? "height" : "width",
             reaction ? fmt::format("the boundary of '{}'", monitor.name) : std::string("its height"),
             right)),
         fmt::format("divide by {:.4g} m, if {} is meant", right, reaction ? "a stress" : "a strain")});
  }
}

/// A side of the body written in millimetres or centimetres without its unit.
void look_at_plain_lengths(const Scene& scene, const coupler::Entry& place, const std::string& name,
                           const FormulaUnits& units, Remarks& remarks) {
  for (const FormulaNumber& number : units.numbers) {
    if (number.has_unit || is_innocent(number.value)) continue;
    for (const double side : {scene.body().size().x(), scene.body().size().y()})
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
  std::map<std::string, Powers> known{{"external_work", {1, 0, 0}}, {"internal_work", {1, 0, 0}}};
  for (const coupler::Monitor& monitor : scene.the_case().monitors) {
    if (monitor.kind != coupler::Monitor::Kind::formula) {
      known[monitor.name] = powers_of(monitor);
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
           "forces are of a metre of thickness, N/m: give each summand the same dimension"});
    look_at_numbers(scene, place, monitor.name, units, remarks);
    look_at_side(scene, place, monitor, units, remarks);
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
