// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "dem/lanes/instruction_set.hpp"

namespace polargrain::dem {

// Dense kernels of the network solver, in double or single precision. Each is compiled for several instruction sets; the one that this
// processor knows is taken at run time. All give the same bits: an element is always c - l_0 u_0 - l_1 u_1 -
// ... in this order, each product and each difference rounded on its own, and instruction sets differ only in
// how many elements they treat at a time. Hence no fused multiply-add may be used here (CMakeLists.txt
// forbids the compiler to make any).

/// Numbers that must follow the last column of each row of a matrix given to the kernels; they come out
/// unchanged if they are zero.
template <typename Number>
inline constexpr int kRowSlackOf = 64 / static_cast<int>(sizeof(Number));
inline constexpr int kRowSlack = kRowSlackOf<double>;

/// Square system of equations of a front with its right-hand sides, row by row: unknowns are the first `rows`
/// columns, right-hand sides the others.
template <typename Number>
struct FrontMatrixOf {
  Number* values;  ///< row i starts at values + i * stride
  int rows;        ///< equations
  int columns;     ///< unknowns and right-hand sides
  int stride;      ///< of rows, at least columns + kRowSlackOf
  int pivots;      ///< the first of the unknowns, complete: no other front adds to them
};
using FrontMatrix = FrontMatrixOf<double>;

/// Eliminates the pivots: the first `pivots` rows become those of U (and of the right-hand sides), the other
/// rows the rest to eliminate, the Schur complement; the factor L stands below the diagonal. Among the
/// rows of pivots the largest is taken when the one in place is less than a tenth of it.
/// @returns false when a pivot is zero or not finite; the front is spoilt then
template <typename Number>
bool eliminate(const FrontMatrixOf<Number>& front, InstructionSet set);

/// Solves the rows of a front that eliminate() has treated for its pivots, given the other unknowns.
/// @param factors the first rows of the front, which the pivots have; the right-hand sides in them are replaced
/// by the solution
/// @param known values of the unknowns that are not pivots, one row each, as many columns as right-hand sides
/// @param known_stride of rows, at least the right-hand sides, rounded up to a multiple of kRowSlackOf
template <typename Number>
void substitute_back(const FrontMatrixOf<Number>& factors, const Number* known, int known_stride,
                     InstructionSet set);

extern template bool eliminate(const FrontMatrixOf<double>&, InstructionSet);
extern template bool eliminate(const FrontMatrixOf<float>&, InstructionSet);
extern template void substitute_back(const FrontMatrixOf<double>&, const double*, int, InstructionSet);
extern template void substitute_back(const FrontMatrixOf<float>&, const float*, int, InstructionSet);

}  // namespace polargrain::dem
