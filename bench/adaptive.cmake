# SPDX-License-Identifier: GPL-2.0-or-later
add_executable(adaptive_bench adaptive_bench.cpp)
target_link_libraries(adaptive_bench PRIVATE polargrain_coupler)
if(TARGET polargrain_dem)
  add_executable(carry_bench carry_bench.cpp)
  target_link_libraries(carry_bench PRIVATE polargrain_coupler polargrain_dem fmt::fmt)
endif()
