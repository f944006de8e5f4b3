# SPDX-License-Identifier: GPL-2.0-or-later
# The two of integration not under sanitizers: HDF5 itself leaks, and asks for absurd sizes, when it refuses a damaged file.
find_package(HDF5 REQUIRED COMPONENTS C)
polargrain_test(pack_file_test integration unit/pack_file_test.cpp LIBS polargrain_common ${HDF5_C_LIBRARIES})
target_include_directories(pack_file_test SYSTEM PRIVATE ${HDF5_C_INCLUDE_DIRS})
polargrain_tests(unit polargrain_app
  unit/pack_specification_test.cpp)
if(TARGET polargrain_dem)
  polargrain_tests(unit polargrain_dem
    unit/pack_sizes_test.cpp)
endif()

polargrain_test(study_packings_test integration unit/study_packings_test.cpp LIBS polargrain_common)
