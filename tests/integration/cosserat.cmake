# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(cosserat_runs_test integration integration/cosserat_runs_test.cpp LIBS polargrain_options Threads::Threads)
  target_compile_definitions(cosserat_runs_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                        POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
  add_dependencies(cosserat_runs_test polargrain)
  polargrain_test(spread_cells_test integration integration/spread_cells_test.cpp LIBS polargrain_options Threads::Threads)
  target_compile_definitions(spread_cells_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                       POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
  add_dependencies(spread_cells_test polargrain)
  polargrain_test(explicit_run_test integration integration/explicit_run_test.cpp LIBS polargrain_options Threads::Threads)
  target_compile_definitions(explicit_run_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                       POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
  add_dependencies(explicit_run_test polargrain)
  foreach(name automatic_run_test dynamics_run_test)
    polargrain_test(${name} integration integration/${name}.cpp LIBS polargrain_options Threads::Threads nlohmann_json::nlohmann_json)
    target_compile_definitions(${name} PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                               POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
    add_dependencies(${name} polargrain)
  endforeach()
endif()
