# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  add_executable(sphere_bench sphere_bench.cpp)
  target_link_libraries(sphere_bench PRIVATE polargrain_dem fmt::fmt)
endif()
