# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_common
  unit/elementary_functions_test.cpp)
polargrain_test(dense_kernels_test unit unit/dense_kernels_test.cpp LIBS polargrain_dense_kernels polargrain_options)
