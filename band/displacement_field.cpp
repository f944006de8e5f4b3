// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/displacement_field.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "band/local_strain.hpp"
#include "common/csv_table.hpp"

namespace polargrain::band {
namespace {

using Place = std::pair<double, double>;

Place place_of(const Eigen::Vector2d& position) {
  return {position.x(), position.y()};
}

/// A displacement of a cell; not-a-number where it is empty or says so.
double displacement_in(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string& text = table.cell(row, column);
  if (text.empty() || text == "nan" || text == "NaN" || text == "NAN")
    return std::numeric_limits<double>::quiet_NaN();
  return table.number(row, column);
}

}  // namespace

DisplacementField read_displacement_field(const std::filesystem::path& file, const FieldUnits& units) {
  const CsvTable table(file);
  const std::size_t x = table.column("x");
  const std::size_t y = table.column("y");
  const std::size_t u = table.column("u");
  const std::size_t v = table.column("v");
  const Eigen::Vector2d scale(units.length, units.y_down ? -units.length : units.length);
  DisplacementField field;
  std::map<Place, std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Eigen::Vector2d written(table.number(row, x), table.number(row, y));
    const auto [before, is_new] = rows.emplace(place_of(written), row);
    if (!is_new)
      table.fail(
          table.line_of(row),
          fmt::format("the place x = {:g}, y = {:g} stands already in line {}; each belongs there once",
                      written.x(), written.y(), table.line_of(before->second)));
    Eigen::Vector2d displacement(displacement_in(table, row, u), displacement_in(table, row, v));
    if (displacement.hasNaN()) {
      displacement.setConstant(std::numeric_limits<double>::quiet_NaN());
      ++field.missing;
    }
    field.positions.emplace_back(scale.cwiseProduct(written));
    field.displacements.emplace_back(scale.cwiseProduct(displacement));
    if (!field.positions.back().allFinite() || (scale.cwiseProduct(displacement)).array().isInf().any())
      table.fail(table.line_of(row), "a number times the unit of length is too large");
  }
  return field;
}

FieldIncrement increment_between(const DisplacementField* from, const DisplacementField& to) {
  std::map<Place, std::size_t> earlier;
  if (from != nullptr)
    for (std::size_t k = 0; k < from->positions.size(); ++k)
      if (!from->displacements[k].hasNaN()) earlier.emplace(place_of(from->positions[k]), k);
  FieldIncrement increment;
  for (std::size_t k = 0; k < to.positions.size(); ++k) {
    if (to.displacements[k].hasNaN()) continue;
    Eigen::Vector2d before = Eigen::Vector2d::Zero();
    if (from != nullptr) {
      const auto there = earlier.find(place_of(to.positions[k]));
      if (there == earlier.end()) continue;
      before = from->displacements[there->second];
    }
    increment.positions.push_back(to.positions[k]);
    increment.before.push_back(before);
    increment.displacements.emplace_back(to.displacements[k] - before);
  }
  // Places that stand in one of the fields only are missing in the other.
  std::map<Place, bool> all;
  for (const Eigen::Vector2d& place : to.positions) all[place_of(place)] = true;
  if (from != nullptr)
    for (const Eigen::Vector2d& place : from->positions) all[place_of(place)] = true;
  increment.missing = all.size() - increment.positions.size();
  return increment;
}

Samples samples_of(const FieldIncrement& increment, double radius, bool current) {
  Samples samples;
  if (increment.positions.empty()) return samples;
  const double area = mean_area(increment.positions);
  if (!(area > 0.0 && std::isfinite(area))) throw std::invalid_argument("the places fill no area");
  std::vector<Eigen::Vector2d> places = increment.positions;
  for (std::size_t k = 0; k < places.size(); ++k) places[k] += increment.before[k];
  // Strains of an increment are those of the body that it begins with.
  const std::vector<Eigen::Matrix2d> gradients = displacement_gradients(
      places, increment.displacements, radius > 0.0 ? radius : kNeighbourhood * std::sqrt(area));
  for (std::size_t k = 0; k < places.size(); ++k)
    if (gradients[k].allFinite())  // a place that stands alone has no strain
      samples.push_back({current ? places[k] : increment.positions[k], area, shear_strain(gradients[k]),
                         gradients[k].trace(), 0.5 * (gradients[k](1, 0) - gradients[k](0, 1))});
  return samples;
}

}  // namespace polargrain::band
