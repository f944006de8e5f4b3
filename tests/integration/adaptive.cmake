# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(adaptive_run_test integration integration/adaptive_run_test.cpp LIBS polargrain_options)
target_compile_definitions(adaptive_run_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(adaptive_run_test fake_polargrain)

polargrain_test(bench_command_test integration integration/bench_command_test.cpp LIBS polargrain_app)
target_compile_definitions(bench_command_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>"
                                                      CASES="${PROJECT_SOURCE_DIR}/cases")
add_dependencies(bench_command_test fake_polargrain)

polargrain_test(request_sharing_test integration integration/request_sharing_test.cpp
                LIBS polargrain_pool polargrain_fake_engine)
target_compile_definitions(request_sharing_test PRIVATE FAKE_WORKER="$<TARGET_FILE:fake_worker>")
add_dependencies(request_sharing_test fake_worker)

if(TARGET polargrain)
  polargrain_test(own_weight_test integration integration/own_weight_test.cpp LIBS polargrain_options)
  target_compile_definitions(own_weight_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                     POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
  add_dependencies(own_weight_test polargrain)
endif()
