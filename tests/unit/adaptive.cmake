# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(adaptive_material_test unit unit/adaptive_material_test.cpp LIBS polargrain_coupler)
polargrain_test(adaptive_turn_test unit unit/adaptive_turn_test.cpp LIBS polargrain_coupler)
polargrain_test(adaptive_cosserat_test unit unit/adaptive_cosserat_test.cpp LIBS polargrain_coupler)
polargrain_test(couple_limit_test unit unit/couple_limit_test.cpp LIBS polargrain_coupler)
polargrain_test(space_cosserat_part_test unit unit/space_cosserat_part_test.cpp LIBS polargrain_coupler)
polargrain_test(space_cells_test unit unit/space_cells_test.cpp LIBS polargrain_coupler)
polargrain_test(skew_limit_test unit unit/skew_limit_test.cpp LIBS polargrain_coupler)
polargrain_test(adaptive_parts_test unit unit/adaptive_parts_test.cpp LIBS polargrain_coupler)
