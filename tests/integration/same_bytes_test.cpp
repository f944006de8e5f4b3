// SPDX-License-Identifier: GPL-2.0-or-later
// Behaviour stays: ready cases give the same bits as when tests/data/same_bytes.csv was written.
#include <gtest/gtest.h>

#include <sstream>

#include "common/csv_table.hpp"
#include "common/state.hpp"
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
  const CsvTable history(scratch.path() / "out/history.csv");
  std::istringstream names(table.cell(GetParam(), "columns"));
  std::string text;
  for (std::string name; names >> name;)
    for (std::size_t row = 0; row < history.rows(); ++row) text += history.cell(row, name) + '\n';
  EXPECT_EQ(name_of(std::as_bytes(std::span(text))).text(), table.cell(GetParam(), "name")) << file << '\n'
                                                                                            << text;
}

INSTANTIATE_TEST_SUITE_P(ReadyCases, SameBytes, ::testing::Range<std::size_t>(0, 5));

}  // namespace
}  // namespace polargrain::testing
