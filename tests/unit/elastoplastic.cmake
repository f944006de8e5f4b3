# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(elastoplastic_space_test unit unit/elastoplastic_space_test.cpp LIBS polargrain_fem)
polargrain_test(elastoplastic_test unit unit/elastoplastic_return_test.cpp unit/elastoplastic_law_test.cpp
                unit/elastoplastic_cone_test.cpp unit/elastoplastic_extremes_test.cpp unit/elastoplastic_mobilised_test.cpp
                LIBS polargrain_fem)
