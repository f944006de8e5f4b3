# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_tests(verification polargrain_coupler
  verification/element_laws_test.cpp)
if(TARGET polargrain)
  polargrain_tests(verification polargrain_app
    verification/safety_test.cpp)
endif()
