// SPDX-License-Identifier: GPL-2.0-or-later
// Explicit steps with resident boxes by the whole program: near Newton's method, and the same bytes whoever has the boxes,
// whoever dies, and wherever the run is broken off.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "tests/integration/column_run.hpp"

namespace polargrain::testing {
namespace {

class ExplicitRunTest : public ColumnRun {
 protected:
  [[nodiscard]] std::vector<double> forces_of(const std::string& name) const {
    std::vector<double> mean = column(name, "top_force");
    const std::size_t stride = (mean.size() - 1) / 10;
    const std::vector<double> below = column(name, "bottom_force");
    for (std::size_t row = 0; row < mean.size(); ++row) mean[row] = 0.5 * (mean[row] - below[row]);
    std::vector<double> tenths;
    for (std::size_t row = 0; row < mean.size(); row += stride) tenths.push_back(mean[row]);
    return tenths;
  }
};

// Root mean square over the rows, of the last force.
double difference(const std::vector<double>& found, const std::vector<double>& expected) {
  double sum = 0.0;
  for (std::size_t row = 0; row < found.size(); ++row)
    sum += std::pow((found[row] - expected[row]) / expected.back(), 2);
  return std::sqrt(sum / static_cast<double>(found.size()));
}

// Two careful runs of Newton's method differ by 0.2 % before the peak; a packing of 100 grains is no smooth material. Each
// model is held against itself. `informed` is of first order in the ways that its cells follow, in both methods: its
// reference has 40 steps (20 of them: 2 % off), and its explicit steps, which cost no grains, are slow.
TEST_F(ExplicitRunTest, StaysNearNewtonsMethod) {
  for (const char* const model : {"cell", "informed", "adaptive"}) {
    const bool informed = std::string_view(model) == "informed";
    write_column({.steps = "tolerance: 1e-2", .model = model});
    const Outcome newton = run("newton", informed ? "--quiet -w 2 --set steps.count=40" : "--quiet -w 2");
    ASSERT_EQ(newton.status, 0) << newton.errors;
    write_column({.steps = informed ? "method: explicit, pace: 3e-5" : "method: explicit", .model = model});
    const Outcome outcome = run("explicit", "--quiet -w 2");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    const std::vector<double> expected = forces_of("newton");
    const std::vector<double> found = forces_of("explicit");
    ASSERT_EQ(expected.size(), found.size());
    const double rms = difference(found, expected);
    std::cout << "[figure] " << model
              << ": rms of the difference to Newton's method, of the last force: " << rms << '\n';
    EXPECT_LT(rms, 0.02) << model;
    for (const char* const result : {"newton", "explicit"})
      std::filesystem::remove_all(scratch_.path() / result);
  }
}

TEST_F(ExplicitRunTest, WorkersKillsAndResumptionsChangeNoByte) {
  for (const char* const material : {"lc: 50 mm", "rotations: controlled"}) {
    write_column({.steps = "method: explicit, pace: 4e-4", .material = material});
    const std::string options = "--quiet --checkpoint-minutes 0";
    ASSERT_EQ(run("one", options + " -w 1").status, 0) << material;
    const std::string expected = results_of(scratch_.path() / "one");
    RunningProgram disturbed(scratch_.path(), "run case.yaml " + options + " -w 3 -o three");
    const int kills =
        kill_workers(disturbed, scratch_.path() / "three" / "history.csv", 3, 1.0, 20261124).sent;
    EXPECT_EQ(disturbed.wait(), 0) << content(scratch_.path() / "program.out");
    EXPECT_TRUE(results_of(scratch_.path() / "three") == expected) << material;
    std::cout << "[figure] " << material << ": " << kills << " workers killed\n";
    expect_the_same_behind_kills(expected, 3, 20261125, material);
    for (const char* const result : {"one", "three"}) std::filesystem::remove_all(scratch_.path() / result);
  }
}

// Cells and a law that cells inform in one mesh, brought to rest at every fifth step.
TEST_F(ExplicitRunTest, MaterialsAreMixed) {
  write_column({.steps = "method: explicit, pace: 4e-4, rest_at_output: yes"});
  const std::string file = (scratch_.path() / "case.yaml").string();
  std::string text = content(file);
  const auto replace = [&](const std::string& part, const std::string& by) {
    const std::size_t at = text.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    text.replace(at, part.size(), by);
  };
  replace("regions: {all: sand}",
          "  fill: {model: informed, script: cells/hooke_li_chu.in, packing: packing100.h5, lc: 50 mm}\n"
          "regions: {patch: fill, rest: sand}\n"
          "output: {every: 5}");
  replace("elements: [2, 4]", "elements: [2, 4], patch: [0.1 m, 0.1 m]");
  write(file, text);
  const std::string options = "--quiet --checkpoint-minutes 0";
  const Outcome outcome = run("one", options + " -w 1");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(column("one", "rest_steps")[4], 0.0);
  EXPECT_GT(column("one", "rest_steps")[5], 0.0);
  EXPECT_LE(column("one", "nodes_unbalanced")[5], 1e-3);
  EXPECT_GT(column("one", "nodes_unbalanced")[4], 1e-3);
  // The plates carry the same where nothing moves any more.
  EXPECT_NEAR(column("one", "bottom_force")[5] / column("one", "top_force")[5], -1.0, 3e-3);
  EXPECT_GT(column("one", "grains_unbalanced")[5], 0.0);
  const std::string expected = results_of(scratch_.path() / "one");
  ASSERT_EQ(run("three", options + " -w 3").status, 0);
  EXPECT_TRUE(results_of(scratch_.path() / "three") == expected);
  expect_the_same_behind_kills(expected, 2, 20261126, "cells and a law");
}

// Fast steps are told, in the table, the summary and the log; slow ones are not.
TEST_F(ExplicitRunTest, SayHowFarTheyWereFromEquilibrium) {
  write_column({.steps = "method: explicit, pace: 2e-3"});
  const Outcome fast = run("fast", "-w 1");
  ASSERT_EQ(fast.status, 0) << fast.errors;
  EXPECT_NE(fast.out.find("estimated error of the reactions"), std::string::npos) << fast.out;
  EXPECT_NE(fast.out.find("  beyond"), std::string::npos) << fast.out;
  EXPECT_NE(fast.errors.find("halve `pace`"), std::string::npos) << fast.errors;
  const std::string log = content(scratch_.path() / "fast" / "run.log");
  EXPECT_NE(log.find("kinetic energy of the chosen masses"), std::string::npos) << log;
  EXPECT_NE(content(scratch_.path() / "fast" / "summary.json").find("\"error_estimate\""), std::string::npos);
  write_column({.steps = "method: explicit, pace: 5e-5, error: 20 %"});
  const Outcome slow = run("slow", "-w 1");
  ASSERT_EQ(slow.status, 0) << slow.errors;
  EXPECT_EQ(slow.errors.find("explicit steps: estimated"), std::string::npos) << slow.errors;
  EXPECT_EQ(slow.errors.find("do not come to rest"), std::string::npos) << slow.errors;
  const auto median_of = [&](const std::string& name) {
    std::vector<double> rows = column(name, "error_estimate");
    std::ranges::sort(rows);
    return rows[rows.size() / 2];
  };
  EXPECT_LT(median_of("slow"), 0.2 * median_of("fast"));
}

// Steps of many elastic strains, of discs and of stiff spheres: the remark names the way out. In explicit steps there is no such
// remark.
TEST_F(ExplicitRunTest, IsProposedForLargeSteps) {
  write_column({.steps = "tolerance: 1e-2"});
  const Outcome discs =
      run_in(scratch_.path(), POLARGRAIN " check case.yaml --all --set boundary.1.move.u2='-30 mm'");
  EXPECT_NE((discs.out + discs.errors).find("'method: explicit'"), std::string::npos)
      << discs.out << discs.errors;
  std::filesystem::copy(std::filesystem::path(POLARGRAIN_SOURCE_DIRECTORY) / "cases/spheres/packing1000.csv",
                        scratch_.path());
  write_column({.steps = "tolerance: 1e-2"});
  const std::filesystem::path file = scratch_.path() / "case.yaml";
  std::string text = content(file);
  for (const auto& [part, by] :
       {std::pair<std::string, std::string>{"hooke_li_chu.in", "spheres_hooke_radii.in"},
        {"packing100.h5", "packing1000.csv"},
        {"-2 mm", "-8 mm"}})
    text.replace(text.find(part), part.size(), by);
  write(file, text);
  const Outcome newton = run_in(scratch_.path(), POLARGRAIN " check case.yaml --all");
  EXPECT_NE((newton.out + newton.errors).find("'method: explicit'"), std::string::npos)
      << newton.out << newton.errors;
  text.replace(text.find("tolerance: 1e-2"), 15, "method: explicit");
  write(file, text);
  const Outcome other = run_in(scratch_.path(), POLARGRAIN " check case.yaml --all");
  EXPECT_EQ((other.out + other.errors).find("a peak lies between"), std::string::npos) << other.out;
}

// A mistake in the file is found before a grain moves.
TEST_F(ExplicitRunTest, MistakesAreFaults) {
  const auto errors_of = [&](const std::string& steps, const std::string& material = "lc: 50 mm",
                             const std::string& model = "cell") {
    write_column({.steps = steps, .model = model, .material = material});
    const Outcome outcome = run_in(scratch_.path(), POLARGRAIN " check case.yaml");
    EXPECT_EQ(outcome.status, 2) << steps;
    return outcome.errors;
  };
  const auto expect_in = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect_in(errors_of("method: explict"), "did you mean 'explicit'?");
  expect_in(errors_of("method: explicit, dem_steps: 1"), "dem_steps");
  expect_in(errors_of("method: explicit, pace: 0.1"), "pace");
  expect_in(errors_of("method: explicit, pace: 1e-4, explicit_steps: 100"), "leave one of them out");
  expect_in(errors_of("pace: 1e-4"), "pace");
  expect_in(errors_of("method: explicit, error: 3"), "error");
  expect_in(errors_of("method: explicit, rest_at_output: maybe"), "rest_at_output");
  expect_in(errors_of("method: explicit, ask_every: 0"), "ask_every");
  for (const char* const key : {"update: fixed_point", "beyond_mismatch: cell"})
    expect_in(errors_of("method: explicit", std::string("lc: 50 mm, informed: {") + key + "}", "informed"),
              "in explicit steps");
}

}  // namespace
}  // namespace polargrain::testing
