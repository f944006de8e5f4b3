# SPDX-License-Identifier: GPL-2.0-or-later
find_package(nlohmann_json REQUIRED)
polargrain_tests(unit polargrain_common
  unit/csv_table_test.cpp)
polargrain_test(written_files_test unit unit/written_files_test.cpp LIBS polargrain_app nlohmann_json::nlohmann_json)
