// SPDX-License-Identifier: GPL-2.0-or-later
// The command `element` with cells that are linear (fake_engine.hpp), and what it says of bad input.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kPacking = POLARGRAIN_SOURCE_DIRECTORY "/cases/biaxial/packing400.csv";
const std::string kElement = FAKE_POLARGRAIN " element ";
constexpr double kYoung = 100e6;  // of the fake engine
constexpr double kPoisson = 0.25;

const std::string kLaw = R"(pressure: 100 kPa
material: {model: elastic, E: 50 MPa, nu: 0.3, Gc: 10 MPa, lc: 1 mm}
)";

class ElementCommand : public ::testing::Test {
 protected:
  ElementCommand() : scratch("element") { write(scratch.path() / "cell.in", "young 100e6\n"); }

  Outcome run(const std::string& arguments) const { return run_in(scratch.path(), kElement + arguments); }
  /// Of a specification.
  Outcome run_text(const std::string& text, const std::string& arguments = "") const {
    write(scratch.path() / "spec.yaml", text);
    return run("spec.yaml " + arguments);
  }
  void expect_fault(const std::string& text, const std::string& message) const {
    const Outcome outcome = run_text(text);
    EXPECT_EQ(outcome.status, 2) << outcome.errors;
    EXPECT_NE(outcome.errors.find(message), std::string::npos) << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "element.csv"));
  }

  Scratch scratch;
};

TEST_F(ElementCommand, BiaxialCompressionOfLinearCells) {
  const Outcome outcome =
      run("--test biaxial --pressure 100kPa --set axial_strain=1% --set rows=10 --set tolerance=1e-9 " +
          kPacking + " cell.in");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable table(scratch.path() / "element.csv");
  const std::vector<double> strains = table.numbers("axial_strain");
  const std::vector<double> axial = table.numbers("s22_Pa");
  ASSERT_EQ(strains.size(), 13u);  // packing, consolidation, zero and ten rows
  EXPECT_DOUBLE_EQ(strains.back(), 0.01);
  // The box feels, in each row, the increment over its length then; s11 stays where e11 = -nu / (1 - nu) e22.
  double sum = 0.0;
  for (std::size_t k = 3; k < strains.size(); ++k) {
    sum += (strains[k] - strains[k - 1]) / (1.0 - strains[k - 1]);
    EXPECT_NEAR(axial[k], -100e3 - kYoung / (1.0 - kPoisson * kPoisson) * sum, 1e-3);
    EXPECT_LE(table.numbers("residual")[k], 1e-9);
  }
  const std::string page = content(scratch.path() / "element.html");
  for (const char* const title : {"s1 / s3", "volume strain", "q, kPa", "void ratio"})
    EXPECT_NE(page.find(title), std::string::npos) << title;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "element_mean.csv"));
}

TEST_F(ElementCommand, SeveralPackingsHaveAMeanAndItsInterval) {
  // Three moduli: 1, 2 and 3 times 100 MPa, by the mass of the first grain.
  for (const int mass : {1, 2, 3})
    write(scratch.path() / ("p" + std::to_string(mass) + ".csv"),
          "# cell xx=1 xy=0 yx=0 yy=1 z=0.1\nid,x,y,r,mass,Izz\n1,0.5,0.5,0.4," + std::to_string(mass) +
              ",0.08\n");
  write(scratch.path() / "mass.in", "young_of_mass 100e6\n");
  const std::string test =
      "--test oedometer --pressure 100kPa --set axial_strain=1% --set rows=5 --set largest_increment=0.1 p1.csv p2.csv p3.csv mass.in ";
  const Outcome one = run(test + "-w 1 -o one");
  ASSERT_EQ(one.status, 0) << one.errors;
  const Outcome three = run(test + "-w 3 -o three");
  ASSERT_EQ(three.status, 0) << three.errors;
  for (const char* const ending : {".csv", "_mean.csv", ".html"})
    EXPECT_EQ(content(scratch.path() / (std::string("one") + ending)),
              content(scratch.path() / (std::string("three") + ending)))
        << ending;
  const CsvTable mean(scratch.path() / "one_mean.csv");
  const std::vector<double> stress = mean.numbers("s22_Pa");
  const std::vector<double> half = mean.numbers("s22_Pa_half_95");
  const double step = stress[3] - stress[4];  // of the mean modulus, over one row
  EXPECT_EQ(mean.numbers("n").back(), 3.0);
  // Standard deviation of 1, 2, 3 is 1; t of two degrees of freedom 4.303.
  EXPECT_NEAR(half[3], 4.303 / std::sqrt(3.0) * 0.5 * (-100e3 - stress[3]), 1e-4 * half[3]);
  EXPECT_GT(step, 0.0);
  EXPECT_NE(one.out.find("mean of 3, 95 %"), std::string::npos) << one.out;
}

