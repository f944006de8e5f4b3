# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(mesh_split_test unit unit/mesh_split_test.cpp LIBS polargrain_fem)
polargrain_test(interface_law_test unit unit/interface_law_test.cpp LIBS polargrain_fem)
polargrain_test(profiles_case_test unit unit/profiles_case_test.cpp LIBS polargrain_coupler)
polargrain_test(structures_case_test unit unit/structures_case_test.cpp LIBS polargrain_coupler)
polargrain_test(water_faults_test unit unit/water_faults_test.cpp LIBS polargrain_coupler)
