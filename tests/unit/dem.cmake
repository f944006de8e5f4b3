# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_tests(unit polargrain_dem
    unit/dem_box_test.cpp
    unit/dem_averages_test.cpp
    unit/dem_condensed_tangent_test.cpp)
endif()
polargrain_tests(unit polargrain_discs
  unit/disc_kernels_test.cpp
  unit/sphere_kernels_test.cpp)
polargrain_tests(unit polargrain_common
  unit/packing_test.cpp)
# Spoiled states, also where there is no engine; the long test is that of a million.
polargrain_test(fuzz_states_test unit fuzz/states_test.cpp LIBS polargrain_discs)
foreach(loop Discs TheGeneralLoop)
  add_test(NAME fuzz_a_million_states_${loop} COMMAND fuzz_states_test --gtest_filter=FlippedStates.Of${loop}*
           WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(fuzz_a_million_states_${loop} PROPERTIES LABELS long TIMEOUT 7200
                       ENVIRONMENT POLARGRAIN_FUZZ_RUNS=1000000)
endforeach()
