# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(record_test unit unit/record_test.cpp LIBS polargrain_pool)
target_compile_definitions(record_test PRIVATE POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
polargrain_test(coupler_messages_test unit unit/coupler_messages_test.cpp LIBS polargrain_pool)
polargrain_test(coupler_case_test unit unit/coupler_case_test.cpp LIBS polargrain_coupler)
polargrain_test(coupler_noise_test unit unit/coupler_noise_test.cpp LIBS polargrain_common)
polargrain_test(script_test unit unit/script_test.cpp LIBS polargrain_common)
target_compile_definitions(script_test PRIVATE CELL_SCRIPTS="${PROJECT_SOURCE_DIR}/liggghts_inputs/cells")
polargrain_test(pool_parts_test unit unit/pool_parts_test.cpp LIBS polargrain_pool)