TEST_F(ElementCommand, SeveralPressuresHaveAnEnvelope) {
  const Outcome outcome = run_text(R"(pressure: [50 kPa, 100 kPa, 200 kPa]
material: {model: elastoplastic, E: 50 MPa, nu: 0.3, Gc: 10 MPa, lc: 1 mm, match: triaxial_compression,
           friction_angle: 35 deg, dilatancy_angle: 5 deg, cohesion: 5 kPa}
test: triaxial
axial_strain: 4 %
rows: 8
tolerance: 1e-9
)");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable envelope(scratch.path() / "element_envelope.csv");
  ASSERT_EQ(envelope.rows(), 6u);  // at the peak and at the end
  // The cone has this strength in triaxial compression; lateral stresses are met to 1e-9 of the pressure.
  EXPECT_NEAR(envelope.numbers("friction_angle_deg")[0], 35.0, 1e-6);
  EXPECT_NEAR(envelope.numbers("cohesion_Pa")[0], 5e3, 1e-2);
  EXPECT_DOUBLE_EQ(envelope.numbers("pressure_Pa")[2], 200e3);
  EXPECT_NEAR(envelope.numbers("least_Pa")[2], 200e3, 1e-3);
  EXPECT_EQ(CsvTable(scratch.path() / "element.csv").rows(), 3u * 11u);
  EXPECT_DOUBLE_EQ(CsvTable(scratch.path() / "element.csv").numbers("pressure_Pa")[12], 100e3);
  EXPECT_NE(content(scratch.path() / "element.html").find("Mohr's circles at the peak"), std::string::npos);
  std::filesystem::remove(scratch.path() / "element.csv");
  expect_fault(
      "pressure: [50 kPa, 100]\nmaterial: {model: elastic, E: 5 MPa, nu: 0.3, Gc: 1 MPa, lc: 1 mm}\n"
      "test: triaxial\n",
      "'100' has no unit");
}

