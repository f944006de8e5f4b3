# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  foreach(test layer_command_test interface_command_test)
    polargrain_test(${test} integration integration/${test}.cpp LIBS polargrain_app)
    target_compile_definitions(${test} PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
    add_dependencies(${test} polargrain)
  endforeach()
endif()
