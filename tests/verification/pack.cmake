# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain_dem)
  polargrain_test(pack_prepare_test verification verification/pack_prepare_test.cpp support/engine_main.cpp
                  LIBS polargrain_dem fmt::fmt)
  polargrain_test(pack_deposit_test verification verification/pack_deposit_test.cpp support/engine_main.cpp
                  LIBS polargrain_dem fmt::fmt)
  polargrain_test(pack_loop_test verification verification/pack_loop_test.cpp support/engine_main.cpp
                  LIBS polargrain_dem fmt::fmt)
endif()
