# SPDX-License-Identifier: GPL-2.0-or-later
add_executable(coupler_bench coupler_bench.cpp)
target_link_libraries(coupler_bench PRIVATE polargrain_pool benchmark::benchmark benchmark::benchmark_main)
add_executable(coupler_scale coupler_scale.cpp)
target_link_libraries(coupler_scale PRIVATE polargrain_pool)
add_executable(resident_scale resident_scale.cpp)
target_link_libraries(resident_scale PRIVATE polargrain_coupler)
