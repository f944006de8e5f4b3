# SPDX-License-Identifier: GPL-2.0-or-later
find_package(nlohmann_json REQUIRED)
polargrain_test(report_command_test integration integration/report_command_test.cpp
                LIBS polargrain_options nlohmann_json::nlohmann_json)
target_compile_definitions(report_command_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>"
                                                       HTML_CHECK="${CMAKE_CURRENT_SOURCE_DIR}/support/check_html.py")
add_dependencies(report_command_test fake_polargrain)
