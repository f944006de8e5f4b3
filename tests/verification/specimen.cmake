# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain-liggghts)
  foreach(what lattice layer time_step)
    polargrain_test(specimen_${what}_test verification verification/specimen_${what}_test.cpp LIBS polargrain_options)
    target_compile_definitions(specimen_${what}_test PRIVATE
      POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>" SPECIMEN_INPUTS="${PROJECT_SOURCE_DIR}/liggghts_inputs/specimen")
    add_dependencies(specimen_${what}_test polargrain-liggghts)
  endforeach()
endif()
