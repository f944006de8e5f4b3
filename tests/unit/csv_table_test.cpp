// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/csv_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/error.hpp"

namespace polargrain {
namespace {

class CsvTableTest : public ::testing::Test {
 protected:
  CsvTableTest()
      : file_(std::filesystem::path(::testing::TempDir()) /
              (std::string("table_") + ::testing::UnitTest::GetInstance()->current_test_info()->name())) {}
  ~CsvTableTest() override { std::filesystem::remove(file_); }
  CsvTable table(const std::string& text) {
    std::ofstream(file_) << text;
    return CsvTable(file_);
  }
  /// Line and message of the fault that reading `text` and taking column b as numbers has.
  std::string fault(const std::string& text) {
    try {
      (void)table(text).numbers("b");
    } catch (const InputError& error) {
      return std::to_string(error.faults().front().line) + ": " + error.faults().front().message;
    }
    return "none";
  }
  std::filesystem::path file_;
};

TEST_F(CsvTableTest, KeepsCommentsNamesAndTheLinesOfRows) {
  const CsvTable read = table("# first\n# second\r\na, b ,c\r\n\n1,-2.5e-3, x y \r\n+4,5,\"6, \"\"7\"\"\"\n");
  EXPECT_EQ(read.comments().size(), 2U);
  EXPECT_EQ(read.names(), (std::vector<std::string>{"a", "b", "c"}));
  ASSERT_EQ(read.rows(), 2U);
  EXPECT_EQ(read.line_of(0), 5);
  EXPECT_EQ(read.numbers("a"), (std::vector<double>{1.0, 4.0}));
  EXPECT_EQ(read.number(0, 1), -2.5e-3);
  EXPECT_EQ(read.cell(0, "c"), "x y");
  EXPECT_EQ(read.cell(1, "c"), "6, \"7\"");
}

TEST_F(CsvTableTest, CanLeaveRowsOutThatHaveNotACellForEachColumn) {
  std::ofstream(file_) << "a,b\n1\n2,3\n# nothing\n4,5,6\n";
  std::vector<Fault> faults;
  const CsvTable read(file_, &faults);
  EXPECT_EQ(read.numbers("b"), (std::vector<double>{3.0}));
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].line, 2);
  EXPECT_EQ(faults[1].line, 5);
}

// The first would be taken, be it the one that is meant or not. Columns that nobody asks for, unnamed ones too, may repeat.
TEST_F(CsvTableTest, AColumnThatIsThereTwiceIsNotTaken) {
  EXPECT_EQ(fault("a,b,b\n1,2,3\n"), "1: the column 'b' stands there twice; give it once");
  EXPECT_EQ(fault("a,a,b,,\n1,1,2,,\n"), "none");
}

TEST_F(CsvTableTest, SaysWhereAndWhatIsWrong) {
  EXPECT_EQ(fault("a,b\n1,2\n"), "none");
  EXPECT_EQ(fault("a,b\n1,2\n3\n"),
            "3: a value for each of 2 columns ('a,b', line 1) was expected, and one is here");
  EXPECT_EQ(
      fault("a,b\n1,2,3\n"),
      "2: a value for each of 2 columns ('a,b', line 1) was expected, and 3 are here; decimals are written "
      "with a point, 0.5 and not 0,5");
  EXPECT_EQ(fault("a,b\n1,two\n"), "2: 'two' in column 'b' is not a number");
  EXPECT_EQ(fault("a,b\n1,\n"), "2: '' in column 'b' is not a number");
  EXPECT_EQ(fault("a,b\n1,nan\n"), "2: 'nan' in column 'b' is not a number");
  EXPECT_EQ(fault("a,b\n1,1e999\n"), "2: '1e999' in column 'b' is not a number");
  EXPECT_EQ(fault("# of what\na,c\n1,2\n"), "2: there is no column 'b'; there are a, c");
  EXPECT_EQ(fault("a,b\n1,\"2\n"), "2: a quotation mark opens a value and no mark closes it");
  EXPECT_EQ(fault("a,b\n1,\"2\"3\n"), "2: a comma was expected behind a quoted value");
  EXPECT_EQ(fault("# nothing\n"), "0: is empty; a line with the names of the columns was expected");
  EXPECT_THROW(CsvTable("/nowhere/table.csv"), InputError);
}

TEST_F(CsvTableTest, SkipsTheByteOrderMark) {
  const CsvTable read = table(
      "\xEF\xBB\xBF"
      "a,b\n1,2\n");
  EXPECT_EQ(read.names(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table("\xEF\xBB\xBF# of what\na,b\n1,2\n").comments(), (std::vector<std::string>{"# of what"}));
}

TEST_F(CsvTableTest, NamesTheRemedyForOtherSeparators) {
  EXPECT_EQ(
      fault("# of what\na;b\n0,5;1,5\n"),
      "2: columns are parted by commas, and decimals have a point; this file has semicolons: export it with "
      "commas");
  EXPECT_EQ(fault("\"a\";\"b\"\n1;2\n").substr(0, 11), "1: columns ");
  EXPECT_NE(fault("a\tb\n1\t2\n").find("this file has tabs"), std::string::npos);
  EXPECT_EQ(fault("a,b,\"c; d\"\n1,2,3\n"), "none");
  EXPECT_EQ(fault("a,b\n1,\"0,5\"\n"),
            "2: '0,5' in column 'b' is not a number; decimals are written with a point, 0.5 and not 0,5");
}

}  // namespace
}  // namespace polargrain
