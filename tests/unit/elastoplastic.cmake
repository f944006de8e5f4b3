# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_fem
  unit/elastoplastic_space_test.cpp
  unit/elastoplastic_return_test.cpp
  unit/elastoplastic_law_test.cpp
  unit/elastoplastic_cone_test.cpp
  unit/elastoplastic_extremes_test.cpp
  unit/elastoplastic_mobilised_test.cpp)
