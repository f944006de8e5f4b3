# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_tests(unit polargrain_dem
    unit/specimen_membrane_test.cpp)
endif()
