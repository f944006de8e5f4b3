// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain layer with the engine, in a size that says nothing of sand, and what a case makes of its result.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <sstream>

#include "common/csv_table.hpp"
#include "coupler/case/measured_length.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;

constexpr const char* kGrains =
    "grains: 100\nsizes: {law: uniform, radius: [3 mm, 7 mm]}\ndensity: 2650\nthickness: 100 mm\n"
    "script: cells/hooke_li_chu.in\npressure: 100 kPa\nfriction: 0\nseed: 1\n";
const std::string kSmall =
    " layer grains.yaml -o out --grains 144 --seeds 1,3 --cell-grains 16 --cell-seeds 1,2 --lc 0.3 --lp 0.25,0.5 --spread 4 --way 1 "
    "--shear 0.3 --inertial-number 4e-3 --column 8 --elements 4 -w 1";

/// A case of one element with a cell of the packing and that key.
std::string case_with(const std::string& material) {
  return "title: one\nmesh:\n  rectangle: {size: [1, 1], elements: [1, 1]}\nmaterials:\n  sand: {model: cell, "
         "script: cells/hooke_li_chu.in, packing: " +
         material +
         "}\nregions: {all: sand}\nboundary:\n  - {on: bottom, fix: [u1, u2]}\nsteps: {count: 1}\n";
}

TEST(LayerCommand, MeasuresLengthsThatACaseReadsAndGoesOnWhereItWas) {
  const Scratch scratch("layer");
  write(scratch.path() / "grains.yaml", kGrains);
  const std::string packing = "out/grains16-seed1.h5";
  const Outcome made = run_in(scratch.path(), kProgram + kSmall);
  ASSERT_EQ(made.status, 0) << made.errors;
  const CsvTable columns(scratch.path() / "out/columns.csv");
  ASSERT_EQ(columns.rows(), 8u);  // lc alone, two of lp, a spread, for each of two packings
  ASSERT_EQ(CsvTable(scratch.path() / "out/layers.csv").rows(), 2u);
  for (std::size_t row = 0; row < columns.rows(); ++row) {
    // Friction of half a radian with rolling resistance: between 0.4 and 1.2 in so few grains.
    EXPECT_GT(columns.number(row, columns.column("peak")), 0.4);
    EXPECT_LT(columns.number(row, columns.column("peak")), 1.2);
    EXPECT_GT(columns.number(row, columns.column("thickness")), 0.1);
  }
  const auto measured = coupler::read_measured_length(scratch.path() / "out/grains16-seed1.length.yaml");
  std::cout << "[figure] lc " << measured.internal_length << " m, lp " << measured.plastic_length.value()
            << " m\n";
  // One candidate of lc; of lp two, and no length is taken beyond them.
  EXPECT_NEAR(measured.internal_length, 0.3 * measured.mean_diameter, 1e-6);
  EXPECT_GE(*measured.plastic_length, 0.25 * measured.mean_diameter * (1 - 1e-5));
  EXPECT_LE(*measured.plastic_length, 0.5 * measured.mean_diameter * (1 + 1e-5));

  EXPECT_NEAR(measured.spread.value(), 4.0 * measured.mean_diameter, 1e-6);
  for (const char* const words : {"the layers prefer ", "lc and lp", "\n  spread "})
    EXPECT_NE(made.out.find(words), std::string::npos) << made.out;

  // Layers without columns: those that are there.
  const Outcome alone = run_in(scratch.path(), kProgram + kSmall + " --no-columns");
  EXPECT_EQ(alone.status, 0) << alone.errors;
  EXPECT_TRUE(alone.out.starts_with("layers of grains, mean and 95 % interval over 2")) << alone.out;
  EXPECT_EQ(alone.out.find("misfit"), std::string::npos);

  // All is there: nothing is made again, and the same is found.
  const std::string lengths = content(scratch.path() / "out/lengths.csv");
  const auto layer = std::filesystem::last_write_time(scratch.path() / "out/layer144-seed1/history.csv");
  const Outcome again = run_in(scratch.path(), kProgram + kSmall + " --beside other.h5");
  EXPECT_EQ(again.status, 2);  // there is no such packing
  std::filesystem::copy(scratch.path() / packing, scratch.path() / "other.h5");
  const Outcome beside = run_in(scratch.path(), kProgram + kSmall + " --beside other.h5");
  ASSERT_EQ(beside.status, 0) << beside.errors;
  EXPECT_EQ(content(scratch.path() / "out/lengths.csv"), lengths);
  EXPECT_EQ(std::filesystem::last_write_time(scratch.path() / "out/layer144-seed1/history.csv"), layer);

  // Read by a case.
  write(scratch.path() / "case.yaml", case_with("other.h5, lc: measured"));
  const Outcome good = run_in(scratch.path(), kProgram + " check case.yaml");
  EXPECT_EQ(good.status, 0) << good.errors;
  // The law that grains inform takes both lengths too.
  const Outcome informed =
      run_in(scratch.path(), kProgram + " check case.yaml --set materials.sand.model=informed");
  EXPECT_EQ(informed.status, 0) << informed.errors;
  // And the spread of the whole body.
  const std::string spreads = "continuum: {kind: cauchy, spread: measured, hold: bottom}\n";
  write(scratch.path() / "spread.yaml", spreads + case_with("other.h5"));
  const Outcome spread = run_in(scratch.path(), kProgram + " check spread.yaml");
  EXPECT_EQ(spread.status, 0) << spread.errors;
  const Outcome of_medians =
      run_in(scratch.path(), kProgram + " check spread.yaml --set 'continuum.spread=5 d50'");
  EXPECT_EQ(of_medians.status, 0) << of_medians.errors;
  EXPECT_NE(spread.out.find("slips are spread over 40 mm\n"), std::string::npos) << spread.out;
  // Half of the area is of discs below 11 to 12 mm: radii are uniform between 3 and 7 mm.
  EXPECT_TRUE(of_medians.out.find("slips are spread over 5") != std::string::npos ||
              of_medians.out.find("slips are spread over 6") != std::string::npos)
      << of_medians.out;
  std::filesystem::copy(scratch.path() / packing, scratch.path() / "bare.h5");
  write(scratch.path() / "case.yaml", case_with("bare.h5, lc: measured"));
  const Outcome none = run_in(scratch.path(), kProgram + " check case.yaml");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.errors.find(
                "case.yaml:5: material 'sand': lc: measured: there is no bare.length.yaml; 'polargrain layer "
                "SPEC.yaml --beside bare.h5' makes the experiment and writes it, or give a length"),
            std::string::npos)
      << none.errors;
  write(scratch.path() / "spread.yaml", spreads + case_with("bare.h5"));
  EXPECT_NE(run_in(scratch.path(), kProgram + " check spread.yaml")
                .errors.find("spread.yaml:1: continuum: spread: measured: there is no bare.length.yaml"),
            std::string::npos);
  std::string other_law = content(scratch.path() / "other.length.yaml");
  other_law.replace(other_law.find("script: ") + 8, 4, "0000");
  write(scratch.path() / "bare.length.yaml", other_law);
  const Outcome wrong = run_in(scratch.path(), kProgram + " check case.yaml");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.errors.find("bare.length.yaml was measured under another contact law"), std::string::npos)
      << wrong.errors;

  // A column that went no further than a diameter has its peak later than a quarter of one: lc and lp rest on it, and it is told.
  const std::filesystem::path history = scratch.path() / "out/column-cells16-seed1-lc0.3-lp0.25/history.csv";
  const CsvTable column(history);
  const std::vector<double> displacements = column.numbers("displacement");
  const auto row = std::ranges::find_if(displacements, [&](double u) { return u > measured.mean_diameter; });
  ASSERT_NE(row, displacements.end());
  std::istringstream lines(content(history));
  std::string kept;
  const int last = column.line_of(static_cast<std::size_t>(row - displacements.begin()));
  std::string line;
  for (int k = 0; k < last && std::getline(lines, line); ++k) kept += line + '\n';
  write(history, kept);
  const Outcome cut = run_in(scratch.path(), kProgram + kSmall);
  ASSERT_EQ(cut.status, 0) << cut.errors;
  EXPECT_NE(cut.errors.find(" of 8 columns of cells did not come 1 diameters past their peak"),
            std::string::npos)
      << cut.errors;

  // Another way of shearing is another experiment.
  write(scratch.path() / "grains.yaml", std::string(kGrains) + "# 2\n");
  const Outcome changed = run_in(scratch.path(), kProgram + kSmall);
  EXPECT_EQ(changed.status, 2);
  EXPECT_NE(changed.errors.find("holds layers of another specification"), std::string::npos)
      << changed.errors;
}

