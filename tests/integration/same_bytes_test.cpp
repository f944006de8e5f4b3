// SPDX-License-Identifier: GPL-2.0-or-later
// Behaviour stays: ready cases give the same bits as when tests/data/same_bytes.csv was written.
#include <gtest/gtest.h>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;

class SameBytes : public ::testing::TestWithParam<std::size_t> {};

TEST_P(SameBytes, AsBefore) {
  const CsvTable table(kSource / "tests/data/same_bytes.csv");
  ASSERT_LT(GetParam(), table.rows());
  const std::string& file = table.cell(GetParam(), "case");
  const std::string& setting = table.cell(GetParam(), "setting");
  const Scratch scratch("same_bytes_" + std::to_string(GetParam()));
  const Outcome outcome =
      run_in(scratch.path(), POLARGRAIN " run " + (kSource / file).string() + " --quiet -o out -w 2" +
                                 (setting.empty() ? "" : " --set '" + setting + "'"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  // Columns that came later do not count.
  const CsvTable before(kSource / "tests/data/same_bytes" / (table.cell(GetParam(), "history") + ".csv"));
  const CsvTable after(scratch.path() / "out/history.csv");
  ASSERT_EQ(after.rows(), before.rows()) << file;
  for (std::size_t row = 0; row < before.rows(); ++row)
    for (const std::string& name : before.names())
      ASSERT_EQ(after.cell(row, name), before.cell(row, name)) << file << ": " << name << " in row " << row;
}

INSTANTIATE_TEST_SUITE_P(ReadyCases, SameBytes, ::testing::Range<std::size_t>(0, 5));

}  // namespace
}  // namespace polargrain::testing
