# SPDX-License-Identifier: GPL-2.0-or-later
# The installed programs and package, from another folder and with the source tree out of sight; the Debian package; the wheel.
if(TARGET polargrain)
  add_test(NAME install COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/install.sh ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
  add_test(NAME package COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/package.sh ${PROJECT_BINARY_DIR})
  set_tests_properties(install package PROPERTIES COST 1000 LABELS integration TIMEOUT ${polargrain_patience} PROCESSORS 2)
  if(TARGET polargrain_python)
    add_test(NAME wheel COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/wheel.sh ${PROJECT_BINARY_DIR})
    set_tests_properties(wheel PROPERTIES COST 300 LABELS integration SKIP_RETURN_CODE 77 TIMEOUT ${polargrain_patience} PROCESSORS 2)
  endif()
endif()
