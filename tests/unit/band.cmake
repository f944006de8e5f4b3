# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_band
  unit/band_test.cpp
  unit/shear_plane_test.cpp)