TEST_F(ElementCommand, EnvelopesOfSeveralPackingsHaveAMeanAndItsInterval) {
  for (const int mass : {1, 2, 3})
    write(scratch.path() / ("p" + std::to_string(mass) + ".csv"),
          "# cell xx=1 xy=0 yx=0 yy=1 z=0.1\nid,x,y,r,mass,Izz\n1,0.5,0.5,0.4," + std::to_string(mass) +
              ",0.08\n");
  write(scratch.path() / "mass.in", "young_of_mass 100e6\n");
  const std::string test =
      "--test biaxial --pressure 100kPa,200kPa --set axial_strain=0.1% --set rows=2 --set tolerance=1e-9 p1.csv p2.csv p3.csv "
      "mass.in ";
  const Outcome one = run(test + "-w 1 -o one");
  ASSERT_EQ(one.status, 0) << one.errors;
  ASSERT_EQ(run(test + "-w 3 -o three").status, 0);
  for (const char* const ending : {".csv", "_mean.csv", "_envelope.csv", ".html"})
    EXPECT_EQ(content(scratch.path() / (std::string("one") + ending)),
              content(scratch.path() / (std::string("three") + ending)))
        << ending;
  // Linear cells have the same circle under any pressure, of a size that goes with the modulus: no angle, and a cohesion.
  const CsvTable envelope(scratch.path() / "one_envelope.csv");
  ASSERT_EQ(envelope.rows(), 12u);
  const std::vector<double> cohesion = envelope.numbers("cohesion_Pa");
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(envelope.numbers("friction_angle_deg")[k], 0.0, 1e-6);
  EXPECT_NEAR(cohesion[2] / cohesion[0], 2.0, 1e-6);
  EXPECT_NEAR(cohesion[4] / cohesion[0], 3.0, 1e-6);
  // Standard deviation of 1, 2, 3 is 1; t of two degrees of freedom 4.303.
  const std::string mean =
      fmt::format("{:.3f} +- {:.3f}", 2e-3 * cohesion[0], 4.303e-3 / std::sqrt(3.0) * cohesion[0]);
  EXPECT_NE(one.out.find("largest, mean of 3, 95 %"), std::string::npos) << one.out;
  EXPECT_NE(one.out.find(mean), std::string::npos) << mean << "\n" << one.out;
}

TEST_F(ElementCommand, StagesOfALaw) {
  const Outcome outcome = run_text(kLaw + R"(void_ratio: 0.7
tolerance: 1e-9
stages:
  - {test: isotropic, to: 200 kPa, rows: 4}
  - {test: triaxial, deviator: 50 kPa, rows: 5, zero: yes}
  - {test: triaxial, cycles: 2, amplitude: 10 kPa, drainage: undrained}
  - {p: hold, q: 0 kPa, b: 0, rows: 3}
  - {e22: hold, s11: -150 kPa, s33: hold, rows: 2}
)");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable table(scratch.path() / "element.csv");
  ASSERT_EQ(table.rows(), 2u + 1u + 4u + 1u + 5u + 80u + 3u + 2u);
  const auto last = [&](const char* name) { return table.numbers(name).back(); };
  EXPECT_NEAR(last("s11_Pa"), -150e3, 1e-3);
  EXPECT_NEAR(table.numbers("e22").back(), table.numbers("e22")[table.rows() - 3], 1e-15);
  // dp over K of the isotropic stage, from the void ratio given.
  const double bulk = 50e6 / (3.0 * (1.0 - 0.6));
  EXPECT_NEAR(table.numbers("void_ratio")[7], 1.7 * (1.0 - 100e3 / bulk) - 1.0, 1e-12);
  // After the cycles at constant volume the elastic law has no pore pressure left; drained stages have none.
  EXPECT_NEAR(table.numbers("pore_pressure_Pa")[table.rows() - 6], 0.0, 1e-2);
  EXPECT_EQ(last("pore_pressure_Pa"), 0.0);
}

const std::string kCone = R"(pressure: 100 kPa
material: {model: elastoplastic, E: 50 MPa, nu: 0.3, Gc: 10 MPa, lc: 1 mm, match: triaxial_compression,
           friction_angle: 35 deg, dilatancy_angle: 5 deg, cohesion: 0.1 kPa}
)";

TEST_F(ElementCommand, UndrainedFiguresAreOfAllUndrainedStages) {
  const Outcome outcome = run_text(kCone + R"(stages:
  - {test: triaxial, drainage: undrained, axial_strain: 1 %, rows: 50}
  - {test: triaxial, drainage: undrained, deviator: 0 kPa, rows: 50}
  - {test: triaxial, axial_strain: 1 %, rows: 2}
)");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable table(scratch.path() / "element.csv");
  const std::vector<double> pore_pressure = table.numbers("pore_pressure_Pa");
  EXPECT_EQ(pore_pressure.back(), 0.0);
  // Loading gives the largest u and starts from the least p', as the table has them.
  const std::string figures =
      fmt::format(" {:>16.3f} {:>16.3f}", 1e-3 * *std::ranges::max_element(pore_pressure), 100.0);
  EXPECT_NE(outcome.out.find(figures), std::string::npos) << figures << "\n" << outcome.out;
}

