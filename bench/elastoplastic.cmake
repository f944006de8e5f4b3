# SPDX-License-Identifier: GPL-2.0-or-later
add_executable(elastoplastic_bench elastoplastic_bench.cpp)
target_link_libraries(elastoplastic_bench PRIVATE polargrain_fem benchmark::benchmark benchmark::benchmark_main)
