# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(new_command_test integration integration/new_command_test.cpp LIBS polargrain_common)
  target_compile_definitions(new_command_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(new_command_test polargrain)
  if(TARGET polargrain_gmsh)
    add_dependencies(new_command_test polargrain_gmsh)
  endif()
endif()
