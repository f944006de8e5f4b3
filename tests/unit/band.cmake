# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(band_test unit unit/band_test.cpp LIBS polargrain_band)
polargrain_test(shear_plane_test unit unit/shear_plane_test.cpp LIBS polargrain_band)
