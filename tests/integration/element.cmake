# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(element_command_test integration integration/element_command_test.cpp LIBS polargrain_common)
target_compile_definitions(element_command_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(element_command_test fake_polargrain)
if(TARGET polargrain)
  polargrain_test(element_engine_test integration integration/element_engine_test.cpp LIBS polargrain_common)
  target_compile_definitions(element_engine_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(element_engine_test polargrain)
endif()

polargrain_test(calibrate_command_test integration integration/calibrate_command_test.cpp LIBS polargrain_common)
target_compile_definitions(calibrate_command_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(calibrate_command_test fake_polargrain)

polargrain_test(ask_together_test integration integration/ask_together_test.cpp LIBS polargrain_coupler polargrain_fake_engine)
target_compile_definitions(ask_together_test PRIVATE FAKE_WORKER="$<TARGET_FILE:fake_worker>")
add_dependencies(ask_together_test fake_worker)
