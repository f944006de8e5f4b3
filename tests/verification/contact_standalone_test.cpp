// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain-liggghts as a user runs it: textbook answers of the contact laws (docs/theory.md, D.5), the same
// digits as the stock engine, and what it says of bad scripts.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Outcome {
  int status = 0;
  std::string text;  ///< standard output and error
  /// Rows of the thermo table: lines of numbers only, as many as asked for.
  [[nodiscard]] std::vector<std::vector<double>> rows(std::size_t columns) const {
    std::vector<std::vector<double>> table;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::vector<double> row;
      for (double value = 0.0; words >> value;) row.push_back(value);
      if (words.eof() && row.size() == columns) table.push_back(row);
    }
    return table;
  }
};

Outcome run(const std::string& program, const std::string& arguments) {
  const std::string command = program + " " + arguments + " -log none 2>&1";
  Outcome outcome;
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> block{};
  while (const std::size_t got = fread(block.data(), 1, block.size(), pipe))
    outcome.text.append(block.data(), got);
  outcome.status = pclose(pipe);
  return outcome;
}

const std::string kProgram = POLARGRAIN_LIGGGHTS;
/// The stock engine without the folder that Open MPI shares between all its programs: one that starts while another
/// removes the folder fails.
const std::string kStock = "OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_orte_create_session_dirs=0 liggghts";
const std::string kScripts = "liggghts_inputs/contact_models/";

TEST(Standalone, DiscOnAnInclineStaysBelowItsRollingFriction) {
  const Outcome outcome = run(kProgram, "-in " + kScripts + "incline.in -var angle 0.099 -var mu_th 0.1");
  const auto rows = outcome.rows(3);
  ASSERT_EQ(rows.size(), 6U) << outcome.text;
  std::cout << "[figure] tan(0.099) < 0.1: velocity after 0.5 s " << rows.back()[1] << " m/s\n";
  // tan(0.099) = 0.0993. Free rolling would have reached 0.3 m/s; what is left is the decaying elastic swing.
  EXPECT_LT(std::abs(rows.back()[1]), 1e-6);
}

TEST(Standalone, DiscOnAnInclineRollsDownBeyondItsRollingFriction) {
  for (const double angle : {0.105, 0.2, 0.4}) {
    const Outcome outcome =
        run(kProgram, "-in " + kScripts + "incline.in -var mu_th 0.1 -var angle " + std::to_string(angle));
    const auto rows = outcome.rows(3);
    ASSERT_EQ(rows.size(), 6U) << outcome.text;
    const double acceleration = (rows[5][1] - rows[2][1]) / (15000 * 2e-5);
    const double exact = 9.81 * (std::sin(angle) - 0.1 * std::cos(angle)) / 1.5;
    std::cout << "[figure] incline " << angle << ": acceleration / exact " << acceleration / exact << "\n";
    // The lever arm is short of the radius by the overlap, 4e-5 of it; next to the limit that weighs
    // mu_th cos / (sin - mu_th cos) = 19 times as much.
    EXPECT_NEAR(acceleration / exact, 1.0, 1e-3);
  }
}

// Many may run side by side: none needs the folder for temporary files that Open MPI's daemons share.
TEST(Standalone, StartsWithoutAFolderForTemporaryFiles) {
  const Outcome outcome =
      run("TMPDIR=/dev/null " + kProgram, "-in " + kScripts + "restitution.in -var zeta 0");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
}

TEST(Standalone, HeadOnCollisionRestitutes) {
  for (const double zeta : {0.0, 0.05, 0.3}) {
    const auto rows =
        run(kProgram, "-in " + kScripts + "restitution.in -var zeta " + std::to_string(zeta)).rows(2);
    ASSERT_FALSE(rows.empty());
    const double exact = std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
    std::cout << "[figure] restitution, zeta " << zeta << ": " << rows.back()[1] << " (exact " << exact
              << ")\n";
    // Velocity Verlet takes the dashpot half a step late: zeta omega dt / 2 = 1e-4.
    EXPECT_NEAR(rows.back()[1], exact, 1e-3);
  }
}

