// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "common/cell_increment.hpp"
#include "common/cell_response.hpp"
#include "coupler/hosts/mgis/data_view.hpp"

namespace polargrain::coupler::mgis {

/// In which directions a host's points live.
enum class Hypothesis { plane_strain, space };

/// Where the components of a host's gradients and forces stand among the eighteen of a cell (common/cell_response.hpp).
///
/// Hosts follow MFront: the strain is e_ij = d u_i / d x_j + e_ijk w_k, the wryness k_ij = d w_i / d x_j, and the stresses
/// have the direction first and the normal of the face second: transposed from the rest of this project. The
/// components of a tensor are 11, 22, 33, 12, 21, then 13, 31, 23, 32; in plane strain the first five, and of wryness
/// and couple stress the two about e_3: a vector.
struct Places {
  std::vector<int> strain;
  std::vector<int> wryness;
};
const Places& places_of(Hypothesis hypothesis);

/// The increment of a cell from the gradients at both ends of a step, in small deformation: its box is strained and not
/// turned, its grains turn as far as the micro-rotation goes beyond the rotation of the continuum.
CellIncrement increment_of(const DataView& data, Hypothesis hypothesis);

/// Stress, then couple stress.
void write_forces(const CellResponse& response, Hypothesis hypothesis, double* forces);

/// The four blocks: stress by strain, stress by wryness, couple stress by strain, couple stress by wryness.
void write_tangent(const CellResponse& response, Hypothesis hypothesis, double* tangent);

}  // namespace polargrain::coupler::mgis
