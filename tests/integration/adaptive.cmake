# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(adaptive_run_test integration integration/adaptive_run_test.cpp LIBS polargrain_options)
target_compile_definitions(adaptive_run_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(adaptive_run_test fake_polargrain)

polargrain_test(bench_command_test integration integration/bench_command_test.cpp LIBS polargrain_app)
target_compile_definitions(bench_command_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(bench_command_test fake_polargrain)

polargrain_test(request_sharing_test integration integration/request_sharing_test.cpp
                LIBS polargrain_pool polargrain_fake_engine)
target_compile_definitions(request_sharing_test PRIVATE FAKE_WORKER="$<TARGET_FILE:fake_worker>")
add_dependencies(request_sharing_test fake_worker)

if(TARGET polargrain)
  foreach(topic own_weight large_shear)
    polargrain_test(${topic}_test integration integration/${topic}_test.cpp LIBS polargrain_options)
    target_compile_definitions(${topic}_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
    add_dependencies(${topic}_test polargrain)
  endforeach()
endif()
