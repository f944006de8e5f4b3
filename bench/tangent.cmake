# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  # UMFPACK as a yardstick only; fem/ has found it already.
  add_executable(tangent_bench tangent_bench.cpp)
  target_include_directories(tangent_bench SYSTEM PRIVATE ${UMFPACK_INCLUDE_DIR})
  target_link_libraries(tangent_bench PRIVATE polargrain_dem fmt::fmt ${UMFPACK_LIBRARY})
endif()
