# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_fem
  unit/checkpoint_solver_test.cpp)
