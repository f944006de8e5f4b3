# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(unit polargrain_app
  unit/soft_contacts_test.cpp
  unit/layer_test.cpp
  unit/wall_test.cpp)
