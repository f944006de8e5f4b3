# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_coupler
  unit/adaptive_material_test.cpp
  unit/adaptive_turn_test.cpp
  unit/adaptive_cosserat_test.cpp
  unit/couple_limit_test.cpp
  unit/space_cosserat_part_test.cpp
  unit/space_cells_test.cpp
  unit/skew_limit_test.cpp
  unit/adaptive_parts_test.cpp)
