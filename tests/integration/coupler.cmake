# SPDX-License-Identifier: GPL-2.0-or-later
add_library(polargrain_fake_engine STATIC integration/fake_engine.cpp integration/tries.cpp)
target_link_libraries(polargrain_fake_engine PUBLIC polargrain_grains_io)

add_executable(fake_worker integration/fake_worker.cpp)
target_link_libraries(fake_worker PRIVATE polargrain_pool polargrain_fake_engine)

polargrain_test(coupler_pool_test integration integration/coupler_pool_test.cpp integration/coupler_pool_failures_test.cpp
                LIBS polargrain_pool polargrain_fake_engine)
target_compile_definitions(coupler_pool_test PRIVATE FAKE_WORKER="$<TARGET_FILE:fake_worker>")
add_dependencies(coupler_pool_test fake_worker)

add_executable(fake_polargrain integration/fake_polargrain.cpp)
target_link_libraries(fake_polargrain PRIVATE polargrain_app polargrain_fake_engine)

polargrain_test(coupler_bad_input_test integration integration/coupler_bad_input_test.cpp integration/kept_files_test.cpp LIBS polargrain_options)
target_compile_definitions(coupler_bad_input_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(coupler_bad_input_test fake_polargrain)

polargrain_test(coupler_run_test integration integration/coupler_run_test.cpp LIBS polargrain_options)
target_compile_definitions(coupler_run_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(coupler_run_test fake_polargrain)

if(TARGET polargrain_gmsh)
  polargrain_test(coupler_cases_test integration integration/coupler_cases_test.cpp LIBS polargrain_options)
  target_compile_definitions(coupler_cases_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
  add_dependencies(coupler_cases_test fake_polargrain polargrain_gmsh)
endif()

polargrain_test(coupler_cell_material_test integration integration/coupler_cell_material_test.cpp
                LIBS polargrain_coupler polargrain_fake_engine)
target_compile_definitions(coupler_cell_material_test PRIVATE FAKE_WORKER="$<TARGET_FILE:fake_worker>")
add_dependencies(coupler_cell_material_test fake_worker)

if(TARGET polargrain)
  polargrain_test(coupler_engine_test integration integration/coupler_engine_test.cpp LIBS polargrain_coupler)
  target_compile_definitions(coupler_engine_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(coupler_engine_test polargrain)
endif()
