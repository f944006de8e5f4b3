// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "common/error.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/output/base64.hpp"
#include "fem/output/read_vtu.hpp"
#include "fem/output/stress_measures.hpp"
#include "fem/output/vtu.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

/// A file of this process: tests of several builds may run side by side.
std::filesystem::path own_file(const std::string& name) {
  return std::filesystem::temp_directory_path() / (std::to_string(getpid()) + '_' + name);
}

std::string base64_of(const std::string& text) {
  return base64(std::as_bytes(std::span(text)));
}

TEST(base64, agrees_with_the_examples_of_the_standard) {  // RFC 4648, section 10
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
}

/// Words of each line of what a command prints, by the first word; fails the test when the command fails.
std::map<std::string, std::vector<std::string>> run(const std::string& command) {
  std::map<std::string, std::vector<std::string>> lines;
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer{};
  while (fgets(buffer.data(), static_cast<int>(buffer.size()), pipe)) text += buffer.data();
  EXPECT_EQ(pclose(pipe), 0) << text;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    for (std::string word; words >> word;) lines[name].push_back(word);
  }
  return lines;
}

/// A law with a field to show: the number of the component it is asked for is irrelevant, the value is fixed.
struct ShowingLaw : ElasticLaw<2> {
  using ElasticLaw<2>::ElasticLaw;
  static std::vector<std::string> field_names() { return {"void_ratio"}; }
  void fields(const State&, std::span<double> values) const { values[0] = 0.62; }
};

