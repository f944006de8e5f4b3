# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain AND TARGET polargrain-liggghts)
  polargrain_test(sphere_run_test integration integration/sphere_run_test.cpp LIBS polargrain_common)
  target_compile_definitions(sphere_run_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                     POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>")
  add_dependencies(sphere_run_test polargrain polargrain-liggghts)
  polargrain_test(space_run_test integration integration/space_run_test.cpp LIBS polargrain_common)
  target_compile_definitions(space_run_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(space_run_test polargrain)
endif()
