# SPDX-License-Identifier: GPL-2.0-or-later
# Files that `cmake --install` adds to the programs: documentation, and the CMake package with which a contact law of the
# user's own is built (docs/own_contact_law). Such a law needs headers only: the program that loads it has the rest.
include(CMakePackageConfigHelpers)

set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/polargrain)
set(header_directory ${CMAKE_INSTALL_INCLUDEDIR}/polargrain)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
        PATTERN "*.py" EXCLUDE PATTERN Doxyfile EXCLUDE)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(POLARGRAIN_ENGINE)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/dem/contact ${PROJECT_SOURCE_DIR}/dem/engine DESTINATION ${header_directory}/dem
          FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h"
          # Of the program alone.
          PATTERN contact_pair.hpp EXCLUDE
          PATTERN engine.hpp EXCLUDE PATTERN private_access.hpp EXCLUDE PATTERN extension.hpp EXCLUDE)
  configure_package_config_file(cmake/polargrainConfig.cmake.in ${PROJECT_BINARY_DIR}/polargrainConfig.cmake
                                INSTALL_DESTINATION ${package_directory} PATH_VARS header_directory)
  # A library of contact laws fits the version that it was compiled for alone.
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/polargrainConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/polargrainConfig.cmake ${PROJECT_BINARY_DIR}/polargrainConfigVersion.cmake
                cmake/polargrain_contact_laws.cmake DESTINATION ${package_directory})
endif()

if(TARGET polargrain_python)  # its module is of one version of the interpreter
  string(REPLACE "." ";" parts ${python_version})
  list(GET parts 1 minor)
  math(EXPR next "${minor} + 1")
  set(python_package "python3 (>= ${python_version}), python3 (<< 3.${next}), python3-numpy, ")
else()
  set(python_package "python3, ")  # studies and specimen.py
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME polargrain)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib, jupyter-notebook, python3-scipy")  # tables, studies
set(CPACK_PACKAGE_CONTACT "polargrain developers <polargrain@localhost>")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "${python_package}g++, cmake, ninja-build, libliggghts-dev, libopenmpi-dev, libeigen3-dev")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
