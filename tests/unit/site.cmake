# SPDX-License-Identifier: GPL-2.0-or-later
# The documentation as pages: a link that leads nowhere fails. Skipped (77) where there is no mkdocs.
if(NOT POLARGRAIN_SANITIZE)
  add_test(NAME site COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/../cmake/make_site.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/site_test)
  set_tests_properties(site PROPERTIES LABELS source SKIP_RETURN_CODE 77 TIMEOUT ${polargrain_patience})
endif()
