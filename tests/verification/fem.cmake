# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(verification polargrain_fem
  verification/fem_start_from_test.cpp
  verification/fem_stages_test.cpp
  verification/fem_dynamics_test.cpp
  verification/nodal_field_order_test.cpp
  verification/explicit_bodies_test.cpp
  verification/fem_slab_test.cpp
  verification/fem_space_test.cpp
  verification/fem_one_point_test.cpp
  verification/fem_bodies_test.cpp
  verification/fem_patch_test.cpp
  verification/fem_shear_layer_test.cpp
  verification/fem_biaxial_test.cpp
  verification/fem_softening_layer_test.cpp
  verification/spread_band_test.cpp
  verification/spread_explicit_column_test.cpp
  verification/fem_glide_layer_test.cpp
  verification/fem_hole_test.cpp
  verification/fem_footing_test.cpp
  verification/fem_cauchy_test.cpp
  verification/fem_large_test.cpp
  verification/fem_hard_cases_test.cpp)
polargrain_test(fem_many_elements_test long verification/fem_many_elements_test.cpp LIBS polargrain_fem)
polargrain_tests(verification polargrain_fem
  verification/fem_large_tangent_test.cpp)
polargrain_tests(verification polargrain_coupler
  verification/objectivity_test.cpp)
polargrain_tests(verification polargrain_fem
  verification/water_consolidation_test.cpp
  verification/water_plane_test.cpp
  verification/water_large_test.cpp
  verification/water_explicit_test.cpp)
polargrain_test(water_space_test long verification/water_space_test.cpp LIBS polargrain_fem)
polargrain_tests(verification polargrain_coupler
  verification/water_case_test.cpp
  verification/water_at_walls_test.cpp)
polargrain_tests(verification polargrain_fem
  verification/water_undrained_test.cpp)
