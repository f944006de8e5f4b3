# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(verification polargrain_fem
  verification/elastoplastic_plane_strain_test.cpp
  verification/elastoplastic_mobilised_test.cpp
  verification/elastoplastic_rate_test.cpp)
