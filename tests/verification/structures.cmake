# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(verification polargrain_fem
  verification/interface_test.cpp
  verification/beam_test.cpp)
polargrain_tests(verification polargrain_coupler
  verification/retaining_wall_test.cpp
  verification/structure_stages_test.cpp
  verification/walls_that_meet_test.cpp)
polargrain_test(rough_wall_test long verification/rough_wall_test.cpp LIBS polargrain_coupler)
