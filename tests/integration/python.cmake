# SPDX-License-Identifier: GPL-2.0-or-later
# The Python package, as it lies in the folder of the build.
if(TARGET polargrain AND TARGET polargrain_python)
  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/integration/python/*_test.py)
  foreach(file ${tests})
    get_filename_component(name ${file} NAME_WE)
    add_test(NAME python_${name} COMMAND ${Python_EXECUTABLE} -B -W error ${file}
             WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
    set_tests_properties(python_${name} PROPERTIES LABELS integration TIMEOUT ${polargrain_patience}
                         ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;POLARGRAIN_SOURCE=${PROJECT_SOURCE_DIR};POLARGRAIN_BEHAVIOUR=$<TARGET_FILE:polargrain_behaviour>")
  endforeach()
  # The demo, spheres and the tutorial whole (a minute).
  add_test(NAME python_limits_test_long COMMAND ${Python_EXECUTABLE} -B -W error ${CMAKE_CURRENT_SOURCE_DIR}/integration/python/limits_test.py --long
           WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
  set_tests_properties(python_limits_test_long PROPERTIES LABELS long TIMEOUT 7200
                       ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;POLARGRAIN_SOURCE=${PROJECT_SOURCE_DIR}")
  set_tests_properties(python_run_test python_laboratory_test python_notebook_test PROPERTIES PROCESSORS 2)  # two workers
endif()
