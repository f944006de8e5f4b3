// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {

using Csv = CsvTable;

}  // namespace polargrain::testing
