# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_fem
  unit/fem_mesh_test.cpp
  unit/fem_cylinder_test.cpp
  unit/fem_element_test.cpp
  unit/fem_supports_test.cpp
  unit/fem_linear_solver_test.cpp
  unit/fem_multilevel_test.cpp
  unit/fem_explicit_test.cpp
  unit/fem_automatic_test.cpp
  unit/fem_real_time_test.cpp
  unit/fem_solver_test.cpp
  unit/nodal_field_test.cpp
  unit/spread_slip_test.cpp
  unit/spread_explicit_test.cpp
  unit/fem_noise_test.cpp
  unit/fem_probe_test.cpp
  unit/fem_output_test.cpp)
if(TARGET polargrain_gmsh)
  polargrain_test(fem_gmsh_test unit unit/fem_gmsh_test.cpp unit/fem_gmsh_space_test.cpp support/sanitizer_defaults.cpp LIBS polargrain_fem)
  add_dependencies(fem_gmsh_test polargrain_gmsh)
endif()
polargrain_tests(unit polargrain_fem
  unit/fem_geostatic_test.cpp)