TEST_F(ElementCommand, TheIntermediateStressIsWhereBSays) {
  for (const char* const stage :
       {"b: 0.3, q: -60 kPa, p: hold", "b: 0.3, q: 60 kPa, p: hold", "b: 0.3, e22: 0.1 %, s11: hold",
        "test: true_triaxial, b: 0.3, axial_strain: -0.1 %",
        "test: true_triaxial, b: 0.3, deviator: -60 kPa"}) {
    const Outcome outcome =
        run_text(kLaw + "tolerance: 1e-9\nstages: [{" + stage + ", rows: 4}, {p: hold, q: hold, b: 0.3}]\n");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    // Stresses of some 50 kPa are met to 1e-9 of 100 kPa, at the end of the first stage and behind the second.
    const CsvTable table(scratch.path() / "element.csv");
    for (const std::size_t row : {std::size_t{6}, table.rows() - 1})
      EXPECT_NEAR(table.figure(row, table.column("b")), 0.3, 1e-7) << stage;
  }
  std::filesystem::remove(scratch.path() / "element.csv");
  expect_fault(
      kLaw + "test: true_triaxial\nb: 0.3\ncycles: 2\namplitude: 0.1 %\n",
      "spec.yaml:4: element test: true_triaxial: the axial stress of a cycle is the largest, then the least");
}

TEST_F(ElementCommand, TestsThatFailAtOneStressHaveNoEnvelope) {
  std::string text = kCone;
  text.replace(text.find("100 kPa"), 7, "[50 kPa, 200 kPa]");
  const Outcome outcome = run_text(
      text +
      "stages:\n  - {test: isotropic, to: 200 kPa, rows: 2}\n  - {test: triaxial, axial_strain: 5 %, rows: 8}\n");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_NE(
      outcome.out.find("elastoplastic, end: no line: the centres of the circles differ by less than 1 %"),
      std::string::npos)
      << outcome.out;
}

TEST_F(ElementCommand, AMaterialOfDiscsIsMeasuredInItsPlane) {
  const std::string test = "test: biaxial\npressure: 100 kPa\naxial_strain: 1 %\nrows: 5\n";
  const Outcome of_cell = run_text("packing: " + kPacking + "\nscript: cell.in\n" + test, "-o packing");
  ASSERT_EQ(of_cell.status, 0) << of_cell.errors;
  const double angle = CsvTable(scratch.path() / "packing.csv").numbers("friction_angle_deg").back();
  EXPECT_GT(angle, 10.0);
  for (const char* model : {"cell", "adaptive"}) {
    const Outcome outcome = run_text(std::string("material: {model: ") + model +
                                         ", script: cell.in, lc: 20 mm, packing: " + kPacking + "}\n" + test,
                                     "-o material");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    const CsvTable table(scratch.path() / "material.csv");
    EXPECT_EQ(std::ranges::count(table.names(), "s33_Pa"), 0) << model;
    // Both end within the tolerance of 1e-3 of the pressure.
    EXPECT_NEAR(table.numbers("friction_angle_deg").back(), angle, 0.1) << model;
  }
}

