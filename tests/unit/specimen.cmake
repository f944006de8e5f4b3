# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_test(specimen_membrane_test unit unit/specimen_membrane_test.cpp LIBS polargrain_dem)
endif()
