# SPDX-License-Identifier: GPL-2.0-or-later
# Checks of the code by clang-format, clang-tidy and doxygen, and of words and links of the pages. clang-tidy takes seconds a file: all folders on request.
if(NOT POLARGRAIN_SANITIZE)
  set(style ${CMAKE_CURRENT_SOURCE_DIR}/style.sh)
  add_test(NAME format COMMAND ${style} format)
  add_test(NAME pages COMMAND ${style} pages)
  add_test(NAME words COMMAND ${style} words)
  add_test(NAME links COMMAND ${style} links)
  add_test(NAME keys COMMAND ${style} keys)
  add_test(NAME paper COMMAND ${style} paper)
  add_test(NAME made COMMAND ${style} made)
  add_test(NAME tidy COMMAND ${style} tidy ${PROJECT_BINARY_DIR} band common element grains_io)
  add_test(NAME tidy_all COMMAND ${style} tidy ${PROJECT_BINARY_DIR})
  set_tests_properties(format pages words links keys paper made PROPERTIES LABELS source)
  set_tests_properties(tidy PROPERTIES LABELS unit COST 100)
  set_tests_properties(format pages words links keys paper made tidy tidy_all PROPERTIES SKIP_RETURN_CODE 77
                                                                   TIMEOUT ${polargrain_patience})
  set_tests_properties(tidy_all PROPERTIES LABELS long TIMEOUT 7200)
endif()
