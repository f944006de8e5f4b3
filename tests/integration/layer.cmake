# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(layer_command_test integration integration/layer_command_test.cpp LIBS polargrain_app)
  target_compile_definitions(layer_command_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(layer_command_test polargrain)
endif()
