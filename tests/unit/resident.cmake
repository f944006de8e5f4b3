# SPDX-License-Identifier: GPL-2.0-or-later
add_executable(resident_worker unit/resident_worker.cpp)
target_link_libraries(resident_worker PRIVATE polargrain_pool)

# Not of the kind `unit`: they need worker processes.
polargrain_test(resident_pool_test integration unit/resident_pool_test.cpp unit/resident_material_test.cpp LIBS polargrain_coupler)
target_compile_definitions(resident_pool_test PRIVATE RESIDENT_WORKER="$<TARGET_FILE:resident_worker>")
add_dependencies(resident_pool_test resident_worker)
if(TARGET faulty_line)
  target_compile_definitions(resident_pool_test PRIVATE FAULTY_LINE="$<TARGET_FILE:faulty_line>")
  add_dependencies(resident_pool_test faulty_line)
endif()
