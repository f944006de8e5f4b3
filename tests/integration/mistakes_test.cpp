// SPDX-License-Identifier: GPL-2.0-or-later
// The mistakes that people make, each with the message that must come; the table of docs/questions.md is held to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;
const std::string kSource = POLARGRAIN_SOURCE_DIRECTORY;

// A sound case: every mistake is one change to it.
const std::string kCase = R"(title: Compression of grains
mesh:
  rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}
materials:
  sand: {model: cell, script: cell.in, packing: grains.h5, lc: 8 mm}
regions: {all: sand}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: top, fix: [u1], move: {u2: -4 mm}}
  - {on: [left, right], pressure: 100 kPa}
steps: {count: 4, tolerance: 1e-2}
monitors:
  top_force: {on: top, reaction: u2}
  stress_ratio: -top_force / (0.4 m * 100 kPa)
)";

const std::string kLaw =
    "{model: elastoplastic, E: 20 MPa, nu: 0.3, Gc: 10 MPa, lc: 5 mm, friction_angle: 40 deg, dilatancy_angle: 10 deg, "
    "cohesion: 1 kPa}";

// One square without any physical group; `kind` 3 is a quadrilateral of 4 nodes in Gmsh's manual, 2 a triangle of 3.
std::string mesh_of(const std::string& element) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
         "$Elements\n1\n" +
         element + "\n$EndElements\n";
}

struct Mistake {
  std::string name;
  std::string good;     ///< in the case
  std::string bad;      ///< put in its place
  std::string message;  ///< what must come, among other things that may
  std::string command = "check case.yaml";
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

void replace(std::string& text, const std::string& good, const std::string& bad) {
  const std::size_t place = text.find(good);
  ASSERT_NE(place, std::string::npos) << good;
  text.replace(place, good.size(), bad);
}

/// With every run of blanks as one, so that a page may break its lines where it likes.
std::string joined(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!blank) out += c;
    if (blank && !out.empty() && out.back() != ' ') out += ' ';
  }
  return out;
}

class MistakeTest : public ::testing::TestWithParam<Mistake> {};

TEST_P(MistakeTest, HasItsMessage) {
  const Mistake& mistake = GetParam();
  const Scratch scratch("mistake_" + mistake.name);
  const std::filesystem::path& at = scratch.path();
  std::string text = kCase;
  replace(text, mistake.good, mistake.bad);
  const std::string script = content(kSource + "/liggghts_inputs/cells/hooke_radii.in");
  write(at / "case.yaml", text);
  write(at / "cell.in", script);
  write(at / "loop.in", script + "label again\njump SELF again\n");
  write(at / "shell.in", script + "shell ls\n");
  std::string other = script;
  replace(other, "model hooke/radii", "model hertzz");
  write(at / "typo.in", other);
  other = script;
  replace(other, "1 6e8", "1 6e6");
  write(at / "soft.in", other);
  write(at / "packing.yaml", "title: a specification\n");
  write(at / "bare.msh", mesh_of("1 3 2 0 1 1 2 3 4"));
  write(at / "triangle.msh", mesh_of("1 2 2 0 1 1 2 3"));
  write(at / "twice.csv", "h11,h22,h11\n1e-4,0,0\n");
  write(at / "empty.yaml", "# later\n");
  write(at / "tab.yaml", "steps:\n\tcount: 4\n");
  std::filesystem::create_directories(at / "thesis");
  write(at / "thesis" / "chapter1.txt", "all of it");
  std::filesystem::copy_file(kSource + "/cases/footing_cells/packing100.h5", at / "grains.h5");

  const Outcome outcome = run_in(at, kProgram + " " + mistake.command);
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(joined(outcome.errors).find(joined(mistake.message)), std::string::npos)
      << "expected: " << mistake.message << "\nfound: " << outcome.errors;
  EXPECT_EQ(outcome.out.find("no faults"), std::string::npos) << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(at / "results"));
}

