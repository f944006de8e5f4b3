# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(informed_case_test integration integration/informed_case_test.cpp LIBS polargrain_options)
target_compile_definitions(informed_case_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(informed_case_test fake_polargrain)

if(TARGET polargrain)
  polargrain_test(informed_engine_test integration integration/informed_engine_test.cpp LIBS polargrain_coupler)
  target_compile_definitions(informed_engine_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(informed_engine_test polargrain)
  polargrain_test(water_engine_test integration integration/water_engine_test.cpp LIBS polargrain_coupler)
  target_compile_definitions(water_engine_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(water_engine_test polargrain)
  polargrain_test(large_engine_test integration integration/large_engine_test.cpp LIBS polargrain_coupler)
  target_compile_definitions(large_engine_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(large_engine_test polargrain)
endif()
if(TARGET polargrain AND TARGET polargrain-liggghts)
  polargrain_test(informed_studies_test integration integration/informed_studies_test.cpp LIBS polargrain_options)
  target_compile_definitions(informed_studies_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                           POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>")
  add_dependencies(informed_studies_test polargrain polargrain-liggghts)
  # Packings, a calibration and predictions of 50 spheres take a quarter of a minute.
  polargrain_test(toyoura_study_test long integration/toyoura_study_test.cpp LIBS polargrain_common)
  target_compile_definitions(toyoura_study_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(toyoura_study_test polargrain)
  # Spheres that fell and spheres pressed together, two void ratios each (a third of a minute). What is there of an earlier run would be taken as it is.
  add_test(NAME ToyouraPreparation.Anew COMMAND ${CMAKE_COMMAND} -E rm -rf ${CMAKE_CURRENT_BINARY_DIR}/toyoura_preparation)
  add_test(NAME ToyouraPreparation.LooserPackingsAreWeaker COMMAND /usr/bin/python3
           ${PROJECT_SOURCE_DIR}/cases/studies/toyoura/preparation.py --check --ways fell pressed --grains 80 --packings 2
           --frictions 0.1 0.5 --strain 3 -o ${CMAKE_CURRENT_BINARY_DIR}/toyoura_preparation --program $<TARGET_FILE:polargrain>)
  set_tests_properties(ToyouraPreparation.Anew PROPERTIES LABELS long FIXTURES_SETUP toyoura_preparation)
  set_tests_properties(ToyouraPreparation.LooserPackingsAreWeaker PROPERTIES LABELS long TIMEOUT ${polargrain_patience} FIXTURES_REQUIRED toyoura_preparation)
endif()
