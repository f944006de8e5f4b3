# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain-liggghts)
  add_executable(contact_loop contact_loop.cpp)
  target_link_libraries(contact_loop PRIVATE fmt::fmt)
  target_compile_definitions(contact_loop PRIVATE POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>")
  add_dependencies(contact_loop polargrain-liggghts)
endif()
