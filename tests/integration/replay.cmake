# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain-liggghts)
  polargrain_test(replay_test integration integration/replay_test.cpp support/engine_main.cpp
                  LIBS polargrain_dem polargrain_pool fmt::fmt)
  target_compile_definitions(replay_test PRIVATE POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>"
                                                 POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(replay_test polargrain polargrain-liggghts)
endif()
