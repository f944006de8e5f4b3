# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(elementary_functions_test unit unit/elementary_functions_test.cpp LIBS polargrain_common)
polargrain_test(dense_kernels_test unit unit/dense_kernels_test.cpp LIBS polargrain_dense_kernels polargrain_options)
