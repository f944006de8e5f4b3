# SPDX-License-Identifier: GPL-2.0-or-later
add_executable(fem_bench fem_bench.cpp)
target_link_libraries(fem_bench PRIVATE polargrain_fem benchmark::benchmark)

add_executable(space_solve_bench space_solve_bench.cpp)
target_link_libraries(space_solve_bench PRIVATE polargrain_fem fmt::fmt)
