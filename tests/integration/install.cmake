# SPDX-License-Identifier: GPL-2.0-or-later
# The installed programs and package, from another folder and with the source tree out of sight; the Debian package.
if(TARGET polargrain)
  add_test(NAME install COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/install.sh ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
  add_test(NAME package COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/package.sh ${PROJECT_BINARY_DIR})
  set_tests_properties(install package PROPERTIES COST 1000 LABELS integration TIMEOUT ${polargrain_patience} PROCESSORS 2)
endif()
