// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/dense_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace polargrain::dem {

namespace {

// Bodies that are compiled once for each instruction set must end up inside the function that names it.
#define POLARGRAIN_INLINE [[gnu::always_inline]] inline

/// Pivots eliminated together.
constexpr int kPanel = 8;

/// The pivot in place is kept when it is at least this fraction of the largest.
constexpr double kPivotThreshold = 0.1;

/// Vectors of one instruction set, and the tile of a matrix that fits its registers and leaves some for a row
/// of u and an entry of l.
template <int Doubles, int TileRows, int TileVectors>
struct Registers {
  using Vector [[gnu::vector_size(Doubles * sizeof(double))]] = double;
  static constexpr int width = Doubles;
  static constexpr int rows = TileRows;
  static constexpr int vectors = TileVectors;
};

template <typename Vector>
POLARGRAIN_INLINE void load(Vector& to, const double* from) {
  std::memcpy(&to, from, sizeof(Vector));
}

template <typename Vector>
POLARGRAIN_INLINE void store(double* to, const Vector& from) {
  std::memcpy(to, &from, sizeof(Vector));
}

/// c -= l u for a tile of `Rows` rows, kept in registers.
template <typename Registers, int Rows>
POLARGRAIN_INLINE void subtract_tile(double* c, int c_stride, const double* l, int l_stride, const double* u,
                                     int u_stride, int depth) {
  typename Registers::Vector sums[Rows][Registers::vectors];
  for (int row = 0; row < Rows; ++row)
    for (int v = 0; v < Registers::vectors; ++v)
      load(sums[row][v], c + row * c_stride + v * Registers::width);
  for (int k = 0; k < depth; ++k) {
    typename Registers::Vector factors[Registers::vectors];
    for (int v = 0; v < Registers::vectors; ++v) load(factors[v], u + k * u_stride + v * Registers::width);
    for (int row = 0; row < Rows; ++row)
      for (int v = 0; v < Registers::vectors; ++v) sums[row][v] -= l[row * l_stride + k] * factors[v];
  }
  for (int row = 0; row < Rows; ++row)
    for (int v = 0; v < Registers::vectors; ++v)
      store(c + row * c_stride + v * Registers::width, sums[row][v]);
}

/// c -= l u; writes up to kRowSlack columns more than `columns`.
template <typename Registers, int Rows = Registers::rows>
POLARGRAIN_INLINE void subtract_product(double* c, int c_stride, const double* l, int l_stride,
                                        const double* u, int u_stride, int rows, int columns, int depth) {
  constexpr int width = Registers::vectors * Registers::width;
  int row = 0;
  for (; row + Rows <= rows; row += Rows)
    for (int column = 0; column < columns; column += width)
      subtract_tile<Registers, Rows>(c + row * c_stride + column, c_stride, l + row * l_stride, l_stride,
                                     u + column, u_stride, depth);
  for (; row < rows; ++row)
    for (int column = 0; column < columns; column += width)
      subtract_tile<Registers, 1>(c + row * c_stride + column, c_stride, l + row * l_stride, l_stride,
                                  u + column, u_stride, depth);
}

/// Brings a large enough pivot to row k of column k.
POLARGRAIN_INLINE bool choose_pivot(const FrontMatrix& front, int k) {
  const auto entry = [&front, k](int row) { return std::abs(front.values[row * front.stride + k]); };
  int best = k;
  for (int row = k + 1; row < front.pivots; ++row)
    if (entry(row) > entry(best)) best = row;
  if (!(entry(best) > 0.0) || !std::isfinite(entry(best))) return false;
  if (entry(k) < kPivotThreshold * entry(best))
    std::swap_ranges(front.values + k * front.stride, front.values + k * front.stride + front.columns,
                     front.values + best * front.stride);
  return true;
}

/// Eliminates the pivots of one panel from the columns of the panel, in all rows below.
template <typename Registers>
POLARGRAIN_INLINE bool eliminate_panel(const FrontMatrix& front, int first, int pivots) {
  constexpr int vectors = kPanel / Registers::width;
  using Vector = typename Registers::Vector;
  for (int k = 0; k < pivots; ++k) {
    if (!choose_pivot(front, first + k)) return false;
    const double* pivot_row = front.values + (first + k) * front.stride + first;
    const double inverse = 1.0 / pivot_row[k];
    // Whole vectors, with nothing to subtract in the columns done.
    double upper_row[kPanel] = {};
    for (int column = k + 1; column < kPanel; ++column) upper_row[column] = pivot_row[column];
    Vector upper[vectors];
    for (int v = 0; v < vectors; ++v) load(upper[v], upper_row + v * Registers::width);
    for (int row = first + k + 1; row < front.rows; ++row) {
      double* place = front.values + row * front.stride + first;
      const double factor = place[k] * inverse;
      for (int v = k / Registers::width; v < vectors; ++v) {
        Vector lower;
        load(lower, place + v * Registers::width);
        lower -= factor * upper[v];
        store(place + v * Registers::width, lower);
      }
      place[k] = factor;
    }
  }
  return true;
}

template <typename Registers>
POLARGRAIN_INLINE bool eliminate_with(const FrontMatrix& front) {
  const int stride = front.stride;
  for (int first = 0; first < front.pivots; first += kPanel) {
    const int pivots = std::min(kPanel, front.pivots - first);
    if (!eliminate_panel<Registers>(front, first, pivots)) return false;
    // The columns to the right of the panel: first in its own rows, then in those below.
    double* corner = front.values + first * stride + first;
    const int rest = front.columns - first - kPanel;
    for (int row = 1; row < pivots; ++row)
      subtract_product<Registers, 1>(corner + row * stride + kPanel, stride, corner + row * stride, stride,
                                     corner + kPanel, stride, 1, rest, row);
    subtract_product<Registers>(corner + pivots * stride + kPanel, stride, corner + pivots * stride, stride,
                                corner + kPanel, stride, front.rows - first - pivots, rest, pivots);
  }
  return true;
}

template <typename Registers>
POLARGRAIN_INLINE void substitute_with(const FrontMatrix& factors, const double* known, int known_stride) {
  const int stride = factors.stride;
  const int pivots = factors.pivots;
  const int sides = factors.columns - factors.rows;
  double* right = factors.values + factors.rows;
  subtract_product<Registers>(right, stride, factors.values + pivots, stride, known, known_stride, pivots,
                              sides, factors.rows - pivots);
  for (int k = pivots - 1; k >= 0; --k) {
    double* solved = right + k * stride;
    const double* upper = factors.values + k * stride + k;
    subtract_product<Registers, 1>(solved, stride, upper + 1, stride, solved + stride, stride, 1, sides,
                                   pivots - k - 1);
    const double inverse = 1.0 / upper[0];
    for (int side = 0; side < sides; ++side) solved[side] *= inverse;
  }
}

using Baseline = Registers<2, 4, 2>;  // 16 registers
using Avx2 = Registers<4, 4, 2>;      // 16
using Avx512 = Registers<8, 8, 1>;    // 32

bool eliminate_baseline(const FrontMatrix& front) {
  return eliminate_with<Baseline>(front);
}
[[gnu::target("avx2")]] bool eliminate_avx2(const FrontMatrix& front) {
  return eliminate_with<Avx2>(front);
}
[[gnu::target("avx512f")]] bool eliminate_avx512(const FrontMatrix& front) {
  return eliminate_with<Avx512>(front);
}
void substitute_baseline(const FrontMatrix& factors, const double* known, int known_stride) {
  substitute_with<Baseline>(factors, known, known_stride);
}
[[gnu::target("avx2")]] void substitute_avx2(const FrontMatrix& factors, const double* known,
                                             int known_stride) {
  substitute_with<Avx2>(factors, known, known_stride);
}
[[gnu::target("avx512f")]] void substitute_avx512(const FrontMatrix& factors, const double* known,
                                                  int known_stride) {
  substitute_with<Avx512>(factors, known, known_stride);
}

}  // namespace

bool eliminate(const FrontMatrix& front, InstructionSet set) {
  if (set == InstructionSet::avx512) return eliminate_avx512(front);
  if (set == InstructionSet::avx2) return eliminate_avx2(front);
  return eliminate_baseline(front);
}

void substitute_back(const FrontMatrix& factors, const double* known, int known_stride, InstructionSet set) {
  if (set == InstructionSet::avx512) return substitute_avx512(factors, known, known_stride);
  if (set == InstructionSet::avx2) return substitute_avx2(factors, known, known_stride);
  return substitute_baseline(factors, known, known_stride);
}

}  // namespace polargrain::dem
