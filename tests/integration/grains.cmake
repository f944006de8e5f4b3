# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(grains_command_test integration integration/grains_command_test.cpp LIBS polargrain_fem)
  target_compile_definitions(grains_command_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                         GRAINS_READER="${CMAKE_CURRENT_SOURCE_DIR}/integration/grains_read.py")
  add_dependencies(grains_command_test polargrain)
endif()