TEST_F(ElementCommand, SaysWhatIsWrongBeforeAnythingMoves) {
  const std::string cells = "packing: " + kPacking + "\nscript: cell.in\npressure: 100 kPa\n";
  expect_fault(cells + "test: biaxal\n",
               "spec.yaml:4: element test: test: expected one of isotropic, triaxial");
  expect_fault(cells + "test: biaxal\n", "did you mean 'biaxial'?");
  expect_fault(cells + "test: triaxial\n",
               "spec.yaml:4: element test: triaxial: a cell of discs has no third direction");
  expect_fault(cells + "test: biaxial\naxial_strain: 1 %\ndeviator: 20 kPa\n",
               "spec.yaml:5: element test: axial_strain: deviator drives the test already");
  expect_fault(cells + "stages:\n  - {e22: -1 %,\n     s22: hold}\n",
               "spec.yaml:6: stage 1: s22: the component is prescribed twice, as e22 too");
  expect_fault(cells + "stages: [{e22: -1 %, s33: hold}]\n",
               "spec.yaml:4: stage 1: s33: discs neither move out");
  expect_fault(cells + "test: biaxial\nstrain: 1 %\n", "spec.yaml:5: element test: unknown key 'strain'");
  expect_fault(cells + "test: biaxial\ncycles: 3\namplitude: 20\n",
               "spec.yaml:6: element test: amplitude: is a strain of 2000 %; a stress needs its unit");
  expect_fault("packing: none.h5\nscript: cell.in\npressure: 100\ntest: biaxial\n",
               "spec.yaml:1: element test: packing: there is no file 'none.h5'");
  expect_fault("packing: none.h5\nscript: cell.in\npressure: 100\ntest: biaxial\n",
               "spec.yaml:3: element test: pressure: '100' has no unit; write 100 kPa");
  expect_fault(kLaw, "the key 'test' is missing");
  const Outcome option = run("--test biaxial --pressure 100 " + kPacking + " cell.in");
  EXPECT_EQ(option.status, 2);
  EXPECT_NE(option.errors.find("--pressure: element test: pressure: '100' has no unit"), std::string::npos)
      << option.errors;
  const Outcome folder = run("--test biaxial --pressure 100kPa -o no/where " + kPacking + " cell.in");
  EXPECT_EQ(folder.status, 2) << folder.errors;
}

/// Packings of one grain, which differ in its mass.
void write_packings(const std::filesystem::path& folder, int count) {
  for (int mass = 1; mass <= count; ++mass)
    write(folder / fmt::format("p{}.csv", mass),
          fmt::format("# cell xx=1 xy=0 yx=0 yy=1 z=0.1\nid,x,y,r,mass,Izz\n1,0.5,0.5,0.4,{},0.08\n", mass));
}

TEST_F(ElementCommand, APackingHasItsOwnVoidRatio) {
  expect_fault(
      "packing: [" + kPacking + "]\nscript: cell.in\npressure: 100 kPa\nvoid_ratio: 0.6\ntest: biaxial\n",
      "spec.yaml:4: element test: void_ratio: a packing has its own");
}

TEST_F(ElementCommand, CopiesAreNoIndependentSamples) {
  write_packings(scratch.path(), 2);
  std::filesystem::copy(scratch.path() / "p1.csv", scratch.path() / "other.csv");
  const std::string test = "--test oedometer --pressure 100kPa --set axial_strain=1% --set rows=2 ";
  for (const char* const twice : {"p1.csv p1.csv", "p1.csv p2.csv other.csv"}) {
    const Outcome outcome = run(test + twice + " cell.in");
    EXPECT_EQ(outcome.status, 2) << twice;
    EXPECT_NE(outcome.errors.find("has the grains of p1; the two are no independent samples"),
              std::string::npos)
        << outcome.errors;
  }
  EXPECT_EQ(run(test + "p1.csv p2.csv cell.in").status, 0);
}

/// Grains at rest on a lattice of 1 m, which a seed draws or not.
void write_lattice(const std::filesystem::path& file, double least, double growth, double aside) {
  std::string text = "# cell xx=4 xy=0 yx=0 yy=3 z=0.1\nid,x,y,r,mass,Izz\n";
  for (int k = 0; k < 12; ++k)
    text += fmt::format("{},{},{},{:.17g},1,0.08\n", k + 1, 0.5 + k % 4 + aside, 0.5 + k / 4,
                        least + growth * (k * 5 % 12));
  write(file, text);
}