class Output : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("fem_output_test_" + GetParam() + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_P(Output, is_read_back_by_vtk) {
  Problem<2> problem;
  problem.mesh = rectangle({{2.0, 1.0}, {3, 2}}, GetParam());
  problem.materials["all"] = std::make_shared<LocalMaterial<ShowingLaw>>(
      ShowingLaw(ElasticParameters<2>{100.0, 0.25, 20.0, 0.1, Vector7::Zero()}));
  // Homogeneous: u1 = 0.01 x, u2 = 0, w = 0.
  problem.prescribed = {
      {"all", Dof::u1, TimeTable::ramp(0.01), [](const Eigen::Vector2d& x) { return x(0); }},
      {"all", Dof::u2, TimeTable::constant(0.0), {}}};
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const std::filesystem::path file = folder_ / "fields_0001.vtu";
  write_vtu(file, solver.problem().mesh, collect_fields(solver));

  const FieldFile<2> again = read_vtu(file);
  EXPECT_EQ(again.mesh.nodes, solver.problem().mesh.nodes);
  ASSERT_EQ(again.mesh.elements.size(), solver.problem().mesh.elements.size());
  for (std::size_t e = 0; e < again.mesh.elements.size(); ++e) {
    EXPECT_EQ(again.mesh.elements[e].type, solver.problem().mesh.elements[e].type);
    EXPECT_EQ(again.mesh.elements[e].nodes, solver.problem().mesh.elements[e].nodes);
  }
  ASSERT_NE(find_field(again.fields.cells, "stress"), nullptr);
  for (const Field& field : collect_fields(solver).cells)
    EXPECT_EQ(find_field(again.fields.cells, field.name)->values, field.values) << field.name;
  EXPECT_EQ(find_field(again.fields.cells, "stress")->unit, "Pa");

  auto lines =
      run("/usr/bin/python3 " POLARGRAIN_SOURCE_DIRECTORY "/tests/unit/fem_output_read.py " + file.string());
  const Mesh<2>& mesh = solver.problem().mesh;
  EXPECT_EQ(lines["grid"],
            (std::vector<std::string>{std::to_string(mesh.nodes.size()), std::to_string(mesh.elements.size()),
                                      std::to_string(mesh.elements[0].type->vtk_cell_type), "0.0", "2.0",
                                      "0.0", "1.0"}));
  const auto number = [&](const std::string& name, std::size_t i) { return std::stod(lines.at(name).at(i)); };
  EXPECT_EQ(lines["displacement"][1], "3");
  double sum = 0.0;
  for (const Eigen::Vector2d& node : mesh.nodes) sum += 0.01 * node(0);
  EXPECT_NEAR(number("displacement", 2), sum, 1e-14);
  // eps11 = 0.01, lambda = G = 40: s11 = 1.2, s22 = s33 = 0.4.
  const double cells = static_cast<double>(mesh.elements.size());
  EXPECT_EQ(lines["stress"][1], "5");
  EXPECT_NEAR(number("stress", 2), 2.0 * cells, 1e-12 * cells);
  EXPECT_NEAR(number("stress", 3), 1.2, 1e-12);
  EXPECT_NEAR(number("couple_stress", 2), 0.0, 1e-12);
  EXPECT_NEAR(number("strain", 2), 0.01 * cells, 1e-14 * cells);
  EXPECT_NEAR(number("deviatoric_strain", 3), 0.01 * 2.0 / 3.0, 1e-14);
  EXPECT_NEAR(number("void_ratio", 4), 0.62, 1e-15);
  EXPECT_EQ(lines["curvature"][0], std::to_string(mesh.elements.size()));
  EXPECT_EQ(lines["micro_rotation"][0], std::to_string(mesh.nodes.size()));
}

// The displacement u1 = -c x^2 / 2 of all nodes gives stresses that are linear in space: s11 = -120 c x and s22 = s33 = -40 c x
// (lambda = G = 40), so p = 200/3 c x, q = 80 c x, q / p = 1.2, and sin of the mobilised angle is (120 - 40) / (120 + 40).
TEST(fields, engineers_read_are_exact_at_points_and_at_nodes) {
  constexpr double c = 0.01;
  Problem<2> problem;
  problem.mesh = rectangle({{2.0, 1.0}, {3, 2}}, "Q8R");
  problem.materials["all"] = std::make_shared<LocalMaterial<ShowingLaw>>(
      ShowingLaw(ElasticParameters<2>{100.0, 0.25, 20.0, 0.1, Vector7::Zero()}));
  problem.prescribed = {
      {"all", Dof::u1, TimeTable::ramp(-0.5 * c), [](const Eigen::Vector2d& x) { return x(0) * x(0); }},
      {"all", Dof::u2, TimeTable::constant(0.0), {}},
      {"all", Dof::w, TimeTable::ramp(0.02), {}}};
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const std::vector<Eigen::Vector2d>& nodes = solver.problem().mesh.nodes;
  const Fields fields = collect_fields(solver);
  const PlacedFields points = collect_point_fields(solver);
  ASSERT_EQ(points.places.size(), solver.points());
  const auto check = [&](const std::vector<Field>& of, const std::vector<Eigen::Vector2d>& places) {
    const auto value = [&](const char* name, std::size_t entity, std::size_t component) {
      const Field* const field = find_field(of, name);
      EXPECT_NE(field, nullptr) << name;
      return field->values.at(entity * static_cast<std::size_t>(field->components) + component);
    };
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double x = c * places[k](0);
      // The stiffness is of order 100, strains of 0.02: rounding is some 1e-15.
      EXPECT_NEAR(value("stress", k, 0), -120.0 * x, 1e-13);
      EXPECT_NEAR(value("p", k, 0), 200.0 / 3.0 * x, 1e-13);
      EXPECT_NEAR(value("q", k, 0), 80.0 * x, 1e-13);
      EXPECT_NEAR(value("principal_stress", k, 0), -120.0 * x, 1e-13);
      EXPECT_NEAR(value("principal_stress", k, 1), -40.0 * x, 1e-13);
      EXPECT_NEAR(value("principal_stress", k, 2), -40.0 * x, 1e-13);
      EXPECT_NEAR(value("volume_strain", k, 0), -x, 1e-15);
      EXPECT_NEAR(value("micro_rotation_vector", k, 2), 0.02, 1e-15);
      EXPECT_NEAR(value("relative_rotation", k, 2), 0.02, 1e-14);  // the continuum does not rotate
      EXPECT_EQ(value("relative_rotation", k, 0), 0.0);
      EXPECT_NEAR(value("void_ratio", k, 0), 0.62, 1e-14);
      if (places[k](0) == 0.0) continue;  // no stress, no ratio
      EXPECT_NEAR(value("stress_ratio", k, 0), 1.2, 1e-11);
      EXPECT_NEAR(value("mobilised_friction_angle", k, 0), 30.0, 1e-9);
      EXPECT_NEAR(value("principal_direction_1", k, 0), 1.0, 1e-12);
      EXPECT_NEAR(value("principal_direction_2", k, 1), 1.0, 1e-12);
    }
  };
  check(fields.points, nodes);
  std::vector<Eigen::Vector2d> at_points;
  for (const Eigen::Vector3d& place : points.places) at_points.emplace_back(place.head<2>());
  check(points.fields, at_points);
  double area = 0.0;
  for (const double part : find_field(points.fields, "volume")->values) area += part;
  EXPECT_NEAR(area, 2.0, 1e-14);

  // VTK finds names of components and units in both files.
  const auto file = own_file("fem_output_places.vtu");
  write_vtu(file, points);
  auto lines =
      run("/usr/bin/python3 " POLARGRAIN_SOURCE_DIRECTORY "/tests/unit/fem_output_read.py " + file.string());
  EXPECT_EQ(lines["grid"][2], "1");  // VTK_VERTEX
  EXPECT_EQ(std::stoul(lines["grid"][0]), solver.points());
  EXPECT_EQ(lines["about:stress"], (std::vector<std::string>{"Pa", "11", "22", "33", "12", "21"}));
  EXPECT_EQ(lines["about:principal_stress"], (std::vector<std::string>{"Pa", "1", "2", "33"}));
  EXPECT_EQ(lines["about:displacement"], (std::vector<std::string>{"m", "1", "2", "3"}));
  EXPECT_EQ(lines["about:mobilised_friction_angle"][0], "degree");
  write_vtu(file, solver.problem().mesh, fields);
  lines =
      run("/usr/bin/python3 " POLARGRAIN_SOURCE_DIRECTORY "/tests/unit/fem_output_read.py " + file.string());
  EXPECT_EQ(lines["about:curvature"], (std::vector<std::string>{"rad/m", "1", "2"}));
  EXPECT_EQ(lines["about:p"][0], "Pa");
  std::filesystem::remove(file);
}

