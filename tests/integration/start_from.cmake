# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(start_from_command_test integration integration/start_from_command_test.cpp LIBS polargrain_common)
  target_compile_definitions(start_from_command_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(start_from_command_test polargrain)
endif()
