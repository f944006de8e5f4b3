# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(elastoplastic_verification_test verification
                verification/elastoplastic_plane_strain_test.cpp
                verification/elastoplastic_mobilised_test.cpp
                verification/elastoplastic_rate_test.cpp LIBS polargrain_fem)
