# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(same_bytes_test integration integration/same_bytes_test.cpp LIBS polargrain_common)
  target_compile_definitions(same_bytes_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(same_bytes_test polargrain)
endif()
