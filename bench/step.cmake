# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  add_executable(step_bench step_bench.cpp)
  target_link_libraries(step_bench PRIVATE polargrain_dem fmt::fmt)
endif()
