# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain-liggghts AND TARGET liggghts_compiled_copy)
  add_executable(contact_loop contact_loop.cpp)
  target_link_libraries(contact_loop PRIVATE fmt::fmt)
  target_compile_definitions(contact_loop PRIVATE
    POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>" POLARGRAIN_COMPILED_COPY="$<TARGET_FILE:liggghts_compiled_copy>")
  add_dependencies(contact_loop polargrain-liggghts liggghts_compiled_copy)
endif()
