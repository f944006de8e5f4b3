# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(careless_test unit unit/careless_test.cpp unit/careless_odd_test.cpp unit/careless_faults_test.cpp unit/careless_further_test.cpp unit/careless_stages_test.cpp unit/careless_features_test.cpp unit/careless_water_test.cpp unit/careless_space_test.cpp unit/careless_motions_test.cpp unit/careless_moments_test.cpp LIBS polargrain_app)
if(TARGET polargrain_gmsh)
  target_compile_definitions(careless_test PRIVATE POLARGRAIN_HAS_GMSH)
  add_dependencies(careless_test polargrain_gmsh)
endif()
