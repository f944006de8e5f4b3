// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/hosts/mgis/point_data.hpp"

namespace polargrain::coupler::mgis {
namespace {

/// Place of a component of a host's tensor, first index i and second j, among the nine of a cell.
constexpr int place(int i, int j) {
  return 3 * (j - 1) + i - 1;
}

Places make_places(Hypothesis hypothesis) {
  Places places;
  places.strain = {place(1, 1), place(2, 2), place(3, 3), place(1, 2), place(2, 1)};
  if (hypothesis == Hypothesis::space) {
    for (const int more : {place(1, 3), place(3, 1), place(2, 3), place(3, 2)}) places.strain.push_back(more);
    for (const int of_strain : places.strain) places.wryness.push_back(9 + of_strain);
  } else {
    places.wryness = {9 + place(3, 1), 9 + place(3, 2)};
  }
  return places;
}

}  // namespace

const Places& places_of(Hypothesis hypothesis) {
  static const Places plane = make_places(Hypothesis::plane_strain);
  static const Places space = make_places(Hypothesis::space);
  return hypothesis == Hypothesis::space ? space : plane;
}

CellIncrement increment_of(const DataView& data, Hypothesis hypothesis) {
  const Places& places = places_of(hypothesis);
  Vector18 change = Vector18::Zero();  // in the order of the cell's stresses: the first index is the normal
  int k = 0;
  for (const int at : places.strain) change(at) += data.end.gradients[k] - data.start.gradients[k], ++k;
  for (const int at : places.wryness) change(at) += data.end.gradients[k] - data.start.gradients[k], ++k;
  // Transposed, as displacement gradients and curvatures have it.
  Eigen::Matrix3d strain;
  CellIncrement increment;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      strain(i, j) = change(3 * j + i);
      increment.curvature(i, j) = change(9 + 3 * j + i);
    }
  }
  increment.displacement_gradient = 0.5 * (strain + strain.transpose());
  increment.rotation(0) = 0.5 * (strain(1, 2) - strain(2, 1));
  increment.rotation(1) = 0.5 * (strain(2, 0) - strain(0, 2));
  increment.rotation(2) = 0.5 * (strain(0, 1) - strain(1, 0));
  return increment;
}

void write_forces(const CellResponse& response, Hypothesis hypothesis, double* forces) {
  const Places& places = places_of(hypothesis);
  const Vector18 all = response.components();
  for (const int at : places.strain) *forces++ = all(at);
  for (const int at : places.wryness) *forces++ = all(at);
}

void write_tangent(const CellResponse& response, Hypothesis hypothesis, double* tangent) {
  const Places& places = places_of(hypothesis);
  for (const std::vector<int>* const rows : {&places.strain, &places.wryness})
    for (const std::vector<int>* const columns : {&places.strain, &places.wryness})
      for (const int row : *rows)
        for (const int column : *columns) *tangent++ = response.tangent(row, column);
}

}  // namespace polargrain::coupler::mgis
