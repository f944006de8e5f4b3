# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(interface_test verification verification/interface_test.cpp LIBS polargrain_fem)
polargrain_test(beam_test verification verification/beam_test.cpp LIBS polargrain_fem)
polargrain_test(retaining_wall_test verification verification/retaining_wall_test.cpp LIBS polargrain_coupler)
polargrain_test(structure_stages_test verification verification/structure_stages_test.cpp LIBS polargrain_coupler)
polargrain_test(rough_wall_test long verification/rough_wall_test.cpp LIBS polargrain_coupler)
