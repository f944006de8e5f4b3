# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain-liggghts)
  polargrain_test(specimen_lattice_test verification verification/specimen_lattice_test.cpp LIBS polargrain_options)
  target_compile_definitions(specimen_lattice_test PRIVATE
    POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>" SPECIMEN_INPUTS="${PROJECT_SOURCE_DIR}/liggghts_inputs/specimen")
  add_dependencies(specimen_lattice_test polargrain-liggghts)
endif()
