# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(checkpoint_solver_test unit unit/checkpoint_solver_test.cpp LIBS polargrain_fem)
