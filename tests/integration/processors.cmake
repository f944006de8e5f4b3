# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  add_executable(processor_probe integration/processor_probe.cpp)
  target_link_libraries(processor_probe PRIVATE polargrain_options)
  polargrain_test(processors_test integration integration/processors_test.cpp LIBS polargrain_options)
  target_compile_definitions(processors_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                     PROCESSOR_PROBE="$<TARGET_FILE:processor_probe>")
  add_dependencies(processors_test polargrain processor_probe)
endif()
