# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_hosts
  unit/keys_test.cpp)
polargrain_tests(unit polargrain_pool
  unit/record_test.cpp
  unit/coupler_messages_test.cpp)
polargrain_tests(unit polargrain_coupler
  unit/stages_case_test.cpp
  unit/coupler_case_test.cpp
  unit/continuum_case_test.cpp
  unit/document_kind_test.cpp
  unit/defaults_test.cpp
  unit/cell_increment_test.cpp
  unit/secant_tangent_test.cpp
  unit/network_moduli_test.cpp)
polargrain_tests(unit polargrain_app
  unit/calibration_points_test.cpp
  unit/defaults_text_test.cpp
  unit/envelope_test.cpp)
polargrain_tests(unit polargrain_common
  unit/coupler_noise_test.cpp)
polargrain_tests(unit polargrain_coupler
  unit/ground_start_test.cpp)
polargrain_tests(unit polargrain_grains_io
  unit/script_test.cpp)
polargrain_tests(unit polargrain_pool
  unit/pool_parts_test.cpp
  unit/processor_share_test.cpp)
polargrain_tests(unit polargrain_common
  unit/plane_in_space_test.cpp)
