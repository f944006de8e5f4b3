# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(band_command_test integration integration/band_command_test.cpp LIBS polargrain_band fmt::fmt)
  target_compile_definitions(band_command_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(band_command_test polargrain)
  # Three minutes and more: on request.
  foreach(size test long)
    set(label integration)
    if(size STREQUAL long)
      set(label long)
    endif()
    polargrain_test(specimen_${size} ${label} integration/specimen_${size}.cpp LIBS polargrain_options fmt::fmt)
    target_compile_definitions(specimen_${size} PRIVATE
      POLARGRAIN="$<TARGET_FILE:polargrain>" POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>"
      SPECIMEN_INPUTS="${PROJECT_SOURCE_DIR}/liggghts_inputs/specimen")
    add_dependencies(specimen_${size} polargrain polargrain-liggghts)
  endforeach()
endif()
