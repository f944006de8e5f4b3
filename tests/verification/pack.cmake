# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_tests(verification polargrain_dem MAIN support/engine_main.cpp
    verification/pack_prepare_test.cpp
    verification/pack_deposit_test.cpp
    verification/pack_loop_test.cpp)
endif()
