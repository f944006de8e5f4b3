# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(informed_mobilisation_test unit unit/informed_mobilisation_test.cpp LIBS polargrain_fem)
polargrain_test(unloading_test unit unit/unloading_test.cpp LIBS polargrain_fem)
polargrain_test(informed_cosserat_test unit unit/informed_cosserat_test.cpp LIBS polargrain_coupler)
polargrain_test(own_answer_test unit unit/own_answer_test.cpp LIBS polargrain_coupler)
polargrain_test(gathered_material_test unit unit/gathered_material_test.cpp LIBS polargrain_coupler)
polargrain_test(informed_material_test unit unit/informed_material_test.cpp LIBS polargrain_coupler)
