# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(fem_mesh_test unit unit/fem_mesh_test.cpp LIBS polargrain_fem)
polargrain_test(fem_element_test unit unit/fem_element_test.cpp LIBS polargrain_fem)
polargrain_test(fem_supports_test unit unit/fem_supports_test.cpp LIBS polargrain_fem)
polargrain_test(fem_solver_test unit unit/fem_solver_test.cpp LIBS polargrain_fem)
polargrain_test(fem_noise_test unit unit/fem_noise_test.cpp LIBS polargrain_fem)
polargrain_test(fem_output_test unit unit/fem_output_test.cpp LIBS polargrain_fem)
target_compile_definitions(fem_output_test
                           PRIVATE VTK_READER="${CMAKE_CURRENT_SOURCE_DIR}/unit/fem_output_read.py")
if(TARGET polargrain_gmsh)
  polargrain_test(fem_gmsh_test unit unit/fem_gmsh_test.cpp support/sanitizer_defaults.cpp LIBS polargrain_fem)
  add_dependencies(fem_gmsh_test polargrain_gmsh)
endif()
polargrain_test(fem_geostatic_test unit unit/fem_geostatic_test.cpp LIBS polargrain_fem)
