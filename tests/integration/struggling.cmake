# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain AND TARGET polargrain_gmsh)
  polargrain_test(struggling_test long integration/struggling_test.cpp LIBS polargrain_common)
  target_compile_definitions(struggling_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(struggling_test polargrain polargrain_gmsh)
endif()