std::vector<Mistake> mistakes() {
  return {
      {"ForgottenUnit", "lc: 8 mm", "G: 40, Gc: 10 MPa, lc: 8 mm",
       "G: '40' has no unit, '10 MPa' of Gc has one; write '40 Pa' if that is its unit"},
      {"UnitOfOneItem", "[0.4 m, 0.8 m]", "[0.4 m, 0.8]", "size: '0.8' has no unit, '0.4 m' has one"},
      {"DegreesWithoutUnit", "{model: cell, script: cell.in, packing: grains.h5, lc: 8 mm}",
       std::string(kLaw).replace(kLaw.find("40 deg"), 6, "40"),
       "friction_angle: '40' without a unit is in rad, more than a whole turn; write '40 deg'"},
      {"WrongUnit", "lc: 8 mm", "lc: 8 kPa", "lc: expected a length in m, or with one of the units m, mm,"},
      {"DecimalComma", "lc: 8 mm", "lc: '8,5 mm'", "found '8,5 mm'; decimals are written with a point, 1.5"},
      {"InertialNumber", "lc: 8 mm", "lc: 8 mm, inertial_number: 5",
       "inertial_number: must be below 0.1, found '5': grains would fly past each other instead of resting on each "
       "other"},
      {"UnbalancedRatio", "lc: 8 mm", "lc: 8 mm, unbalanced_force_ratio: 5",
       "unbalanced_force_ratio: must be below 1, found '5': any state at all would count as at rest"},
      {"Tolerance", "tolerance: 1e-2", "tolerance: 10",
       "tolerance: must be below 1, found '10': the unbalanced forces may not be as large as the loads"},
      {"ToleranceOfRounding", "tolerance: 1e-2", "tolerance: 1e-15",
       "tolerance: must be at least 1e-13, found '1e-15': a smaller one cannot be reached, as numbers carry 16 digits"},
      {"JumpResidual", "tolerance: 1e-2", "tolerance: 1e-2, jump_residual: 200 %",
       "jump_residual: must be below 1, found '200 %': the unbalanced forces may not be as large as the loads"},
      {"ToleranceInPerCent", "model: cell, script: cell.in",
       "model: adaptive, adaptive: {tolerance: 3}, script: cell.in",
       "tolerance: must be below 1, found '3': it is a share of the confining pressure, 3 % is '3 %' or 0.03"},
      {"UnitInAFormula", "0.4 m * 100 kPa", "0.4 m * 100 kpa", "'kpa' is no unit (%, m, mm,"},
      {"OtherNameOfAKey", "{model: cell, script: cell.in, packing: grains.h5, lc: 8 mm}",
       std::string(kLaw).replace(kLaw.find("dilatancy"), 9, "dilation"),
       "unknown key 'dilation_angle'; did you mean 'dilatancy_angle'?"},
      {"MisspelledKey", "tolerance: 1e-2", "tolerence: 1e-2",
       "unknown key 'tolerence'; did you mean 'tolerance'?"},
      {"MeshWithoutNames", "  rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}", "  file: bare.msh",
       "the mesh has no boundary or node set 'bottom'; no Curve of it has a name: in the script for Gmsh write "
       "Physical Curve(\"bottom\") = {1};"},
      {"FirstOrderTriangles", "  rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}", "  file: triangle.msh",
       "it has triangles of 3 nodes, too stiff to be offered: set Mesh.ElementOrder = 2"},
      {"UnknownBoundary", "on: top, fix", "on: topp, fix",
       "the mesh has no boundary or node set 'topp'; did you mean 'top'?"},
      {"TwoValuesAtACorner", "  - {on: [left, right], pressure: 100 kPa}", "  - {on: left, move: {u2: 1 mm}}",
       "u2 is given two different values at the node (0, 0), on 'bottom' and on 'left': give it once there, or give that "
       "node an item of its own, on 'bottom_left': a set of nodes goes before boundaries"},
      {"FreeBody", "  - {on: bottom, fix: [u1, u2]}\n  - {on: top, fix: [u1], move: {u2: -4 mm}}",
       "  - {on: bottom, fix: [u1]}\n  - {on: top, pressure: 100 kPa}",
       "nothing holds the body against a rigid motion (translation along 2); fix or move a displacement that stops "
       "it"},
      {"PressureOnANode", "on: [left, right], pressure", "on: [left, top_left], pressure",
       "a pressure needs a boundary, 'top_left' is a set of nodes; boundaries are bottom, left, right, top"},
      {"RegionWithoutMaterial", "{all: sand}", "{core: sand}", "the mesh has no region 'core'; it has all"},
      {"SpecificationAsPacking", "packing: grains.h5", "packing: packing.yaml",
       "'packing.yaml' is the specification of a packing; make the packing of it, polargrain pack packing.yaml -o "
       "packing.h5, and name that"},
      {"NoPacking", "packing: grains.h5", "packing: grain.h5",
       "there is no file 'grain.h5', neither beside the case nor below liggghts_inputs/"},
      {"PackingOfAnotherScript", "script: cell.in", "script: soft.in",
       "The packing was made with another script, or its grains were moved; bring it to rest with "
       "'polargrain pack --settle PACKING SCRIPT -o NEW.h5'"},
      {"UnknownContactModel", "script: cell.in", "script: typo.in",
       "pair_style gran model hertzz tangential history ERROR: Invalid model specified (check for typos"},
      {"LoopInAScript", "script: cell.in", "script: loop.in",
       "'jump' makes loops and jumps, and the script of a cell is read once, from its first line to its last: write "
       "the lines out one by one"},
      {"CommandThatIsNotForCells", "script: cell.in", "script: shell.in",
       "the command 'shell' is not among those that set up a cell; remove it, or give --trust-scripts"},
      {"NoInternalLength", ", lc: 8 mm", "", "the key 'lc' is missing; give a length in m"},
      {"CosseratPartTwice", "lc: 8 mm", "lc: 8 mm, rotations: controlled",
       "lc: with 'rotations: controlled' the grains give the skew stress and the couple stresses themselves; leave lc "
       "out, or set 'rotations: free'"},
      {"InitialStressOfCells", "regions: {all: sand}",
       "regions: {all: sand}\ninitial_stress: [{stress: [-100 kPa, -100 kPa, -100 kPa, 0]}]",
       "region 'all' is made of cells, which are led to the stress of level ground alone; give surface, unit_weight and "
       "K0, or name another region"},
      {"MeasuredRatioOfALaw", "{model: cell, script: cell.in, packing: grains.h5, lc: 8 mm}",
       std::string(kLaw) + "\ninitial_stress: [{surface: 1 m, unit_weight: 18 kN/m3, K0: measured}]",
       "region 'all' is made of a law, which has no K0 of its own; give a number"},
      {"DilatancyAboveFriction", "{model: cell, script: cell.in, packing: grains.h5, lc: 8 mm}",
       std::string(kLaw).replace(kLaw.find("10 deg"), 6, "45 deg"),
       "plastic flow would create energy; lower the dilatancy"},
      {"ValueThatComesLater", "-top_force /", "-side_force /", "there is no value 'side_force' before it"},
      {"UnknownCommand", "title", "title", "there is no command 'chek'; did you mean 'check'?",
       "chek case.yaml"},
      {"PackingForACase", "title", "title",
       "this is a packing or a checkpoint by its name; give a case or a specification, NAME.yaml",
       "run grains.h5"},
      {"FolderWithOtherFiles", "title", "title",
       "exists and holds no former result; give an empty or new directory with -o DIR",
       "run case.yaml -o thesis"},
      {"ColumnTwice", "title", "title", "the column 'h11' stands there twice; give it once",
       "point case.yaml sand twice.csv"},
      {"TabInYaml", "title", "title", "the line begins with a tab, and only spaces may stand there",
       "check tab.yaml"},
      {"DashForAMinusSign", "-4 mm", "\u22124 mm",
       "found '\u22124 mm'; its dash is not a minus sign: write the '-' of the keyboard"},
      {"SpecialSpace", "-4 mm", "-4\u00a0mm", "it holds a special space: write an ordinary one"},
      {"UnitInOtherLetters", "pressure: 100 kPa", "pressure: 100 Kpa",
       "found '100 Kpa'; did you mean '100 kPa'?"},
      {"PowerInAFormula", "-top_force / (0.4 m * 100 kPa)", "top_force ^ 2",
       "there are no powers, write x * x: expected one of + - * / at character 11"},
      {"FunctionInAFormula", "-top_force / (0.4 m * 100 kPa)", "abs(top_force)",
       "there are no functions: expected one of + - * / at character 4"},
      {"OpenBracket", "tolerance: 1e-2}", "tolerance: 1e-2", "the '{' in line 11 is not closed"},
      {"FixedAndMoved", "fix: [u1], move", "fix: [u1, u2], move",
       "case.yaml:9: boundary item 2: fix: u2 is below 'move' too; keep one of them"},
      {"EmptyCase", "title", "title", "empty.yaml: is empty, or all of it is comments", "check empty.yaml"},
      {"UnknownOption", "title", "title",
       "polargrain run: there is no option '--setp'; did you mean '--set'? See polargrain run --help",
       "run case.yaml --setp x"},
      {"TwoDirectories", "title", "title",
       "polargrain report: DIR: expected at most 1, found 2 See polargrain report --help",
       "report first second"},
      {"WorkersInWords", "title", "title", "--workers: two is not a number from 0 to 4096",
       "run case.yaml -w two"},
      {"OptionWithoutValue", "title", "title", "polargrain run: --set: give a value, KEY=VALUE",
       "run case.yaml --set"},
      {"NoCase", "title", "title", "polargrain run: CASE is missing See polargrain run --help", "run"},
      {"NothingToResume", "title", "title", "holds no run to go on with; name its directory with -o DIR",
       "run case.yaml --resume -o nowhere"}};
}

