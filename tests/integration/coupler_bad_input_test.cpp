// SPDX-License-Identifier: GPL-2.0-or-later
// Bad input never starts a run: one test a fault, with its whole message, exit status 2, nothing written.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

// The lines are counted in the expectations below.
const std::string kCase = R"(title: Compression of a fake
mesh:
  rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}
  element: Q8R
continuum: cosserat
materials:
  sand: {model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 10 mm}
  plate: {model: elastic, E: 1 GPa, nu: 0.3, Gc: 0.1 GPa, lc: 1 mm}
regions:
  all: sand
boundary:
  - {on: bottom, fix: [u2]}
  - {on: bottom_left, fix: [u1]}
  - {on: top, move: {u2: -4 mm}}
  - {on: [left, right], pressure: 100 kPa}
steps:
  count: 4
  cut: 2
monitors:
  top_force: {on: top, reaction: u2}
  stress_ratio: -top_force / (0.4 m * 100 kPa)
output:
  every: 2
  table: [stress_ratio]
)";

const std::string kPacking =
    "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\n"
    "id,x,y,r,mass,Izz\n"
    "1,0.05,0.05,0.04,1.0,8e-4\n";

struct BadInput {
  std::string name;
  std::string good;     ///< in the case
  std::string bad;      ///< put in its place
  std::string message;  ///< the whole standard error, without the last line end
  std::string options = {};
};

void PrintTo(const BadInput& input, std::ostream* out) {
  *out << input.name;
}

class BadInputTest : public ::testing::TestWithParam<BadInput> {
 protected:
  /// A directory with the case, without the unused material that one of the tests is about.
  static void fill(const std::filesystem::path& directory, std::string text) {
    write(directory / "case.yaml", text);
    write(directory / "fake.in", "fail_beyond 1\n");
    write(directory / "grains.csv", kPacking);
  }

  static std::string good_case() {
    std::string text = kCase;
    // A comment instead of the line keeps the count of lines.
    const std::size_t plate = text.find("  plate:");
    return text.replace(plate, text.find('\n', plate) - plate, "  #");
  }
};

