# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  add_executable(pack_bench pack_bench.cpp)
  target_link_libraries(pack_bench PRIVATE polargrain_dem fmt::fmt)
endif()
