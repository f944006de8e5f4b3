// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>

#include "common/cell.hpp"

namespace polargrain::dem {

/// FOR COMPARISON ONLY, and no choice of a case: a cell whose outermost grains are moved affinely and turned
/// by the micro-rotation and curvature (mode 3 of docs/theory/grains.md, C.6), as small representative
/// volumes are often loaded. Its Cosserat moduli depend on its size without limit: the modulus against
/// relative rotation falls with 1 / size and the couple modulus grows with the size (C.5), so that neither is
/// one of the material.
///
/// The packing is taken out of its periodic box: grains no longer touch across the faces. Held are the grains
/// whose centres lie within 0.6 mean diameters of the outermost centres along either axis of the box. With
/// f^b and m^b the forces and moments that hold them and x counted from the centre of the box (C.2, C.3),
///   s_ij = (1/V) sum x_i f^b_j,   m_i = (1/V) sum x_i m^b,
/// V the rectangle spanned by the outermost centres. No tangent.
/// @throws RunError when the box is tilted
std::unique_ptr<CellService> make_boundary_cell_service(const CellDefinition& definition);

}  // namespace polargrain::dem