TEST(Standalone, StuckContactSwingsAtItsFrequency) {
  const auto rows = run(kProgram, "-in " + kScripts + "oscillation.in").rows(2);
  ASSERT_EQ(rows.size(), 4001U);
  // v = v0 (2/3 + cos(omega t) / 3): the rolling part goes on. Crossings of 2 v0 / 3.
  std::vector<double> crossings;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const double before = rows[k - 1][1] - 2e-5 / 3.0;
    const double after = rows[k][1] - 2e-5 / 3.0;
    if (before * after < 0.0)
      crossings.push_back((rows[k - 1][0] + (rows[k][0] - rows[k - 1][0]) * before / (before - after)) *
                          1e-6);
  }
  ASSERT_GE(crossings.size(), 5U);
  if (crossings.size() % 2 == 0) crossings.pop_back();  // whole periods, whatever the level of the crossings
  const double frequency =
      std::numbers::pi * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
  const double mass = std::numbers::pi * 1e-4 * 2500;
  const double normal_stiffness = 2e5;
  const double exact = std::sqrt(3.0 * 0.8 * normal_stiffness / mass);
  std::cout << "[figure] oscillation: omega / exact " << frequency / exact << "\n";
  // The lever arms of slip and torque may be short of the radius by the overlap m g / k_n = 0.4 % of it:
  // 1 + 2 arm^2 in place of 3 makes at most 0.26 % in omega.
  EXPECT_NEAR(frequency / exact, 1.0, 2.6e-3);
}

std::string thermo_lines(const Outcome& outcome) {
  std::istringstream lines(outcome.text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    double step = 0.0;
    double grains = 0.0;
    if (words >> step >> grains && grains == 100.0) kept += line + "\n";
  }
  return kept;
}

TEST(Standalone, PrintsTheDigitsOfTheStockEngine) {
  if (std::system("command -v liggghts > /dev/null") != 0)
    GTEST_SKIP() << "no `liggghts` program on this machine";
  const std::string script = "-in liggghts_inputs/standalone/identity.in";
  const std::string stock = thermo_lines(run(kStock, script));
  ASSERT_GE(std::count(stock.begin(), stock.end(), '\n'), 50);
  EXPECT_EQ(thermo_lines(run(kProgram, script)), stock);
  EXPECT_EQ(
      thermo_lines(run(POLARGRAIN_RENAMED_COPY,
                       script + " -var normal copy/of/hooke/stiffness -var tangential copy/of/history")),
      stock)
      << "copies of the stock models under other names part from the stock engine";
  // The copies are what ran: the program knows their names, and the stock engine does not.
  EXPECT_NE(run(kStock, script + " -var normal copy/of/hooke/stiffness").status, 0);
}

/// A box for discs (dimension 2) or spheres with the given lines in it; returns what the program says.
Outcome run_script(const std::string& lines,
                   const std::string& end =
                       "create_atoms 1 single 0 0 0 units box\nset atom 1 diameter 0.02 "
                       "density 2500\nrun 0\n",
                   int dimension = 2) {
  const std::string head =
      "units si\ndimension " + std::to_string(dimension) +
      "\natom_style granular\natom_modify map array\nboundary f f p\nnewton off\n"
      "communicate single vel yes\nregion box block -1 1 -1 1 -1 1 units box\ncreate_box 1 box\nneighbor 0.1 "
      "bin\n"
      "fix e all property/global contactModulus peratomtypepair 1 1e7\n"
      "fix a all property/global tangentialStiffnessRatio peratomtypepair 1 0.8\n"
      "fix f all property/global coefficientFriction peratomtypepair 1 0.5\n";
  const auto file =
      std::filesystem::temp_directory_path() / ("polargrain_bad_" + std::to_string(getpid()) + ".in");
  std::ofstream(file) << head << lines << end;
  Outcome outcome = run(kProgram, "-in " + file.string());
  const std::size_t found = outcome.text.find(file.string());
  if (found != std::string::npos) outcome.text.replace(found, file.string().size(), "SCRIPT");
  std::filesystem::remove(file);
  return outcome;
}

/// Two grains pressed onto each other and onto a wall, moving along both; their speeds after 50 steps.
Outcome run_combination(const std::string& models, int dimension) {
  std::string lines =
      "fix r all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
      "fix k all property/global rollingStiffnessRatio peratomtypepair 1 0.5\n"
      "fix s all property/global rollingFrictionForceStiffnessRatio peratomtypepair 1 0.1\n"
      "fix q all property/global coefficientRollingFrictionForce peratomtypepair 1 0.1\n"
      "fix rs all property/global rollingStiffness scalar 2.25\n"
      "fix rv all property/global coefficientRollingViscousDamping peratomtypepair 1 0.1\n"
      "fix ym all property/global youngsModulus peratomtype 5e7\n"
      "fix nu all property/global poissonsRatio peratomtype 0.2\n"
      "fix cr all property/global coefficientRestitution peratomtypepair 1 0.9\n"
      "fix cv all property/global characteristicVelocity scalar 1\n"
      "fix kn all property/global kn peratomtypepair 1 1e6\n"
      "fix kt all property/global kt peratomtypepair 1 8e5\n"
      "fix gn all property/global gamman_abs peratomtypepair 1 0\n"
      "fix gt all property/global gammat_abs peratomtypepair 1 0\n"
      "fix gan all property/global gamman peratomtypepair 1 0\n"
      "fix gat all property/global gammat peratomtypepair 1 0\n"
      "fix ce all property/global cohesionEnergyDensity peratomtypepair 1 1e4\n";
  lines += "pair_style gran model " + models + "\npair_coeff * *\n";
  lines += "fix wall all wall/gran model " + models + " primitive type 1 yplane 0\n";
  return run_script(lines,
                    "create_atoms 1 single 0 0.0099 0 units box\ncreate_atoms 1 single 0.0199 0.0099 0 units "
                    "box\nset group all diameter 0.02 density 2500\nvelocity all set 0.1 -0.2 0 units box\n"
                    "fix integrate all nve/sphere\ntimestep 1e-6\ncompute spin all erotate/sphere\n"
                    "thermo_style custom step ke c_spin\nthermo_modify norm no\nthermo 50\nrun 50\n",
                    dimension);
}

