# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain AND TARGET polargrain_gmsh)
  polargrain_test(mistakes_test integration integration/mistakes_test.cpp LIBS polargrain_common)
  target_compile_definitions(mistakes_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(mistakes_test polargrain polargrain_gmsh)
endif()
