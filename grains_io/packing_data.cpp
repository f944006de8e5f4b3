// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains_io/packing_data.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "common/elementary_functions.hpp"

namespace polargrain {

namespace {

/// The density with which the engine gives the grain its mass: in dimension 2 it multiplies by the area of
/// the disc (unit thickness), else by the volume of the sphere.
double data_density(const Grain& grain, bool space) {
  const double area = std::numbers::pi * grain.radius * grain.radius;
  return grain.mass / (space ? 4.0 / 3.0 * area * grain.radius : area);
}

}  // namespace

std::string packing_data(const Packing& packing) {
  const Eigen::Vector2d first = packing.box.col(0);
  const double length_x = first.norm();
  const double length_y = packing.box.determinant() / length_x;
  double tilt = first.dot(packing.box.col(1)) / length_x;
  const auto [sine, cosine] = sine_and_cosine(arc_tangent(first.y(), first.x()));
  Eigen::Matrix2d to_box_frame;
  to_box_frame << cosine, sine, -sine, cosine;

  const bool space = packing.dimension == 3;
  // The same lattice with the tilts that the engine takes.
  Eigen::Vector2d lean = to_box_frame * packing.lean;
  lean -= std::round(lean.y() / length_y) * Eigen::Vector2d(tilt, length_y);
  lean.x() -= length_x * std::round(lean.x() / length_x);
  tilt -= length_x * std::round(tilt / length_x);
  std::string text = fmt::format("{}grains of one type, density is mass over {}\n\n", kPackingDataHead,
                                 space ? "volume" : "area (dimension 2: unit thickness)");
  text += fmt::format("{} atoms\n1 atom types\n\n", packing.grains.size());
  text += fmt::format("0 {:.17g} xlo xhi\n0 {:.17g} ylo yhi\n{:.17g} {:.17g} zlo zhi\n", length_x, length_y,
                      space ? 0.0 : -0.5 * packing.thickness, (space ? 1.0 : 0.5) * packing.thickness);
  // The engine's box is a right one for good unless it is told its tilt, even a tilt of zero.
  text += fmt::format("{:.17g} {:.17g} {:.17g} xy xz yz\n", tilt, lean.x(), lean.y());
  text += "\nAtoms\n\n";
  for (std::size_t k = 0; k < packing.grains.size(); ++k) {
    const Grain& grain = packing.grains[k];
    const Eigen::Vector2d position = to_box_frame * grain.position;
    text += fmt::format("{} 1 {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", k + 1, 2.0 * grain.radius,
                        data_density(grain, space), position.x(), position.y(), grain.height);
  }
  return text;
}

Eigen::Matrix3d frame_of_packing_data(const Packing& packing) {
  const Eigen::Vector2d along = packing.box.col(0) / packing.box.col(0).norm();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << along.x(), -along.y(), along.y(), along.x();
  return turn;
}

}  // namespace polargrain
