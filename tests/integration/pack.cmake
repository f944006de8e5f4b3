# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain AND TARGET polargrain-liggghts)
  polargrain_test(pack_command_test integration integration/pack_command_test.cpp LIBS polargrain_options)
  target_compile_definitions(pack_command_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                       POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>")
  add_dependencies(pack_command_test polargrain polargrain-liggghts)
endif()