TEST(LayerCommand, MistakesAreFoundBeforeAnythingIsMade) {
  const Scratch scratch("layer_mistakes");
  write(scratch.path() / "grains.yaml", kGrains);
  const auto errors_of = [&](const std::string& options) {
    const Outcome outcome = run_in(scratch.path(), kProgram + " layer grains.yaml " + options);
    EXPECT_EQ(outcome.status, 2) << options;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "layer-results")) << options;
    return outcome.errors;
  };
  EXPECT_NE(errors_of("--seeds 1").find("one layer does not show the scatter"), std::string::npos);
  EXPECT_NE(errors_of("--seeds 1,2,1").find("seed 1 stands twice"), std::string::npos);
  EXPECT_NE(errors_of("--cell-seeds 1,1").find("no independent samples"), std::string::npos);
  EXPECT_NE(errors_of("--lc 0.4,0.2").find("candidates must grow"), std::string::npos);
  EXPECT_NE(errors_of("--spread 3,5")
                .find("--spread: 3 diameters need elements of 1.5 or less, a column has them of 2"),
            std::string::npos);
  EXPECT_NE(errors_of("--spread 0").find("--spread: 0 is not a positive number\n"), std::string::npos);
  EXPECT_NE(errors_of("--set script=cells/none.in").find("none.in"), std::string::npos);
  EXPECT_NE(errors_of("--set pressure=-1").find("pressure"), std::string::npos);
  EXPECT_NE(errors_of("--way 0").find("--way"), std::string::npos);
  // The plates lie along the bedding planes: an angle changed nothing.
  write(scratch.path() / "grains.yaml", std::string(kGrains) + "deposition: {bedding_angle: 30 deg}\n");
  EXPECT_NE(errors_of("").find("grains.yaml:9: bedding_angle: grains are sheared along their bedding planes"),
            std::string::npos);
}

}  // namespace
}  // namespace polargrain::testing