/// The second cells of the rows of a table.
std::vector<std::string> told_on(const std::string& page) {
  std::vector<std::string> cells;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t between = line.rfind(" | ", line.size() - std::min<std::size_t>(line.size(), 4));
    if (line.starts_with("| ") && between != std::string::npos)
      cells.push_back(line.substr(between + 3, line.size() - between - 5));
  }
  return cells;
}

TEST(QuestionsAndAnswers, TellWhatTheProgramSays) {
  const std::string page = content(kSource + "/docs/questions.md");
  const std::size_t end =
      page.find("\n## ", page.find("\n## ") + 1);  // the table stands in the first section
  const std::vector<std::string> cells = told_on(page.substr(0, end));
  EXPECT_GE(cells.size(), 10u);
  for (std::size_t row = 1; row < cells.size(); ++row)  // behind the head
    EXPECT_TRUE(std::ranges::any_of(mistakes(),
                                    [&](const Mistake& mistake) {
                                      return joined(cells[row]).find(joined(mistake.message)) !=
                                             std::string::npos;
                                    }))
        << "no mistake is told of like this: " << cells[row];
}

/// Input that was refused once, or looks like a mistake, and is right.
class NoMistakeTest : public ::testing::TestWithParam<Mistake> {};

TEST_P(NoMistakeTest, IsTaken) {
  const Scratch scratch("no_mistake_" + GetParam().name);
  std::string text = kCase;
  replace(text, GetParam().good, GetParam().bad);
  write(scratch.path() / "case.yaml", text);
  write(scratch.path() / "cell.in", content(kSource + "/liggghts_inputs/cells/hooke_radii.in"));
  std::filesystem::copy_file(kSource + "/cases/footing_cells/packing100.h5", scratch.path() / "grains.h5");
  const Outcome outcome = run_in(scratch.path(), kProgram + " check case.yaml");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
}

