# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  add_executable(cell_bench cell_bench.cpp)
  target_link_libraries(cell_bench PRIVATE polargrain_dem fmt::fmt)
endif()
if(TARGET polargrain_dem)
  add_executable(soft_cell_bench soft_cell_bench.cpp)
  target_link_libraries(soft_cell_bench PRIVATE polargrain_dem fmt::fmt)
endif()
