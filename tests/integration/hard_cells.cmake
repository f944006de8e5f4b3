# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(hard_cells_test long integration/hard_cells_test.cpp LIBS polargrain_options)
  target_compile_definitions(hard_cells_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(hard_cells_test polargrain)
endif()
