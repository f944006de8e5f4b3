# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_test(dem_box_test unit unit/dem_box_test.cpp LIBS polargrain_dem)
  polargrain_test(dem_averages_test unit unit/dem_averages_test.cpp LIBS polargrain_dem)
  polargrain_test(dem_condensed_tangent_test unit unit/dem_condensed_tangent_test.cpp LIBS polargrain_dem)
endif()
polargrain_test(packing_test unit unit/packing_test.cpp LIBS polargrain_common)
