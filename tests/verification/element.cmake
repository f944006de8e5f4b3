# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(element_laws_test verification verification/element_laws_test.cpp LIBS polargrain_coupler)
if(TARGET polargrain)
  polargrain_test(safety_test verification verification/safety_test.cpp LIBS polargrain_app)
endif()
