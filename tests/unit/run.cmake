# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(soft_contacts_test unit unit/soft_contacts_test.cpp LIBS polargrain_app)
polargrain_test(layer_test unit unit/layer_test.cpp LIBS polargrain_app)
polargrain_test(wall_test unit unit/wall_test.cpp LIBS polargrain_app)
