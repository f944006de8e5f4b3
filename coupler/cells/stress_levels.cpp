// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/stress_levels.hpp"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "element/driver.hpp"
#include "element/stiffness.hpp"

namespace polargrain::coupler {
namespace {

using element::k11;
using element::k22;
using element::k33;

/// Largest ratio of neighbours: half of it is left to the tangent.
constexpr double kLevel = 1.095;
/// Of the stresses of a level, over its vertical stress.
constexpr double kTolerance = 2e-3;

element::Stage stage_to(double vertical, const GroundPath& path) {
  using element::Constraint;
  const element::Vector6 stress = path.stress(vertical);
  element::Stage stage;
  stage.name = "level";
  stage.rows = 1;
  for (int place = 0; place < 6; ++place) {
    if (!can_strain(path.room, place)) continue;
    stage.constraints.push_back(
        path.gives_stress(place)
            ? component(Constraint::Kind::stress, place, Constraint::Way::reach, stress(place))
            : component(Constraint::Kind::strain, place, Constraint::Way::hold));
  }
  return stage;
}

/// @returns why the level cannot be reached; empty: it is
std::string lead(CellPoint& point, double vertical, const GroundPath& path) {
  const element::Stage stage = stage_to(vertical, path);
  element::Accuracy accuracy;
  accuracy.pressure = vertical;
  accuracy.tolerance = kTolerance;
  return follow(point, {&stage, 1}, accuracy).failure;
}

/// Vertical stresses from `start` to `end`, the start left out.
std::vector<double> between(double start, double end) {
  const double ratio = end / start;
  const int count = static_cast<int>(std::ceil(std::abs(logarithm(ratio)) / logarithm(kLevel)));
  std::vector<double> levels;
  for (int k = 1; k <= count; ++k)
    levels.push_back(k == count ? end : start * power(ratio, static_cast<double>(k) / count));
  return levels;
}

}  // namespace

double vertical_stress(const CellResponse& box, int up) {
  return -element::six(box.stress)(up);
}

bool GroundPath::gives_stress(int place) const {
  return can_strain(room, place) && (place == up || place > k33 || lateral_ratio.has_value());
}

element::Vector6 GroundPath::stress(double vertical) const {
  element::Vector6 stress = element::Vector6::Zero();
  stress.head<3>().setConstant(-lateral_ratio.value_or(0.0) * vertical);
  stress(up) = -vertical;
  return stress;
}

double GroundPath::off(const element::Vector6& found, double vertical) const {
  const element::Vector6 difference = found - stress(vertical);
  double largest = 0.0;
  for (int place = 0; place < 6; ++place)
    if (gives_stress(place)) largest = std::max(largest, std::abs(difference(place)));
  return largest;
}

element::Vector6 GroundPath::strain_to(const CellResponse& box, double vertical, bool in_plane) const {
  std::vector<int> places;
  for (const int place : {k11, k22, k33, element::k12, element::k13, element::k23})
    if (gives_stress(place) && (!in_plane || can_strain(element::Room::discs, place)))
      places.push_back(place);
  const element::Vector6 wanted = stress(vertical) - element::six(box.stress);
  const element::Matrix6 stiffness = element::stiffness_of(box);
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd part(count, count);
  Eigen::VectorXd missing(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    missing(i) = wanted(places[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < count; ++j)
      part(i, j) = stiffness(places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(j)]);
  }
  const Eigen::VectorXd strain = part.fullPivLu().solve(missing);
  element::Vector6 all = element::Vector6::Zero();
  if (!strain.allFinite()) return all;
  for (Eigen::Index i = 0; i < count; ++i) all(places[static_cast<std::size_t>(i)]) = strain(i);
  return all;
}

double GroundPath::ratio_of(const CellResponse& box) const {
  const element::Vector6 stress = element::six(box.stress);
  double sum = 0.0;
  int count = 0;
  for (const int place : {k11, k22, k33}) {
    if (place == up || !tells_stress(room, place)) continue;
    sum += stress(place);
    ++count;
  }
  return sum / count / stress(up);
}

std::size_t StressLevels::nearest(double vertical, int up) const {
  const auto distance = [&](const CellReply& box) {
    return std::abs(logarithm(vertical / vertical_stress(box.response, up)));
  };
  return static_cast<std::size_t>(std::ranges::min_element(boxes, {}, distance) - boxes.begin());
}

StressLevels stress_levels(const AskCell& ask, const CellReply& packing, const GroundPath& path, double least,
                           double largest) {
  const int dimension = path.room == element::Room::space ? 3 : 2;
  const double start = vertical_stress(packing.response, path.up);
  CellPoint point(ask, packing, dimension);
  if (const std::string reason = lead(point, start, path); !reason.empty())
    throw RunError(
        fmt::format("the packing cannot be led to K0 = {:.3g} under its own {:.4g} kPa: {}; it may not carry "
                    "that; 'K0: measured' takes the ratio that it has",
                    path.lateral_ratio.value_or(1.0), 1e-3 * start, reason));
  const CellReply first = point.committed();
  StressLevels table;
  table.boxes.push_back(first);
  for (const double level : between(start, std::max(start, largest))) {
    if (const std::string reason = lead(point, level, path); !reason.empty())
      throw RunError(
          fmt::format("the packing cannot be led to the {:.4g} kPa of the ground, at {:.4g} kPa: {}",
                      1e-3 * largest, 1e-3 * level, reason));
    table.boxes.push_back(point.committed());
  }
  CellPoint down(ask, first, dimension);
  std::vector<CellReply> below;
  for (const double level : between(start, std::min(start, least))) {
    table.end_below = lead(down, level, path);
    if (!table.end_below.empty()) break;
    below.push_back(down.committed());
  }
  table.boxes.insert(table.boxes.begin(), below.rbegin(), below.rend());
  return table;
}

}  // namespace polargrain::coupler