// s11 = -300, s22 = -100, s33 = -150, s12 = 80, s21 = 20: the circle has its centre at -200 and the radius sqrt(100^2 + 50^2).
TEST(stress_measures, are_those_of_the_circle_by_hand) {
  Vector7 stress;
  stress << -300.0, -100.0, -150.0, 80.0, 20.0, 7.0, -3.0;
  const StressMeasures found = measures_of(stress);
  const double radius = std::sqrt(12500.0);
  EXPECT_NEAR(found.pressure, 550.0 / 3.0, 1e-12);
  EXPECT_NEAR(found.deviatoric,
              std::sqrt(0.5 * (200.0 * 200.0 + 50.0 * 50.0 + 150.0 * 150.0) + 3.0 * 50.0 * 50.0), 1e-12);
  EXPECT_NEAR(found.ratio, found.deviatoric / found.pressure, 1e-15);
  EXPECT_NEAR(found.principal(0), -200.0 - radius, 1e-12);
  EXPECT_NEAR(found.principal(1), -200.0 + radius, 1e-12);
  EXPECT_EQ(found.principal(2), -150.0);
  Eigen::Matrix2d matrix;
  matrix << -300.0, 50.0, 50.0, -100.0;
  EXPECT_LT((matrix * found.first_direction - found.principal(0) * found.first_direction).norm(), 1e-11);
  EXPECT_LT((matrix * found.second_direction - found.principal(1) * found.second_direction).norm(), 1e-11);
  EXPECT_GT(found.first_direction(0), 0.0);
  EXPECT_NEAR(found.mobilised_friction, std::asin(radius / 200.0) * 180.0 / M_PI, 1e-12);
  // No compression: no ratio, no angle. Directions of equal stresses are those of the axes.
  stress << 10.0, 10.0, 10.0, 0.0, 0.0, 0.0, 0.0;
  EXPECT_EQ(measures_of(stress).ratio, 0.0);
  EXPECT_EQ(measures_of(stress).mobilised_friction, 0.0);
  EXPECT_EQ(measures_of(stress).first_direction, Eigen::Vector2d::UnitX());
}

INSTANTIATE_TEST_SUITE_P(Elements, Output, ::testing::Values("Q8R", "Q4", "T6"));

TEST(pvd, lists_its_files) {
  const auto file = own_file("fem_output_test.pvd");
  PvdCollection collection(file);
  collection.add(0.0, "fields_0000.vtu");
  collection.add(0.5, "fields_0001.vtu");
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_NE(text.find("<DataSet timestep=\"0.5\" file=\"fields_0001.vtu\"/>"), std::string::npos) << text;
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  std::filesystem::remove(file);
}

TEST(read_vtu, refuses_what_does_not_fit_together) {
  const auto file = own_file("fem_output_refused.vtu");
  const Mesh<2> mesh = rectangle({{1.0, 1.0}, {1, 1}});
  write_vtu(file, mesh, {{{"displacement", 3, std::vector<double>(3 * mesh.nodes.size(), 0.0)}}, {}});
  std::ifstream stream(file);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  const auto fault = [&](const std::string& found, const std::string& instead) {
    std::string text = whole;
    text.replace(text.find(found), found.size(), instead);
    std::ofstream(file) << text;
    try {
      (void)read_vtu(file);
    } catch (const InputError& error) {
      return error.faults().front().message.substr(error.faults().front().message.find(": ") + 2);
    }
    return std::string("none");
  };
  EXPECT_EQ(fault("UnstructuredGrid", "UnstructuredGrid"), "none");
  EXPECT_EQ(fault("<UnstructuredGrid>", "<Grid>"), "Start-end tags mismatch");
  EXPECT_EQ(fault("Name=\"types\"", "Name=\"kinds\""), "there is no array 'types'");
  EXPECT_EQ(fault("Components=\"3\"", "Components=\"2\""),
            "the array 'displacement' has not a value for each of 8 entities");
  EXPECT_EQ(
      fault("Name=\"types\" NumberOfComponents=\"1\" format=\"binary\">\nA", "Name=\"types\" x=\"\">\nB"),
      "the array 'types' is cut or of another kind");
  std::filesystem::remove(file);
}

TEST(write_vtu, says_when_it_cannot_write) {
  EXPECT_THROW(write_vtu("/nowhere/fields.vtu", rectangle({{1, 1}, {1, 1}}), {}), RunError);
}

}  // namespace