TEST(Standalone, StockModelsCombineWithThisProjects) {
  for (const std::string models :
       {"hooke tangential li_chu rolling_friction li_chu", "hertz tangential li_chu rolling_friction epsd2",
        "hertz/stiffness tangential li_chu", "hooke/stiffness tangential li_chu rolling_friction epsd3",
        "hooke/radii tangential history rolling_friction cdt",
        "hooke/radii tangential history rolling_friction epsd",
        "hooke/radii tangential no_history rolling_friction li_chu",
        "hooke/radii tangential li_chu cohesion sjkr rolling_friction li_chu",
        "hooke/radii tangential history cohesion sjkr2 rolling_friction epsd2",
        "hertz tangential history cohesion sjkr rolling_friction li_chu", "hooke/radii"}) {
    for (const int dimension : {2, 3}) {
      const Outcome outcome = run_combination(models, dimension);
      EXPECT_EQ(outcome.status, 0) << models << "\n" << outcome.text;
      const auto rows = outcome.rows(3);
      ASSERT_EQ(rows.size(), 2U) << models << "\n" << outcome.text;
      // The contacts act: the grains change their speed, and turn where there is a tangential force (the
      // stock model no_history has only a dashpot, which is zero here).
      EXPECT_GT(std::abs(rows[1][1] / rows[0][1] - 1.0), 1e-6) << models;
      const bool turns = models != "hooke/radii" && models.find("no_history") == std::string::npos;
      EXPECT_EQ(rows[1][2] > 0.0, turns) << models;
    }
  }
}

struct BadScript {
  std::string lines;
  std::vector<std::string> expected;
};

TEST(Standalone, NamesWhatIsWrongWithAScript) {
  const std::string style = "pair_style gran model hooke/radii tangential li_chu rolling_friction li_chu";
  const std::string rolling = "fix r all property/global coefficientRollingFriction peratomtypepair 1 ";
  const std::string ratio = "fix k all property/global rollingStiffnessRatio peratomtypepair 1 0.01\n";
  const std::string coeff = "\npair_coeff * *\n";
  const std::vector<BadScript> scripts{
      {"pair_style gran model hooke/radii tangential li_choo" + coeff,
       {"Invalid model specified", "SCRIPT:14: pair_style gran model hooke/radii tangential li_choo"}},
      {style + coeff, {"coefficientRollingFriction", "SCRIPT:18: run 0"}},
      {rolling + "-0.1\n" + ratio + style + coeff,
       {"coefficientRollingFriction requires values between 0", "SCRIPT:20: run 0"}},
      {rolling + "0.1\n" + ratio + style + " symmetricCoupling on" + coeff,
       {"symmetricCoupling on requires rollingFrictionForce on", "SCRIPT:16: pair_style gran"}},
      {rolling + "0.1\n" + ratio +
           "fix s all property/global rollingFrictionForceStiffnessRatio peratomtypepair 1 0.2\n" + style +
           " rollingFrictionForce on symmetricCoupling on" + coeff,
       {"rollingFrictionForceStiffnessRatio squared", "run 0"}},
      {"pair_style gran model hooke/radii tangential li_chu rollingFrictionForce on symmetricCoupling on" +
           coeff + "fix s all property/global rollingFrictionForceStiffnessRatio peratomtypepair 1 0.2\n",
       {"symmetricCoupling on requires rolling_friction li_chu"}}};
  for (const BadScript& script : scripts) {
    const Outcome outcome = run_script(script.lines);
    EXPECT_NE(outcome.status, 0) << script.lines;
    for (const std::string& words : script.expected)
      EXPECT_NE(outcome.text.find(words), std::string::npos) << "no '" << words << "' in\n" << outcome.text;
  }
}

}  // namespace
