// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/element_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "common/mean_and_interval.hpp"
#include "element/measures.hpp"

namespace polargrain::app {
namespace {

using element::can_strain;
using element::kPlaceNames;
using element::tells_stress;

}  // namespace

std::vector<std::string> element_columns(const TableForm& form, const std::vector<std::string>& fields) {
  const element::Room room = form.room;
  std::vector<std::string> names{"stage", "row", "axial_strain", "volume_strain"};
  for (int place = 0; place < 6; ++place)
    if (can_strain(room, place))
      names.push_back(std::string("e") + kPlaceNames[static_cast<std::size_t>(place)]);
  for (int place = 0; place < 6; ++place)
    if (tells_stress(room, place))
      names.push_back(std::string("s") + kPlaceNames[static_cast<std::size_t>(place)] + "_Pa");
  for (const char* const name : {"p_Pa", "q_Pa", "stress_ratio", "friction_angle_deg"})
    names.emplace_back(name);
  if (room != element::Room::discs) names.emplace_back("b");
  for (const char* const name : {"pore_pressure_Pa", "residual", "steps", "evaluations", "jumps"})
    names.emplace_back(name);
  if (form.void_ratio) names.emplace_back("void_ratio");
  names.insert(names.end(), fields.begin(), fields.end());
  return names;
}

std::vector<double> element_values(const TableForm& form, const element::Row& row) {
  const element::Room room = form.room;
  std::vector<double> values{static_cast<double>(row.stage), static_cast<double>(row.number),
                             0.0 - row.strain(element::k22), row.volume - 1.0};
  for (int place = 0; place < 6; ++place)
    if (can_strain(room, place)) values.push_back(row.strain(place));
  for (int place = 0; place < 6; ++place)
    if (tells_stress(room, place)) values.push_back(row.stress(place));
  const element::StressMeasures measures = element::measures_of(row.stress, room);
  const double q = form.drives_shear ? std::abs(measures.q) : measures.q;
  for (const double value :
       {measures.p, q, measures.ratio, measures.friction_angle * 180.0 / std::numbers::pi})
    values.push_back(value);
  if (room != element::Room::discs) values.push_back(measures.b);
  values.push_back(row.pore_pressure);
  values.push_back(row.residual);
  for (const int count : {row.steps, row.evaluations, row.jumps}) values.push_back(count);
  if (form.void_ratio) values.push_back((1.0 + *form.void_ratio) * row.total_volume - 1.0);
  values.insert(values.end(), row.fields.begin(), row.fields.end());
  return values;
}

ElementMean mean_of(const std::vector<ElementCurve>& curves) {
  ElementMean result;
  for (std::size_t k = 0;; ++k) {
    std::vector<const std::vector<double>*> rows;
    for (const ElementCurve& curve : curves)
      if (k < curve.rows.size()) rows.push_back(&curve.rows[k]);
    if (rows.size() < 2) return result;
    std::vector<double> mean(rows.front()->size(), 0.0);
    std::vector<double> half(mean.size(), 0.0);
    for (std::size_t c = 0; c < mean.size(); ++c) {
      std::vector<double> values;
      for (const auto* const row : rows) values.push_back((*row)[c]);
      std::tie(mean[c], half[c]) = mean_and_interval(values);
    }
    result.count.push_back(static_cast<int>(rows.size()));
    result.mean.push_back(std::move(mean));
    result.half_width.push_back(std::move(half));
  }
}

}  // namespace polargrain::app
