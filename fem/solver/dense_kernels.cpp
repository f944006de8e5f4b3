// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/dense_kernels.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

// One version of a loop for every width of registers; the loader takes the widest that the processor has.
// They differ in nothing but the number of results computed at a time: no sum is spread over a register, and
// fused multiply-add is forbidden in this file (cmake/umfpack.cmake). Sanitizers and resolvers do not go
// together.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)
#define POLARGRAIN_ANY_REGISTERS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define POLARGRAIN_ANY_REGISTERS
#endif

namespace {

/// A block of results that stays in registers: kTileRows x kTileColumns.
constexpr int kTileRows = 8;
constexpr int kTileColumns = 4;
/// Rows that are worked on while they are in the first cache.
constexpr int kBlockRows = 64;
/// Products summed up before they are taken from the result; UMFPACK asks for no more than 32.
constexpr int kBlockDepth = 64;

using Lanes [[gnu::vector_size(32)]] = double;

struct Columns {
  const double* first;
  int distance;
  [[nodiscard]] const double* at(int row, int column) const {
    return first + row + static_cast<std::ptrdiff_t>(column) * distance;
  }
};

/// Rows [start, start + rows) as tiles of `height` rows, a tile column after column; rows that are missing in
/// the last tile are zero.
void pack(const Columns& matrix, int start, int rows, int first_column, int columns, int height,
          double* packed) {
  for (int tile = 0; tile < rows; tile += height) {
    const int filled = std::min(height, rows - tile);
    for (int p = 0; p < columns; ++p, packed += height) {
      std::copy_n(matrix.at(start + tile, first_column + p), filled, packed);
      std::fill(packed + filled, packed + height, 0.0);
    }
  }
}

/// Part of a tile, at the edge of C.
void subtract_corner(const double (*sums)[kTileRows], int rows, int columns, double* c, int ld_c) {
  for (int k = 0; k < columns; ++k)
    for (int i = 0; i < rows; ++i) c[i + static_cast<std::ptrdiff_t>(k) * ld_c] -= sums[k][i];
}

/// C -= A B^T for packed blocks; each product of a row and a column is summed up from its first term to its
/// last, without the part beyond the edge of C.
POLARGRAIN_ANY_REGISTERS
void subtract_packed(int rows, int columns, int depth, const double* a, const double* b, double* c,
                     int ld_c) {
  for (int j = 0; j < columns; j += kTileColumns, b += depth * kTileColumns) {
    const double* left = a;
    for (int i = 0; i < rows; i += kTileRows) {
      Lanes sum[2 * kTileColumns];
      for (Lanes& lanes : sum) lanes = Lanes{};
      const double* right = b;
      for (int p = 0; p < depth; ++p, left += kTileRows, right += kTileColumns) {
        Lanes upper, lower;
        std::memcpy(&upper, left, sizeof upper);
        std::memcpy(&lower, left + kTileRows / 2, sizeof lower);
        for (int k = 0; k < kTileColumns; ++k) {
          sum[2 * k] += upper * right[k];
          sum[2 * k + 1] += lower * right[k];
        }
      }
      double* corner = c + i + static_cast<std::ptrdiff_t>(j) * ld_c;
      if (rows - i >= kTileRows && columns - j >= kTileColumns) {
        for (int k = 0; k < 2 * kTileColumns; ++k) {
          double* place = corner + (k / 2) * static_cast<std::ptrdiff_t>(ld_c) + (k % 2) * kTileRows / 2;
          Lanes lanes;
          std::memcpy(&lanes, place, sizeof lanes);
          lanes -= sum[k];
          std::memcpy(place, &lanes, sizeof lanes);
        }
      } else {
        double sums[kTileColumns][kTileRows];
        std::memcpy(sums, sum, sizeof sums);
        subtract_corner(sums, std::min(kTileRows, rows - i), std::min(kTileColumns, columns - j), corner,
                        ld_c);
      }
    }
  }
}

int tiled(int size, int tile) {
  return (size + tile - 1) / tile * tile;
}

/// y -= A x for rows that fit the first cache, one column after the other.
POLARGRAIN_ANY_REGISTERS
void subtract_columns(int rows, int columns, const double* a, std::ptrdiff_t ld_a, const double* x,
                      std::ptrdiff_t step_x, double* __restrict y) {
  int j = 0;
  for (; j + 4 <= columns; j += 4) {  // four at a time: y is read and written once, in the same order of sums
    const double* a0 = a + j * ld_a;
    const double *a1 = a0 + ld_a, *a2 = a1 + ld_a, *a3 = a2 + ld_a;
    const double x0 = x[j * step_x], x1 = x[(j + 1) * step_x];
    const double x2 = x[(j + 2) * step_x], x3 = x[(j + 3) * step_x];
    for (int i = 0; i < rows; ++i) y[i] = y[i] - a0[i] * x0 - a1[i] * x1 - a2[i] * x2 - a3[i] * x3;
  }
  for (; j < columns; ++j) {
    const double* a0 = a + j * ld_a;
    const double x0 = x[j * step_x];
    for (int i = 0; i < rows; ++i) y[i] -= a0[i] * x0;
  }
}

void expect(bool usual, const char* routine) {
  if (usual) return;
  std::fprintf(stderr, "%s: UMFPACK makes a kind of call that this routine does not know\n", routine);
  std::abort();
}

}  // namespace

