# SPDX-License-Identifier: GPL-2.0-or-later
find_package(nlohmann_json REQUIRED)
if(TARGET polargrain)
  polargrain_test(remarks_command_test integration integration/remarks_command_test.cpp LIBS polargrain_common nlohmann_json::nlohmann_json)
  target_compile_definitions(remarks_command_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                          POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
  add_dependencies(remarks_command_test polargrain)
endif()
if(TARGET polargrain)
  polargrain_test(ground_engine_test integration integration/ground_engine_test.cpp LIBS polargrain_common nlohmann_json::nlohmann_json)
  target_compile_definitions(ground_engine_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                                                        POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
  add_dependencies(ground_engine_test polargrain)
endif()