TEST_F(ElementCommand, SettledPackingsOfOneSeedAreNoIndependentSamples) {
  write_lattice(scratch.path() / "p1.csv", 0.40, 0.002, 0.0);
  write_lattice(scratch.path() / "settled.csv", 0.40, 0.002, 0.01);
  write_lattice(scratch.path() / "seed2.csv", 0.41, 0.002, 0.0);
  write_lattice(scratch.path() / "alike.csv", 0.42, 0.0, 0.0);  // of one size: places tell
  write_lattice(scratch.path() / "moved.csv", 0.42, 0.0, 0.01);
  const std::string test = "--test oedometer --pressure 100kPa --set axial_strain=1% --set rows=2 ";
  const Outcome outcome = run(test + "p1.csv settled.csv cell.in");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("settled has the grains of p1; the two are no independent samples"),
            std::string::npos)
      << outcome.errors;
  for (const char* const others : {"p1.csv seed2.csv", "alike.csv moved.csv"})
    EXPECT_EQ(run(test + others + " cell.in").status, 0) << others;
}

TEST_F(ElementCommand, CompanionsOfAnOlderRunAreRemoved) {
  write_packings(scratch.path(), 2);
  const std::string test = "--test biaxial --set axial_strain=0.1% --set rows=2 -o tw ";
  ASSERT_EQ(run(test + "--pressure 100kPa,200kPa p1.csv p2.csv cell.in").status, 0);
  for (const char* const name : {"tw_mean.csv", "tw_envelope.csv"})
    EXPECT_TRUE(std::filesystem::exists(scratch.path() / name)) << name;
  ASSERT_EQ(run(test + "--pressure 100kPa p1.csv cell.in").status, 0);
  for (const char* const name : {"tw_mean.csv", "tw_envelope.csv"})
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / name)) << name;
}

TEST_F(ElementCommand, AnOedometerTestHasNoEnvelope) {
  write_packings(scratch.path(), 1);
  const Outcome outcome =
      run("--test oedometer --set axial_strain=1% --set rows=2 --pressure 100kPa,200kPa p1.csv cell.in");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_NE(outcome.out.find("no envelope: isotropic and oedometer tests"), std::string::npos) << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "element_envelope.csv"));
}

TEST_F(ElementCommand, APackingOfAnotherPressureIsToBeSettled) {
  write(scratch.path() / "weak.in", "fail_beyond 1e-6\n");
  const Outcome outcome =
      run("--test biaxial --pressure 1kPa --set rows=1 --set cuts=3 " + kPacking + " weak.in");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("the packing was made under 100 kPa: settle it"), std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("--set pressure='1 kPa'"), std::string::npos) << outcome.errors;
}

TEST_F(ElementCommand, APlainHalfIsNotTakenForAStrain) {
  const std::string cells = "packing: " + kPacking + "\nscript: cell.in\npressure: 100 kPa\n";
  expect_fault(
      cells + "test: biaxial\naxial_strain: 0.5\n",
      "spec.yaml:5: element test: axial_strain: 0.5 is 50 %? Write '0.5 %', or '50 %' if that is meant");
  expect_fault(cells + "test: biaxial\naxial_strain: 1\n", "axial_strain: 1 is 100 %?");
  expect_fault(cells + "test: biaxial\naxial_strain: 100 %\n",
               "axial_strain: 100 % leaves nothing of the length");
  expect_fault(cells + "stages: [{e22: -0.5, s11: hold}]\n", "e22: -0.5 is -50 %?");
}

