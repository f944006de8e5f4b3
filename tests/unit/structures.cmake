# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_fem
  unit/mesh_split_test.cpp
  unit/interface_law_test.cpp)
polargrain_tests(unit polargrain_coupler
  unit/profiles_case_test.cpp
  unit/structures_case_test.cpp
  unit/water_faults_test.cpp)
