// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The dense matrix work inside UMFPACK, by five routines of ours in place of the system's BLAS, whose sums
/// have another order, and other last bits, on every type of processor. Here every number of a result is made
/// by the same operations in the same order whatever the processor: wider registers compute more numbers at a
/// time, never one number in another way, and nothing is fused.
///
/// Names, arguments and meaning are those of the BLAS (columns one after the other, `ld` numbers from a
/// column to the next), but only for the kinds of call that UMFPACK makes (its blas3_update and
/// local_search); any other ends the program. The build renames UMFPACK's calls, so that no other library of
/// the process is touched.
extern "C" {

/// C -= A B^T with C rows x columns, A rows x depth, B columns x depth (sides N and T, alpha -1, beta 1).
void polargrain_dgemm(const char* side_a, const char* side_b, const int* rows, const int* columns,
                      const int* depth, const double* alpha, const double* a, const int* ld_a,
                      const double* b, const int* ld_b, const double* beta, double* c, const int* ld_c);

/// B := X with X L^T = B, L lower triangular with a unit diagonal (R, L, T, U; alpha 1).
void polargrain_dtrsm(const char* side, const char* triangle, const char* transposed, const char* diagonal,
                      const int* rows, const int* columns, const double* alpha, const double* l,
                      const int* ld_l, double* b, const int* ld_b);

/// x := L^-1 x, L lower triangular with a unit diagonal (L, N, U; step 1).
void polargrain_dtrsv(const char* triangle, const char* transposed, const char* diagonal, const int* size,
                      const double* l, const int* ld_l, double* x, const int* step);

/// y -= A x (N; alpha -1, beta 1, steps 1).
void polargrain_dgemv(const char* transposed, const int* rows, const int* columns, const double* alpha,
                      const double* a, const int* ld_a, const double* x, const int* step_x,
                      const double* beta, double* y, const int* step_y);

/// A -= x y^T (alpha -1, step of x 1, any step of y).
void polargrain_dger(const int* rows, const int* columns, const double* alpha, const double* x,
                     const int* step_x, const double* y, const int* step_y, double* a, const int* ld_a);
}
