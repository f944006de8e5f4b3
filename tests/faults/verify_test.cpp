// SPDX-License-Identifier: GPL-2.0-or-later
// A result carries its proof: what was changed after the run, or is answered otherwise, is found.
#include <gtest/gtest.h>

#include "tests/faults/checkpoint_runs.hpp"

namespace polargrain::testing {
namespace {

class Verify : public ::testing::Test {
 protected:
  Verify()
      : scratch_(std::string("verify_") + ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write_case(scratch_.path(), {"softening 0.1", "[1, 2]", "count: 4, tolerance: 1e-6"});
  }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(scratch_.path(), POLARGRAIN " " + arguments);
  }
  [[nodiscard]] std::string result(const std::string& file) const { return content(scratch_.path() / file); }
  /// Puts other bytes in the place of the first `text` of a file.
  void change(const std::string& file, const std::string& text, const std::string& other) const {
    std::string bytes = result(file);
    const std::size_t place = bytes.find(text);
    ASSERT_NE(place, std::string::npos) << file;
    write(scratch_.path() / file, bytes.replace(place, text.size(), other));
  }
  Scratch scratch_;
};

TEST_F(Verify, AgreesWithWhatNobodyTouched) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 2 --quiet --set steps.count=3").status, 0);
  const std::string summary = result("out/summary.json");
  for (const char* const key :
       {"\"processor\": \"", "\"case_file\": \"", "\"steps.count=3\"", "\"materials.sand.script\": \"",
        "\"materials.sand.packing\": \"", "\"history.csv\": \"", "\"worker 1\": ", "\"worker 2\": "}) {
    EXPECT_NE(summary.find(key), std::string::npos) << key << '\n' << summary;
  }
  const Outcome outcome = polargrain("verify out -w 1");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.errors;
  EXPECT_NE(outcome.out.find("16 of 16 cells, evaluated again from their states"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("\nall agrees\n"), std::string::npos);
}

TEST_F(Verify, SamplesDoNotDependOnTheNumberOfWorkers) {
  ASSERT_EQ(polargrain("run case.yaml -o one -w 1 --quiet").status, 0);
  ASSERT_EQ(polargrain("run case.yaml -o three -w 3 --quiet").status, 0);
  EXPECT_TRUE(result("one/sample.h5") == result("three/sample.h5"));
}

TEST_F(Verify, FindsWhatWasChanged) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  const auto expect_difference = [this](const std::string& what) {
    const Outcome outcome = polargrain("verify out -w 1");
    EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.errors;
    EXPECT_NE(outcome.out.find("  DIFFERS   " + what), std::string::npos) << outcome.out << outcome.errors;
    EXPECT_NE(outcome.out.find("NOT all agrees"), std::string::npos);
  };
  const auto around = [&](const std::string& file, const std::string& text, const std::string& other,
                          const std::string& what) {
    const std::string good = result(file);
    change(file, text, other);
    expect_difference(what);
    write(scratch_.path() / file, good);
  };
  around("out/history.csv", "\n1,", "\n2,", "history.csv was changed after the run");
  around("out/fields/step-00002.vtu", "VTKFile", "vtkFile", "fields was changed after the run");
  around("fake.in", "0.1", "0.2", "materials.sand.script: the file 'fake.in' has another content");
  around("case.yaml", "40 MPa", "41 MPa", "materials.sand.G: was '40 MPa', is '41 MPa'");
  std::filesystem::remove(scratch_.path() / "out/fields.pvd");
  expect_difference("fields.pvd is not there any more");
}

// The file hashes say nothing of who computed: an engine that answers otherwise than the one of the run did.
TEST_F(Verify, FindsAnswersThatNobodyGivesAgain) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  const Outcome outcome = run_in(scratch_.path(), "FAKE_ENGINE_FORGES=1 " POLARGRAIN " verify out -w 1");
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.errors;
  EXPECT_NE(outcome.out.find("  DIFFERS   0 of 16 cells, evaluated again"), std::string::npos) << outcome.out;
}

TEST_F(Verify, SaysWhatIsMissing) {
  EXPECT_EQ(polargrain("verify nowhere").status, 2);
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  change("out/summary.json", "\"proof\": {", "\"former\": {");
  const Outcome outcome = polargrain("verify out");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("holds no proof"), std::string::npos) << outcome.errors;
}

}  // namespace
}  // namespace polargrain::testing
