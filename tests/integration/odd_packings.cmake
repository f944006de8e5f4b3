# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain)
  polargrain_test(odd_packings_test integration integration/odd_packings_test.cpp LIBS polargrain_options)
  target_compile_definitions(odd_packings_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(odd_packings_test polargrain)
endif()