const std::string kMaterial = "model: cell, script: cell.in, packing: grains.h5, lc: 8 mm";

std::string all_keys_of_schemes(const std::string& model) {
  return "model: " + model +
         ", script: cell.in, packing: grains.h5, lc: 8 mm, adaptive: {tolerance: 2 %, audit: 0, seed: 2}, informed: {nu: 0.25, update: frozen, "
         "drift_shear: 0.02, mismatch_limit: 20 %, cohesion: 50 Pa}";
}

INSTANTIATE_TEST_SUITE_P(
    All, NoMistakeTest,
    ::testing::Values(
        Mistake{"KeysOfOtherSchemesInCell", kMaterial, all_keys_of_schemes("cell"), ""},
        Mistake{"KeysOfOtherSchemesInAdaptive", kMaterial, all_keys_of_schemes("adaptive"), ""},
        Mistake{"KeysOfOtherSchemesInInformed", kMaterial, all_keys_of_schemes("informed"), ""},
        Mistake{"NoLengthInAClassicalContinuum", kMaterial + "}",
                "model: cell, script: cell.in, packing: grains.h5}\ncontinuum: cauchy", ""},
        Mistake{"LawWithoutCosseratPartInAClassicalContinuum", "{" + kMaterial + "}",
                "{model: elastic, E: 20 MPa, nu: 0.3}\ncontinuum: cauchy", ""},
        Mistake{"OneValueInTwoWays", "  - {on: [left, right], pressure: 100 kPa}",
                "  - {on: left, move: {u1: 0}}", ""},
        Mistake{"ACornerOfItsOwn", "  - {on: [left, right], pressure: 100 kPa}",
                "  - {on: right, move: {u1: 1 mm}}\n  - {on: [bottom_right, top_right], fix: [u1]}", ""},
        Mistake{"MonitorOverTwoBoundaries", "{on: top, reaction: u2}", "{on: [top, left], reaction: u2}", ""},
        Mistake{"UnitWithAStroke", "0.4 m * 100 kPa", "0.4 m * 100 kN/m3 * 1 m", ""}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(All, MistakeTest, ::testing::ValuesIn(mistakes()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace polargrain::testing
