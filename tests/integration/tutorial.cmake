# SPDX-License-Identifier: GPL-2.0-or-later
# The commands of docs/tutorial.md, as they stand there.
if(TARGET polargrain AND TARGET polargrain_gmsh)
  add_test(NAME tutorial COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/tutorial.sh $<TARGET_FILE:polargrain> ${PROJECT_SOURCE_DIR})
  set_tests_properties(tutorial PROPERTIES COST 500 LABELS integration TIMEOUT ${polargrain_patience})
endif()
