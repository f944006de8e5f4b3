# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_tests(verification polargrain_dem MAIN support/engine_main.cpp
    verification/dem_paths_test.cpp
    verification/dem_lattice_test.cpp
    verification/dem_cell_test.cpp
    verification/resident_boxes_test.cpp
    verification/dem_tangent_test.cpp
    verification/dem_two_cells_test.cpp
    verification/dem_rowe_test.cpp
    verification/dem_limits_test.cpp
    verification/dem_polar_test.cpp
    verification/sphere_paths_test.cpp
    verification/sphere_cell_test.cpp
    verification/sphere_tangent_test.cpp
    verification/sphere_cosserat_test.cpp
    verification/sphere_rowe_test.cpp
    verification/sphere_lattice_test.cpp
    verification/disc_loop_test.cpp
    verification/sphere_loop_test.cpp)
  polargrain_test(spoiled_states_test verification verification/spoiled_states_test.cpp support/engine_main.cpp LIBS polargrain_dem)
  foreach(kind OfTheGeneralLoopInTheGeneralLoop OfDiscsInTheGeneralLoop OfDiscsInTheirLoop)
    add_test(NAME a_million_states_${kind} COMMAND spoiled_states_test --gtest_filter=*/${kind}
             WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(a_million_states_${kind} PROPERTIES LABELS long TIMEOUT 14400
                         ENVIRONMENT POLARGRAIN_FUZZ_RUNS=1000000)
  endforeach()
  polargrain_tests(verification polargrain_contact_models MAIN support/engine_main.cpp
    verification/dem_masses_test.cpp
    verification/dem_time_step_test.cpp
    verification/engine_pass_test.cpp)
endif()
