// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/dense_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace polargrain::dem {

namespace {

// Bodies that are compiled once for each instruction set must end up inside the function that names it.
#define POLARGRAIN_INLINE [[gnu::always_inline]] inline

/// Pivots eliminated together: as many as the widest vectors hold.
template <typename Number>
constexpr int kPanelOf = kRowSlackOf<Number>;

/// The pivot in place is kept when it is at least this fraction of the largest.
constexpr double kPivotThreshold = 0.1;

/// Vectors of one instruction set, and the tile of a matrix that fits its registers and leaves some for a row
/// of u and an entry of l.
template <typename Scalar, int Bytes, int TileRows, int TileVectors>
struct Registers {
  using Number = Scalar;
  using Vector [[gnu::vector_size(Bytes)]] = Scalar;
  static constexpr int width = Bytes / sizeof(Scalar);
  static constexpr int panel = kPanelOf<Scalar>;
  static constexpr int rows = TileRows;
  static constexpr int vectors = TileVectors;
};

template <typename Vector, typename Number>
POLARGRAIN_INLINE void load(Vector& to, const Number* from) {
  std::memcpy(&to, from, sizeof(Vector));
}

template <typename Vector, typename Number>
POLARGRAIN_INLINE void store(Number* to, const Vector& from) {
  std::memcpy(to, &from, sizeof(Vector));
}

/// c -= l u for a tile of `Rows` rows and `Vectors` vectors, kept in registers.
template <typename Registers, int Rows, int Vectors, typename Number = typename Registers::Number>
POLARGRAIN_INLINE void subtract_tile(Number* c, int c_stride, const Number* l, int l_stride, const Number* u,
                                     int u_stride, int depth) {
  typename Registers::Vector sums[Rows][Vectors];
  for (int row = 0; row < Rows; ++row)
    for (int v = 0; v < Vectors; ++v) load(sums[row][v], c + row * c_stride + v * Registers::width);
  for (int k = 0; k < depth; ++k) {
    typename Registers::Vector factors[Vectors];
    for (int v = 0; v < Vectors; ++v) load(factors[v], u + k * u_stride + v * Registers::width);
    for (int row = 0; row < Rows; ++row)
      for (int v = 0; v < Vectors; ++v) sums[row][v] -= l[row * l_stride + k] * factors[v];
  }
  for (int row = 0; row < Rows; ++row)
    for (int v = 0; v < Vectors; ++v) store(c + row * c_stride + v * Registers::width, sums[row][v]);
}

/// c -= l u for `Rows` rows; the last tile is as narrow as kRowSlackOf asks.
template <typename Registers, int Rows, typename Number = typename Registers::Number>
POLARGRAIN_INLINE void subtract_rows(Number* c, int c_stride, const Number* l, int l_stride, const Number* u,
                                     int u_stride, int columns, int depth) {
  constexpr int wide = Registers::vectors * Registers::width;
  constexpr int narrow = std::min(Registers::vectors, Registers::panel / Registers::width);
  int column = 0;
  for (; column + wide <= columns; column += wide)
    subtract_tile<Registers, Rows, Registers::vectors>(c + column, c_stride, l, l_stride, u + column,
                                                       u_stride, depth);
  for (; column < columns; column += narrow * Registers::width)
    subtract_tile<Registers, Rows, narrow>(c + column, c_stride, l, l_stride, u + column, u_stride, depth);
}

/// c -= l u; writes up to kRowSlackOf columns more than `columns`.
template <typename Registers, int Rows = Registers::rows, typename Number = typename Registers::Number>
POLARGRAIN_INLINE void subtract_product(Number* c, int c_stride, const Number* l, int l_stride,
                                        const Number* u, int u_stride, int rows, int columns, int depth) {
  int row = 0;
  for (; row + Rows <= rows; row += Rows)
    subtract_rows<Registers, Rows>(c + row * c_stride, c_stride, l + row * l_stride, l_stride, u, u_stride,
                                   columns, depth);
  for (; row < rows; ++row)
    subtract_rows<Registers, 1>(c + row * c_stride, c_stride, l + row * l_stride, l_stride, u, u_stride,
                                columns, depth);
}

/// Brings a large enough pivot to row k of column k.
template <typename Number>
POLARGRAIN_INLINE bool choose_pivot(const FrontMatrixOf<Number>& front, int k) {
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
template <typename Registers, typename Number>
POLARGRAIN_INLINE bool eliminate_panel(const FrontMatrixOf<Number>& front, int first, int pivots) {
  constexpr int kPanel = Registers::panel;
  constexpr int vectors = kPanel / Registers::width;
  using Vector = typename Registers::Vector;
  for (int k = 0; k < pivots; ++k) {
    if (!choose_pivot(front, first + k)) return false;
    const Number* pivot_row = front.values + (first + k) * front.stride + first;
    const Number inverse = Number(1) / pivot_row[k];
    // Whole vectors, with nothing to subtract in the columns done.
    Number upper_row[kPanel] = {};
    for (int column = k + 1; column < kPanel; ++column) upper_row[column] = pivot_row[column];
    Vector upper[vectors];
    for (int v = 0; v < vectors; ++v) load(upper[v], upper_row + v * Registers::width);
    for (int row = first + k + 1; row < front.rows; ++row) {
      Number* place = front.values + row * front.stride + first;
      const Number factor = place[k] * inverse;
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

template <typename Registers, typename Number = typename Registers::Number>
POLARGRAIN_INLINE bool eliminate_with(const FrontMatrixOf<Number>& front) {
  constexpr int kPanel = Registers::panel;
  const int stride = front.stride;
  for (int first = 0; first < front.pivots; first += kPanel) {
    const int pivots = std::min(kPanel, front.pivots - first);
    if (!eliminate_panel<Registers>(front, first, pivots)) return false;
    // The columns to the right of the panel: first in its own rows, then in those below.
    Number* corner = front.values + first * stride + first;
    const int rest = front.columns - first - kPanel;
    for (int row = 1; row < pivots; ++row)
      subtract_product<Registers, 1>(corner + row * stride + kPanel, stride, corner + row * stride, stride,
                                     corner + kPanel, stride, 1, rest, row);
    subtract_product<Registers>(corner + pivots * stride + kPanel, stride, corner + pivots * stride, stride,
                                corner + kPanel, stride, front.rows - first - pivots, rest, pivots);
  }
  return true;
}

template <typename Registers, typename Number = typename Registers::Number>
POLARGRAIN_INLINE void substitute_with(const FrontMatrixOf<Number>& factors, const Number* known,
                                       int known_stride) {
  const int stride = factors.stride;
  const int pivots = factors.pivots;
  const int sides = factors.columns - factors.rows;
  Number* right = factors.values + factors.rows;
  subtract_product<Registers>(right, stride, factors.values + pivots, stride, known, known_stride, pivots,
                              sides, factors.rows - pivots);
  for (int k = pivots - 1; k >= 0; --k) {
    Number* solved = right + k * stride;
    const Number* upper = factors.values + k * stride + k;
    subtract_product<Registers, 1>(solved, stride, upper + 1, stride, solved + stride, stride, 1, sides,
                                   pivots - k - 1);
    const Number inverse = Number(1) / upper[0];
    for (int side = 0; side < sides; ++side) solved[side] *= inverse;
  }
}

template <typename Number>
using Baseline = Registers<Number, 16, 4, 2>;  // 16 registers
template <typename Number>
using Avx2 = Registers<Number, 32, 4, 2>;  // 16
template <typename Number>
using Avx512 = Registers<Number, 64, 8, 2>;  // 32

template <typename Number>
bool eliminate_baseline(const FrontMatrixOf<Number>& front) {
  return eliminate_with<Baseline<Number>>(front);
}
template <typename Number>
[[gnu::target("avx2")]] bool eliminate_avx2(const FrontMatrixOf<Number>& front) {
  return eliminate_with<Avx2<Number>>(front);
}
template <typename Number>
[[gnu::target("avx512f")]] bool eliminate_avx512(const FrontMatrixOf<Number>& front) {
  return eliminate_with<Avx512<Number>>(front);
}
template <typename Number>
void substitute_baseline(const FrontMatrixOf<Number>& factors, const Number* known, int known_stride) {
  substitute_with<Baseline<Number>>(factors, known, known_stride);
}
template <typename Number>
[[gnu::target("avx2")]] void substitute_avx2(const FrontMatrixOf<Number>& factors, const Number* known,
                                             int known_stride) {
  substitute_with<Avx2<Number>>(factors, known, known_stride);
}
template <typename Number>
[[gnu::target("avx512f")]] void substitute_avx512(const FrontMatrixOf<Number>& factors, const Number* known,
                                                  int known_stride) {
  substitute_with<Avx512<Number>>(factors, known, known_stride);
}

}  // namespace

template <typename Number>
bool eliminate(const FrontMatrixOf<Number>& front, InstructionSet set) {
  if (set == InstructionSet::avx512) return eliminate_avx512(front);
  if (set == InstructionSet::avx2) return eliminate_avx2(front);
  return eliminate_baseline(front);
}

template <typename Number>
void substitute_back(const FrontMatrixOf<Number>& factors, const Number* known, int known_stride,
                     InstructionSet set) {
  if (set == InstructionSet::avx512) return substitute_avx512(factors, known, known_stride);
  if (set == InstructionSet::avx2) return substitute_avx2(factors, known, known_stride);
  return substitute_baseline(factors, known, known_stride);
}

template bool eliminate(const FrontMatrixOf<double>&, InstructionSet);
template bool eliminate(const FrontMatrixOf<float>&, InstructionSet);
template void substitute_back(const FrontMatrixOf<double>&, const double*, int, InstructionSet);
template void substitute_back(const FrontMatrixOf<float>&, const float*, int, InstructionSet);

}  // namespace polargrain::dem
