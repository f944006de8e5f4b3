# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(coupler_messages_test unit unit/coupler_messages_test.cpp LIBS polargrain_pool)
polargrain_test(coupler_case_test unit unit/coupler_case_test.cpp LIBS polargrain_coupler)
polargrain_test(coupler_noise_test unit unit/coupler_noise_test.cpp LIBS polargrain_common)
polargrain_test(pool_parts_test unit unit/pool_parts_test.cpp LIBS polargrain_pool)