TEST_F(ElementCommand, RemarksComeBeforeTheTest) {
  write_packings(scratch.path(), 1);
  const Outcome few =
      run("--test oedometer --pressure 100kPa --set axial_strain=1% --set rows=2 p1.csv cell.in");
  EXPECT_TRUE(few.out.starts_with("wrong: polargrain element: packing 'p1': the box of grains is"))
      << few.out;
  const std::string rest =
      "test: triaxial\naxial_strain: 1 %\nrows: 4\nmaterial:\n  model: elastoplastic\n  friction_angle: 30 deg\n"
      "  dilatancy_angle: 0 deg\n  cohesion: 1 kPa\n  nu: 0.3\n  Gc: 10 MPa\n  lc: 1 mm\n";
  const Outcome cone = run_text("pressure: 100 kPa\n" + rest + "  E: 50 MPa\n");
  ASSERT_EQ(cone.status, 0) << cone.errors;
  EXPECT_NE(cone.out.find(
                "doubtful: spec.yaml:7: material: 30 deg hold in plane strain, the default here; in triaxial "
                "compression this cone has 22.23 deg; match: triaxial_compression"),
            std::string::npos)
      << cone.out;
  const Outcome meant =
      run_text("pressure: 100 kPa\n" + rest + "  E: 50 MPa\n  match: triaxial_compression\n");
  EXPECT_EQ(meant.out.find("doubtful"), std::string::npos) << meant.out;
  const auto of_test = [&](const std::string& test, const std::string& match) {
    std::string text = rest;
    text.replace(text.find("triaxial\naxial_strain: 1 %"), 26, test);
    return run_text("pressure: 100 kPa\n" + text + "  E: 50 MPa\n  match: " + match + "\n").out;
  };
  for (const auto& [test, state] :
       {std::pair{"triaxial\naxial_strain: -1 %", "triaxial extension"},
        {"biaxial\naxial_strain: 1 %", "plane strain"},
        {"simple_shear\nshear_strain: 1 %", "plane strain"},
        // M = 1.2: sin = 3 M / (6 - M) in extension, M / sqrt(3) at b = 0.5
        {"triaxial\ncycles: 1\namplitude: 0.1 %", "triaxial extension this cone has 48.59"},
        {"constant_p\naxial_strain: -1 %", "triaxial extension this cone has 48.59"},
        {"true_triaxial\nb: 0.5\naxial_strain: 1 %",
         "a test with b = 0.5 this cone has 43.85 deg; match: triaxial_compression with "
         "friction_angle: 22.23 deg"}})
    EXPECT_NE(of_test(test, "triaxial_compression")
                  .find(std::string("30 deg hold where 'match' says: triaxial_compression; in ") + state),
              std::string::npos)
        << of_test(test, "triaxial_compression");
  EXPECT_EQ(of_test("biaxial\naxial_strain: 1 %", "plane_strain").find("doubtful"), std::string::npos);
  std::string wrong_unit = rest;
  wrong_unit.replace(wrong_unit.find("1 kPa"), 5, "5 MPa");
  const Outcome cohesive =
      run_text("pressure: 100 kPa\n" + wrong_unit + "  E: 50 MPa\n  match: triaxial_compression\n");
  EXPECT_NE(cohesive.out.find("a cohesion of 5000 kPa, and the pressure is 100 kPa"), std::string::npos)
      << cohesive.out;
  const Outcome soft =
      run_text("pressure: 10 kPa\n" + rest + "  E: 500 kPa\n  match: triaxial_compression\n");
  EXPECT_NE(soft.out.find("doubtful: spec.yaml:13: material: E is 500 kPa; check the unit of E"),
            std::string::npos)
      << soft.out;
  const Outcome softer =
      run_text("pressure: 100 kPa\n" + rest + "  E: 500 kPa\n  match: triaxial_compression\n");
  EXPECT_NE(softer.out.find("wrong: spec.yaml:13: material: E is 500 kPa, and the pressure is 100 kPa"),
            std::string::npos)
      << softer.out;
}

