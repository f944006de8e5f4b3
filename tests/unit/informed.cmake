# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_fem
  unit/informed_mobilisation_test.cpp
  unit/unloading_test.cpp)
polargrain_tests(unit polargrain_coupler
  unit/informed_cosserat_test.cpp
  unit/own_answer_test.cpp
  unit/gathered_material_test.cpp
  unit/informed_material_test.cpp)