void polargrain_dgemm(const char* side_a, const char* side_b, const int* rows, const int* columns,
                      const int* depth, const double* alpha, const double* a, const int* ld_a,
                      const double* b, const int* ld_b, const double* beta, double* c, const int* ld_c) {
  expect(*side_a == 'N' && *side_b == 'T' && *alpha == -1.0 && *beta == 1.0, "dgemm");
  static thread_local std::vector<double> packed_a(kBlockRows * kBlockDepth), packed_b;
  packed_b.resize(static_cast<std::size_t>(tiled(*columns, kTileColumns)) * kBlockDepth);
  for (int p = 0; p < *depth; p += kBlockDepth) {
    const int deep = std::min(kBlockDepth, *depth - p);
    pack({b, *ld_b}, 0, *columns, p, deep, kTileColumns, packed_b.data());
    for (int i = 0; i < *rows; i += kBlockRows) {
      const int high = std::min(kBlockRows, *rows - i);
      pack({a, *ld_a}, i, high, p, deep, kTileRows, packed_a.data());
      subtract_packed(high, *columns, deep, packed_a.data(), packed_b.data(), c + i, *ld_c);
    }
  }
}

void polargrain_dtrsm(const char* side, const char* triangle, const char* transposed, const char* diagonal,
                      const int* rows, const int* columns, const double* alpha, const double* l,
                      const int* ld_l, double* b, const int* ld_b) {
  expect(*side == 'R' && *triangle == 'L' && *transposed == 'T' && *diagonal == 'U' && *alpha == 1.0,
         "dtrsm");
  for (int i = 0; i < *rows; i += kBlockRows)
    for (int j = 1; j < *columns; ++j)
      subtract_columns(std::min(kBlockRows, *rows - i), j, b + i, *ld_b, l + j, *ld_l,
                       b + i + static_cast<std::ptrdiff_t>(j) * *ld_b);
}

void polargrain_dtrsv(const char* triangle, const char* transposed, const char* diagonal, const int* size,
                      const double* l, const int* ld_l, double* x, const int* step) {
  expect(*triangle == 'L' && *transposed == 'N' && *diagonal == 'U' && *step == 1, "dtrsv");
  for (int j = 0; j + 1 < *size; ++j) {
    const double* column = l + static_cast<std::ptrdiff_t>(j) * *ld_l;
    for (int i = j + 1; i < *size; ++i) x[i] -= column[i] * x[j];
  }
}

void polargrain_dgemv(const char* transposed, const int* rows, const int* columns, const double* alpha,
                      const double* a, const int* ld_a, const double* x, const int* step_x,
                      const double* beta, double* y, const int* step_y) {
  expect(*transposed == 'N' && *alpha == -1.0 && *beta == 1.0 && *step_x == 1 && *step_y == 1, "dgemv");
  subtract_columns(*rows, *columns, a, *ld_a, x, 1, y);
}

void polargrain_dger(const int* rows, const int* columns, const double* alpha, const double* x,
                     const int* step_x, const double* y, const int* step_y, double* a, const int* ld_a) {
  expect(*alpha == -1.0 && *step_x == 1, "dger");
  for (int j = 0; j < *columns; ++j)
    subtract_columns(*rows, 1, x, 0, y + static_cast<std::ptrdiff_t>(j) * *step_y, 0,
                     a + static_cast<std::ptrdiff_t>(j) * *ld_a);
}