// Keys of tests count compression positive, components tension: a wrong sign pulled at the sample without a word.
TEST_F(ElementCommand, AStressOfTheWrongSignIsTold) {
  const auto told = [&](const std::string& test) { return run_text(kLaw + "rows: 2\n" + test).out; };
  const std::string oedometer = told("test: oedometer\naxial_stress: -150 kPa\n");
  EXPECT_NE(
      oedometer.find("wrong: spec.yaml:5: axial_stress: -150 kPa is tension, and the sample begins under "
                     "100 kPa of pressure; axial_stress counts compression positive; write 150 kPa"),
      std::string::npos)
      << oedometer;
  const auto stages = [&](const std::string& list) {
    return run_text(kLaw + "stages:\n  - {rows: 2, " + list + "}\n").out;
  };
  const std::string components = stages("s11: 50 kPa, s22: 50 kPa, s33: 50 kPa");
  EXPECT_NE(
      components.find("wrong: spec.yaml:4: s11: 50 kPa is tension, and the sample begins under 100 kPa of "
                      "pressure; s11 counts tension positive; write -50 kPa for compression"),
      std::string::npos)
      << components;
  EXPECT_NE(stages("p: -50 kPa, q: hold, e33: hold").find("p counts compression positive; write 50 kPa"),
            std::string::npos);
  // Neighbours: compression, and a pull along the axis that the lateral pressure outweighs.
  EXPECT_EQ(told("test: oedometer\naxial_stress: 150 kPa\n").find("is tension"), std::string::npos);
  EXPECT_EQ(stages("s11: -50 kPa, s22: -50 kPa, s33: -50 kPa").find("is tension"), std::string::npos);
  EXPECT_EQ(stages("s11: hold, s22: 20 kPa, s33: hold").find("is tension"), std::string::npos);
  EXPECT_EQ(stages("e22: -0.5 %}\n  - {rows: 2, s11: hold, s22: 20 kPa, s33: hold").find("is tension"),
            std::string::npos);
}

// E / (1 - nu^2) strains by 1 % against a held lateral stress: 449 kPa of tension there, and nu times the change across.
TEST_F(ElementCommand, AMeanStressInTensionIsTold) {
  const auto told = [&](const std::string& strain) {
    return run_text(kLaw + "rows: 1\ntest: biaxial\naxial_strain: " + strain + "\n").out;
  };
  const std::string pulled = told("-1 %");
  EXPECT_NE(pulled.find("elastic: p is -138.1 kPa in row 1 of stage 1: tension. 'axial_strain'"),
            std::string::npos)
      << pulled;
  EXPECT_EQ(told("-0.1 %").find(": tension"), std::string::npos) << "extension under pressure";
  EXPECT_EQ(told("1 %").find(": tension"), std::string::npos);
}

TEST_F(ElementCommand, AVoidRatioInPerCentIsTold) {
  const auto told = [&](const std::string& ratio) {
    return run_text(kLaw + "rows: 2\ntest: biaxial\naxial_strain: 0.1 %\nvoid_ratio: " + ratio + "\n").out;
  };
  const std::string far = told("70");
  EXPECT_NE(
      far.find("doubtful: spec.yaml:6: void_ratio: 70 (sand: 0.4 to 1, clay: to 3); check it; if per cent "
               "are meant, write 0.7"),
      std::string::npos)
      << far;
  EXPECT_EQ(told("3").find("doubtful"), std::string::npos);
}

TEST_F(ElementCommand, ACellThatFailsIsAFailureWithItsReason) {
  write(scratch.path() / "weak.in", "fail_beyond 1e-6\n");
  const Outcome outcome =
      run("--test biaxial --pressure 100kPa --set axial_strain=5% --set rows=1 --set cuts=3 " + kPacking +
          " weak.in");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("stage 2 (biaxial), row 1 of 1: "), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("the box collapsed"), std::string::npos) << outcome.errors;
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "element.csv"));
  EXPECT_NE(content(scratch.path() / "element.html").find("ended before its end"), std::string::npos);
}

}  // namespace
}  // namespace polargrain::testing
