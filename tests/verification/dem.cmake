# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_test(dem_paths_test verification verification/dem_paths_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(dem_lattice_test verification verification/dem_lattice_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(dem_cell_test verification verification/dem_cell_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(resident_boxes_test verification verification/resident_boxes_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(dem_tangent_test verification verification/dem_tangent_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(dem_two_cells_test verification verification/dem_two_cells_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(dem_rowe_test verification verification/dem_rowe_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(dem_limits_test verification verification/dem_limits_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(dem_polar_test verification verification/dem_polar_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(sphere_paths_test verification verification/sphere_paths_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(sphere_cell_test verification verification/sphere_cell_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(sphere_tangent_test verification verification/sphere_tangent_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(sphere_cosserat_test verification verification/sphere_cosserat_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(sphere_rowe_test verification verification/sphere_rowe_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(sphere_lattice_test verification verification/sphere_lattice_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(disc_loop_test verification verification/disc_loop_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(sphere_loop_test verification verification/sphere_loop_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  polargrain_test(spoiled_states_test verification verification/spoiled_states_test.cpp support/engine_main.cpp
                  LIBS polargrain_dem)
  foreach(kind OfTheGeneralLoopInTheGeneralLoop OfDiscsInTheGeneralLoop OfDiscsInTheirLoop)
    add_test(NAME a_million_states_${kind} COMMAND spoiled_states_test --gtest_filter=*/${kind}
             WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(a_million_states_${kind} PROPERTIES LABELS long TIMEOUT 14400
                         ENVIRONMENT POLARGRAIN_FUZZ_RUNS=1000000)
  endforeach()
  polargrain_test(dem_masses_test verification verification/dem_masses_test.cpp support/engine_main.cpp
                  LIBS polargrain_contact_models)
  polargrain_test(dem_time_step_test verification verification/dem_time_step_test.cpp support/engine_main.cpp
                  LIBS polargrain_contact_models)
endif()
