# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_test(contact_law_test verification verification/contact_law_test.cpp verification/contact_energy_test.cpp support/engine_main.cpp LIBS polargrain_dem fmt::fmt)
endif()
if(TARGET polargrain-liggghts)
  add_executable(liggghts_renamed_copy verification/contact_renamed_copy.cpp)
  target_link_libraries(liggghts_renamed_copy PRIVATE polargrain_contact_models)
  polargrain_test(contact_standalone_test verification verification/contact_standalone_test.cpp)
  target_compile_definitions(contact_standalone_test PRIVATE
    POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>" POLARGRAIN_RENAMED_COPY="$<TARGET_FILE:liggghts_renamed_copy>")
  add_dependencies(contact_standalone_test polargrain-liggghts liggghts_renamed_copy)
endif()