std::vector<std::string> names_in(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST_P(BadInputTest, IsReportedAndNothingIsWritten) {
  const BadInput& input = GetParam();
  const Scratch scratch(input.name);
  std::string text = input.name == "UnusedMaterial" ? kCase : good_case();
  if (!input.good.empty()) {
    const std::size_t place = text.find(input.good);
    ASSERT_NE(place, std::string::npos);
    text.replace(place, input.good.size(), input.bad);
  }
  fill(scratch.path(), text);
  const std::vector<std::string> before = names_in(scratch.path());
  for (const std::string command : {"run case.yaml -o out ", "check case.yaml "}) {
    const Outcome outcome = run_in(scratch.path(), FAKE_POLARGRAIN " " + command + input.options);
    EXPECT_EQ(outcome.errors, input.message + "\n") << command;
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_EQ(outcome.out, "") << command;
  }
  EXPECT_EQ(names_in(scratch.path()), before);
}

INSTANTIATE_TEST_SUITE_P(
    Case, BadInputTest,
    ::testing::Values(
        BadInput{"UnknownKey", "  count: 4", "  count: 4\n  tolerence: 1e-3",
                 "case.yaml:18: steps: unknown key 'tolerence'; did you mean 'tolerance'?"},
        BadInput{
            "UnknownKeyFarFromAll", "  count: 4", "  count: 4\n  colour: red",
            "case.yaml:18: steps: unknown key 'colour'; known keys are stages, count, duration, first, method, time, cut, iterations, "
            "tolerance, moment_tolerance, noise, jumps, jump_residual, acceleration, largest_strain, line_search"},
        BadInput{"KeyByItsMeaning", "  count: 4", "  count: 4\n  tol: 1e-3",
                 "case.yaml:18: steps: unknown key 'tol'; did you mean 'tolerance'?"},
        BadInput{"UnknownTopKey", "continuum: cosserat", "continum: cosserat",
                 "case.yaml:5: case: unknown key 'continum'; did you mean 'continuum'?"},
        BadInput{"MissingKey", "  count: 4\n", "",
                 "case.yaml:17: steps: the key 'count' is missing; give a whole number of at least 1"},
        BadInput{"MissingSection", "steps:\n  count: 4\n  cut: 2\n", "",
                 "case.yaml:1: case: the key 'steps' is missing; give a map with at least 'count'"},
        BadInput{"DuplicateKey", "  cut: 2", "  count: 5",
                 "case.yaml:18: steps: the key 'count' was given before, in line 17; remove one of them"},
        BadInput{"NegativeSize", "[0.4 m, 0.8 m]", "[0.4 m, -0.8 m]",
                 "case.yaml:3: mesh.rectangle: size: must be greater than zero, found '-0.8 m'"},
        BadInput{"WrongUnit", "size: [0.4 m,", "size: [0.4 kPa,",
                 "case.yaml:3: mesh.rectangle: size: expected a length in m, or with one of the units m, mm, "
                 "cm, um, km, found '0.4 kPa'"},
        BadInput{"NoNumber", "G: 40 MPa", "G: stiff",
                 "case.yaml:7: material 'sand': G: expected a pressure in Pa, or with one of the units Pa, "
                 "kPa, MPa, GPa, or 'from packing', found 'stiff'"},
        BadInput{"NoNumberAndNoWordOfTwo", "lc: 10 mm", "lc: 10 mm, lp: unlimited",
                 "case.yaml:7: material 'sand': lp: expected a length in m, or with one of the units m, mm, "
                 "cm, um, km, or 'from packing', or 'none', found 'unlimited'"},
        BadInput{
            "NearlyAWord", "lc: 10 mm", "lc: 10 mm, skew_limit: non",
            "case.yaml:7: material 'sand': skew_limit: expected a number without a unit (% is allowed), or 'from "
            "packing', or 'none', found 'non'; did you mean 'none'?"},
        BadInput{"NoLength", "lc: 10 mm", "lc: short",
                 "case.yaml:7: material 'sand': lc: expected a length in m, or with one of the units m, mm, "
                 "cm, um, km, or 'from packing', or 'measured', found 'short'"},
        BadInput{"NotFinite", "G: 40 MPa", "G: inf",
                 "case.yaml:7: material 'sand': G: expected a pressure in Pa, or with one of the units Pa, "
                 "kPa, MPa, GPa, or 'from packing', found 'inf'"},
        BadInput{"ZeroModulus", "Gc: 10 MPa", "Gc: 0",
                 "case.yaml:7: material 'sand': Gc: must be greater than zero, found '0'"},
        BadInput{"FractionOfASteps", "count: 4", "count: 2.5",
                 "case.yaml:17: steps: count: expected a whole number of at least 1, found '2.5'"},
        BadInput{"LevelBetweenNodes", "elements: [2, 4]", "elements: [2, 4], levels: {middle: 0.41 m}",
                 "case.yaml:3: mesh.rectangle.levels: middle: no nodes are at a height of 0.41 m; elements "
                 "have theirs at their edges and in the middle of these"},
        BadInput{"LevelOfAKnownName", "elements: [2, 4]", "elements: [2, 4], levels: {top: 0.8 m}",
                 "case.yaml:3: mesh.rectangle.levels: top: a part of every rectangle has that name"},
        BadInput{"NoElements", "elements: [2, 4]", "elements: [2, 0]",
                 "case.yaml:3: mesh.rectangle: elements: expected a whole number of at least 1, found '0'"},
        BadInput{
            "ListTooShort", "elements: [2, 4]", "elements: [2]",
            "case.yaml:3: mesh.rectangle: elements: expected a list of 2, each a whole number of at least 1, "
            "found a list of 1"},
        BadInput{"MapExpected", "steps:\n  count: 4\n  cut: 2\n", "steps: 4\n",
                 "case.yaml:16: steps: expected a map of keys and values, found '4'"},
        BadInput{"ListExpected", "  count: 4", "  count: [4]",
                 "case.yaml:17: steps: count: expected a whole number of at least 1, found a list"},
        BadInput{"UnknownModel", "model: cell", "model: cel",
                 "case.yaml:7: material 'sand': model: expected one of elastic, elastoplastic, cell, "
                 "informed, adaptive, found "
                 "'cel'; did you mean "
                 "'cell'?"},
        BadInput{"MissingPacking", "packing: grains.csv", "packing: grain.csv",
                 "case.yaml:7: material 'sand': packing: there is no file 'grain.csv', neither beside the "
                 "case nor below liggghts_inputs/; correct the path or put the file there"},
        BadInput{"MissingScript", "script: fake.in", "script: cells/fake.in",
                 "case.yaml:7: material 'sand': script: there is no file 'cells/fake.in', neither beside the "
                 "case nor below liggghts_inputs/; correct the path or put the file there"},
        BadInput{"TableOutOfOrder", "pressure: 100 kPa", "pressure: [[0, 0], [1, 100 kPa], [1, 50 kPa]]",
                 "case.yaml:15: boundary item 4: pressure: the first value of a pair must be larger than in "
                 "the pair before, 1; found 1"},
        BadInput{
            "TimeThatIsNone", "pressure: 100 kPa", "pressure: [[0, 0], [abc, 1 kPa], [0.5, 1 kPa]]",
            "case.yaml:15: boundary item 4: pressure: expected a number without a unit (% is allowed), found 'abc'"},
        BadInput{
            "TimesOutOfOrderBesideAFault", "pressure: 100 kPa",
            "pressure: [[0, 0], [1 parsec, 1 kPa], [0, 1 kPa]]",
            "case.yaml:15: boundary item 4: pressure: expected a number without a unit (% is allowed), found '1 parsec'\n"
            "case.yaml:15: boundary item 4: pressure: the first value of a pair must be larger than in "
            "the pair before, 0; found 0"},
        BadInput{
            "TableWithoutPairs", "{u2: -4 mm}", "{u2: [0, -4 mm]}",
            "case.yaml:14: boundary item 3: move: u2: expected a pair of values, such as [0, 1], found '0'\n"
            "case.yaml:14: boundary item 3: move: u2: expected a pair of values, such as [0, 1], found "
            "'-4 mm'"},
        BadInput{"TractionInAForce", "pressure: 100 kPa", "traction: {u1: 1 kN}",
                 "case.yaml:15: boundary item 4: traction: u1: expected a pressure in Pa, or with one of the "
                 "units Pa, kPa, MPa, GPa, found '1 kN'"},
        BadInput{"UnknownDeformation", "continuum: cosserat", "deformation: finite",
                 "case.yaml:5: case: deformation: expected one of small, large, found 'finite'"},
        BadInput{"MissingMeshFile", "  rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}", "  file: no.msh",
                 "case.yaml:3: mesh: file: there is no mesh 'no.msh' beside the case; correct the path or "
                 "make the mesh (gmsh -2 SHAPE.geo, in space gmsh -3)"},
        BadInput{"FileThatIsNoMesh", "  rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}",
                 "  file: grains.csv", "case.yaml:3: mesh: grains.csv: expected a mesh file, NAME.msh"},
        BadInput{
            "MeshTwice", "  element: Q8R", "  file: a.msh",
            "case.yaml:4: mesh: give one of a rectangle, a box, a cylinder and a file; remove the others"},
        BadInput{
            "InitialStressOfCells", "continuum: cosserat", "initial_stress: [{stress: [0, 0, 0, 0]}]",
            "case.yaml:5: initial_stress: region 'all' is made of cells, which are led to the stress of level ground "
            "alone; give surface, unit_weight and K0, or name another region"},
        BadInput{
            "BodyWithoutLoad", "continuum: cosserat", "body: [{factor: 1}]",
            "case.yaml:5: body item 1: expected either 'unit_weight', for example 18 kN/m3, or 'force', a "
            "list of its 2 components"},
        BadInput{"BodyOfAnUnknownRegion", "continuum: cosserat",
                 "body: [{unit_weight: 1 kN/m3, region: core}]",
                 "case.yaml:5: body item 1: region: the mesh has no region 'core'; it has all"},
        BadInput{"StagesBackwards", "  count: 4", "  stages: [{until: 1, count: 2}, {until: 0.5, count: 2}]",
                 "case.yaml:17: stage 2: until: must be later than the end of the stage before, 1"},
        BadInput{"StageWithoutControl", "  count: 4", "  stages: [{count: 2}]",
                 "case.yaml:17: stage 1: expected one of until, measure (with grow) and arc_length"},
        BadInput{
            "ArcLengthAtFirst", "  count: 4", "  stages: [{count: 2, arc_length: 1 mm}]",
            "case.yaml:17: stage 1: arc_length: it goes on in the direction of the step before; begin with a stage "
            "'until'"},
        BadInput{
            "MeasureOfNothing", "  count: 4",
            "  stages: [{count: 2, measure: {on: topp, displacement: u1}, grow: 1 mm}]",
            "case.yaml:17: stage 1: measure: on: the mesh has no boundary or node set 'topp'; did you mean "
            "'top'?"},
        BadInput{
            "NothingHoldsTheRotations",
            "{model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 10 mm}",
            "{model: elastic, E: 1 MPa, nu: 0.3, Gc: 0, lc: 1 mm}",
            "case.yaml:7: materials: Gc is zero everywhere and no boundary fixes w, so nothing holds the "
            "micro-rotations; set 'continuum: cauchy', give Gc, or fix w"},
        BadInput{"UndampedBeyondOne", "lc: 10 mm", "lc: 10 mm, damping: 1.5",
                 "case.yaml:7: material 'sand': damping: must be below 1, found '1.5': grains would creep "
                 "to where they rest"},
        BadInput{"UnknownControlOfRotations", "lc: 10 mm", "lc: 10 mm, rotations: fixed",
                 "case.yaml:7: material 'sand': rotations: expected one of free, controlled, found 'fixed'"},
        BadInput{"CosseratPartTwice", "G: 40 MPa, Gc: 10 MPa, lc: 10 mm", "rotations: controlled, Gc: 10 MPa",
                 "case.yaml:7: material 'sand': Gc: with 'rotations: controlled' the grains give the skew "
                 "stress and the couple "
                 "stresses themselves; leave Gc out, or set 'rotations: free'"},
        BadInput{"PlasticLengthTwice", "G: 40 MPa, Gc: 10 MPa, lc: 10 mm", "rotations: controlled, lp: 10 mm",
                 "case.yaml:7: material 'sand': lp: with 'rotations: controlled' the grains give the skew "
                 "stress and the couple "
                 "stresses themselves; leave lp out, or set 'rotations: free'"},
        BadInput{"PlasticLengthBelowNothing", "lc: 10 mm", "lc: 10 mm, lp: -1 mm",
                 "case.yaml:7: material 'sand': lp: must be greater than zero, found '-1 mm'"},
        BadInput{
            "LimitOfCouplesTwice", "model: cell",
            "model: informed, lp: 10 mm, informed: {invariants: [0.25, 0.25, 0.1]}",
            "case.yaml:7: material 'sand': informed: invariants: their third number limits the couple stress, and "
            "so does lp; leave one of the two out"},
        BadInput{"UnknownRegion", "  all: sand", "  all: sand\n  core: sand",
                 "case.yaml:11: regions: the mesh has no region 'core'; it has all"},
        BadInput{
            "UnknownMaterial", "  all: sand", "  all: snad",
            "case.yaml:7: material 'sand': no region is made of it; remove it or name it below 'regions'\n"
            "case.yaml:10: regions: all: there is no material 'snad'; did you mean 'sand'?"},
        BadInput{
            "UnusedMaterial", "", "",
            "case.yaml:8: material 'plate': no region is made of it; remove it or name it below 'regions'"},
        BadInput{
            "UnknownBoundary", "on: top, move", "on: topp, move",
            "case.yaml:14: boundary item 3: on: the mesh has no boundary or node set 'topp'; did you mean "
            "'top'?"},
        BadInput{
            "PressureOnANode", "[left, right], pressure", "[left, top_left], pressure",
            "case.yaml:15: boundary item 4: on: a pressure needs a boundary, 'top_left' is a set of nodes; "
            "boundaries are bottom, left, right, top"},
        BadInput{
            "UnknownDof", "fix: [u1]", "fix: [u3]",
            "case.yaml:13: boundary item 2: fix: expected one of u1, u2, w, found 'u3'; did you mean 'u1'?"},
        BadInput{
            "BoundaryThatDoesNothing", "on: top, move: {u2: -4 mm}", "on: top",
            "case.yaml:14: boundary item 3: has no support and no load; give fix, move, accelerate, pressure, traction, "
            "node_force, tie or quiet, and with water drained, pore_pressure, water_level, free_water or flux"},
        BadInput{
            "TieToNothing", "on: top, move: {u2: -4 mm}", "on: left, tie: rihgt",
            "case.yaml:14: boundary item 3: tie: the mesh has no boundary or node set 'rihgt'; it has bottom, left, "
            "right, top, all, bottom_left, bottom_right, top_left, top_right"},
        BadInput{
            "TieOfOneSideThatIsHeld", "on: top, move: {u2: -4 mm}", "on: left, tie: right",
            "case.yaml:12: boundary: u1 is given at the node (0, 0), and not alike at the node it is tied to "
            "('left' to 'right'): give it on both sides or on neither"},
        BadInput{"FreeTranslation", "  - {on: bottom_left, fix: [u1]}", "  #",
                 "case.yaml:12: boundary: nothing holds the body against a rigid motion (translation along "
                 "1); fix or move a displacement that stops it"},
        BadInput{
            "UnknownValueInFormula", "-top_force /", "-top_forse /",
            "case.yaml:21: monitor 'stress_ratio': there is no value 'top_forse' before it; did you mean "
            "'top_force'?"},
        BadInput{"BrokenFormula", "100 kPa)", "100 kPa",
                 "case.yaml:21: monitor 'stress_ratio': expected ')' at character 30 of '-top_force / (0.4 m "
                 "* 100 kPa'"},
        BadInput{
            "MonitorOfNothing", "reaction: u2", "strain: u2",
            "case.yaml:20: monitor 'top_force': expected either 'reaction' or 'displacement', each one "
            "of u1, u2, w, or a formula\n"
            "case.yaml:20: monitor 'top_force': unknown key 'strain'; known keys are interface, beam, anchor, at, water, on, reaction, "
            "displacement"},
        BadInput{
            "UnknownTableColumn", "table: [stress_ratio]", "table: [stress_ration]",
            "case.yaml:24: output: table: there is no monitor 'stress_ration'; did you mean 'stress_ratio'?"},
        BadInput{
            "NoYaml", "steps:", "steps: [",
            "case.yaml:18: this is no YAML: end of sequence flow not found; the '[' in line 16 is not closed"},
        BadInput{"SettingWithoutValue", "", "",
                 "--set steps.count: expected key=value, for example --set steps.count=10",
                 "--set steps.count"},
        BadInput{"SettingOfAWrongType", "", "",
                 "--set steps.count=many: steps: count: expected a whole number of at least 1, found 'many'",
                 "--set steps.count=many"},
        BadInput{"SettingOfAnUnknownKey", "", "",
                 "--set steps.cuont=3: steps: unknown key 'cuont'; did you mean 'count'?",
                 "--set steps.cuont=3"},
        BadInput{
            "SettingOfAnItemThatIsNotThere", "", "",
            "--set boundary.9.fix=u1: there is no '9' in 'boundary'; items of a list are numbered from 0",
            "--set boundary.9.fix=u1"}),
    [](const auto& info) { return info.param.name; });

TEST_F(BadInputTest, AllFaultsAtOnceInTheOrderOfTheFile) {
  const Scratch scratch("AllFaults");
  std::string text = good_case();
  for (const auto& [good, bad] :
       std::vector<std::pair<std::string, std::string>>{{"count: 4", "count: none"},
                                                        {"0.8 m]", "0.8 s]"},
                                                        {"on: bottom,", "on: botom,"},
                                                        {"fake.in", "no.in"}}) {
    text.replace(text.find(good), good.size(), bad);
  }
  fill(scratch.path(), text);
  const Outcome outcome = run_in(scratch.path(), FAKE_POLARGRAIN " check case.yaml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(
      outcome.errors,
      "case.yaml:3: mesh.rectangle: size: expected a length in m, or with one of the units m, mm, cm, um, "
      "km, found '0.8 s'\n"
      "case.yaml:7: material 'sand': script: there is no file 'no.in', neither beside the case nor below "
      "liggghts_inputs/; correct the path or put the file there\n"
      "case.yaml:17: steps: count: expected a whole number of at least 1, found 'none'\n");
}

TEST_F(BadInputTest, ABrokenPackingIsReportedByItsOwnLine) {
  const Scratch scratch("BrokenPacking");
  fill(scratch.path(), good_case());
  write(scratch.path() / "grains.csv", kPacking + "2,0.01,0.01,-0.04,1.0,8e-4\n");
  const Outcome outcome = run_in(scratch.path(), FAKE_POLARGRAIN " check case.yaml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.errors.substr(0, 13), "grains.csv:4:") << outcome.errors;
}

TEST_F(BadInputTest, AMissingCaseIsReported) {
  const Scratch scratch("MissingCase");
  const Outcome outcome = run_in(scratch.path(), FAKE_POLARGRAIN " run nothing.yaml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.errors,
            "nothing.yaml: there is no such file; give the path of a case file (case.yaml)\n");
  EXPECT_TRUE(names_in(scratch.path()).empty());
}

TEST_F(BadInputTest, ADirectoryOfTheUsersOwnIsNotTouched) {
  const Scratch scratch("OwnDirectory");
  fill(scratch.path(), good_case());
  std::filesystem::create_directories(scratch.path() / "out");
  write(scratch.path() / "out" / "thesis.txt", "all of it");
  const Outcome outcome = run_in(scratch.path(), FAKE_POLARGRAIN " run case.yaml -o out");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.errors,
            "out: exists and holds no former result; give an empty or new directory with -o DIR, so that no "
            "file of yours is mixed with results\n");
  EXPECT_EQ(names_in(scratch.path() / "out"), std::vector<std::string>{"thesis.txt"});
}

TEST_F(BadInputTest, AnUnknownOptionIsReported) {
  const Scratch scratch("UnknownOption");
  EXPECT_EQ(run_in(scratch.path(), FAKE_POLARGRAIN " run case.yaml --fast").status, 2);
  EXPECT_EQ(run_in(scratch.path(), FAKE_POLARGRAIN).status, 2);
  EXPECT_EQ(run_in(scratch.path(), FAKE_POLARGRAIN " --help").status, 0);
}

}  // namespace
}  // namespace polargrain::testing
