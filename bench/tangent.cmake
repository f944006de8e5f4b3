# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  # The distribution's UMFPACK with the system's BLAS, as a yardstick only.
  find_library(STOCK_UMFPACK_LIBRARY umfpack REQUIRED)
  add_executable(tangent_bench tangent_bench.cpp)
  target_include_directories(tangent_bench SYSTEM PRIVATE ${UMFPACK_INCLUDE_DIR})
  target_link_libraries(tangent_bench PRIVATE polargrain_dem fmt::fmt ${STOCK_UMFPACK_LIBRARY})
  add_executable(disc_tangent_bench disc_tangent_bench.cpp)
  target_link_libraries(disc_tangent_bench PRIVATE polargrain_dem fmt::fmt)
endif()
