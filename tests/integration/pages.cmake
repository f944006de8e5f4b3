# SPDX-License-Identifier: GPL-2.0-or-later
# The commands of README.md, of the tutorials and of the recipes, as they stand there; a test a page.
if(TARGET polargrain AND TARGET polargrain_gmsh AND TARGET polargrain-liggghts AND TARGET polargrain_python)
  file(GLOB recipes CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/docs/howto/*.md)
  list(REMOVE_ITEM recipes docs/howto/README.md)
  foreach(page README.md docs/tutorial.md docs/tutorial_yade.md docs/tutorial_fem.md ${recipes})
    get_filename_component(name ${page} NAME_WE)
    add_test(NAME page_${name}
             COMMAND ${Python_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/integration/run_page.py $<TARGET_FILE:polargrain>
                     $<TARGET_FILE:polargrain-liggghts> ${PROJECT_BINARY_DIR}/python ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/${page})
    set_tests_properties(page_${name} PROPERTIES LABELS integration TIMEOUT ${polargrain_patience})
  endforeach()
endif()
