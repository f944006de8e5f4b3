// SPDX-License-Identifier: GPL-2.0-or-later
// A result carries its proof: what was changed after the run, or is answered otherwise, is found.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/faults/checkpoint_runs.hpp"

namespace polargrain::testing {
namespace {

using Json = nlohmann::json;

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
  write(scratch_.path() / "case.yaml",
        result("case.yaml") +
            "profiles: {axis: {from: [1 mm, 1 mm], to: [1 mm, 2 mm], points: 2, values: [s22]}}\n");
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
  around("out/costs.csv", "\n1,", "\n2,", "costs.csv was changed after the run");
  around("out/run.log", "converged", "Converged", "run.log was changed after the run");
  around("out/checkpoint.h5", "top_force", "tip_force", "checkpoint.h5 was changed after the run");
  around("out/cell_paths/step-00001.h5", "increment", "Increment", "cell_paths was changed after the run");
  around("out/fields/step-00002.vtu", "VTKFile", "vtkFile", "fields was changed after the run");
  around("out/profiles/axis-00002.csv", "\n0,", "\n9,", "profiles was changed after the run");
  around("fake.in", "0.1", "0.2", "materials.sand.script: the file 'fake.in' has another content");
  around("case.yaml", "40 MPa", "41 MPa", "materials.sand.G: was '40 MPa', is '41 MPa'");
  write(scratch_.path() / "out/fields/step-00099.vtu", "one more");
  expect_difference("fields was changed after the run");
}

// Every part of the summary is under the proof, the names of files in the proof too. Blanks and the order of keys are not.
TEST_F(Verify, FindsWhatWasChangedInTheSummary) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  const std::string good = result("out/summary.json");
  const auto verified = [&](const Json& summary, int indent = 2) {
    write(scratch_.path() / "out/summary.json", summary.dump(indent));
    return polargrain("verify out -w 1");
  };
  const Json summary = Json::parse(good);
  EXPECT_EQ(verified(summary, -1).status, 0) << "the same on one line, keys in the order of the alphabet";
  for (const char* const place : {"/status", "/values/top_force", "/errors/largest_force_residual",
                                  "/cells/evaluations", "/steps_committed", "/proof/processor"}) {
    Json changed = summary;
    Json& value = changed[Json::json_pointer(place)];
    value = value.is_string() ? Json("other") : Json(value.get<double>() * 1.5 + 1.0);
    const Outcome outcome = verified(changed);
    EXPECT_EQ(outcome.status, 1) << place << '\n' << outcome.out << outcome.errors;
    EXPECT_NE(outcome.out.find("  DIFFERS   summary.json was changed after the run"), std::string::npos)
        << place << '\n'
        << outcome.out;
  }
  Json emptied = summary;
  emptied["proof"]["files"] = Json::object();
  EXPECT_EQ(verified(emptied).status, 1);
  Json more = summary;
  more["remark"] = "all is well";
  EXPECT_EQ(verified(more).status, 1);
  Json less = summary;
  less["proof"]["results"].erase("history.csv");
  EXPECT_EQ(verified(less).status, 1);
  // Readers disagree on which of two counts.
  write(scratch_.path() / "out/summary.json", std::string(good).insert(1, "\n  \"status\": \"failed\","));
  const Outcome twice = polargrain("verify out -w 1");
  EXPECT_EQ(twice.status, 1) << twice.out;
  EXPECT_NE(twice.out.find("  DIFFERS   summary.json has two values of 'status'"), std::string::npos)
      << twice.out;
  write(scratch_.path() / "out/summary.json", good.substr(0, good.size() / 2));
  EXPECT_EQ(polargrain("verify out").status, 2);
  write(scratch_.path() / "out/summary.json", good);
  EXPECT_EQ(polargrain("verify out -w 1").status, 0);
}

TEST_F(Verify, SaysOfEachFileThatIsGoneThatItIsMissing) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  for (const char* const file : {"history.csv", "costs.csv", "run.log", "fields.pvd", "sample.h5",
                                 "checkpoint.h5", "fields", "cell_paths"}) {
    const auto place = scratch_.path() / "out" / file;
    std::filesystem::rename(place, scratch_.path() / "kept");
    const Outcome outcome = polargrain("verify out -w 1");
    EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.errors;
    EXPECT_NE(outcome.out.find(std::string("  missing   ") + file + '\n'), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("DIFFERS"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("NOT all agrees"), std::string::npos) << outcome.out;
    std::filesystem::rename(scratch_.path() / "kept", place);
  }
  EXPECT_EQ(polargrain("verify out -w 1").status, 0);
}

// Later commands write into a result; what they leave is under no proof, and that is said.
TEST_F(Verify, SaysWhatIsUnderNoProof) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  ASSERT_EQ(polargrain("report out").status, 0);
  const Outcome outcome = polargrain("verify out -w 1");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.errors;
  EXPECT_NE(outcome.out.find("under no proof, since other commands and machines change it: report.html, "),
            std::string::npos)
      << outcome.out;
}

// As older versions wrote it: nothing is claimed of what they did not record.
TEST_F(Verify, SaysWhatAnOlderVersionDidNotRecord) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  Json summary = Json::parse(result("out/summary.json"));
  const Json this_version = summary["program"];
  summary["program"] = "polargrain 0.2.0";
  summary["proof"].erase("summary");
  for (const char* const file : {"costs.csv", "run.log", "checkpoint.h5", "cell_paths"})
    summary["proof"]["results"].erase(file);
  write(scratch_.path() / "out/summary.json", summary.dump());
  const Outcome outcome = polargrain("verify out -w 1");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.errors;
  EXPECT_NE(outcome.out.find("summary.json is of an older version"), std::string::npos) << outcome.out;
  // Of this version the hash cannot be absent.
  summary["program"] = this_version;
  write(scratch_.path() / "out/summary.json", summary.dump());
  const Outcome gone = polargrain("verify out -w 1");
  EXPECT_EQ(gone.status, 1) << gone.out << gone.errors;
  EXPECT_NE(gone.out.find("its own hash is gone"), std::string::npos) << gone.out;
}

TEST_F(Verify, AgreesAfterAStopAndGoingOn) {
  write_case(scratch_.path(), {"sleep_milliseconds 4", "[1, 2]", "count: 6, tolerance: 1e-6"});
  {
    RunningProgram program(scratch_.path(), "run case.yaml -o out -w 1 --quiet");
    while (!std::filesystem::exists(scratch_.path() / "out/checkpoint.h5")) sleep_for(0.002);
    program.end(SIGTERM);
  }
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet --resume").status, 0);
  const Outcome outcome = polargrain("verify out -w 1");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.errors;
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
