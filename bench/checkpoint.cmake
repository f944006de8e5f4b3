# SPDX-License-Identifier: GPL-2.0-or-later
add_executable(checkpoint_bench checkpoint_bench.cpp)
target_link_libraries(checkpoint_bench PRIVATE polargrain_coupler)
