// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

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
#include "fem/output/vtu.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

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
struct ShowingLaw : ElasticLaw {
  using ElasticLaw::ElasticLaw;
  static std::vector<std::string> field_names() { return {"void_ratio"}; }
  void fields(const State&, std::span<double> values) const { values[0] = 0.62; }
};

class Output : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("fem_output_test_" + GetParam());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_P(Output, is_read_back_by_vtk) {
  Problem problem;
  problem.mesh = rectangle({{2.0, 1.0}, {3, 2}}, GetParam());
  problem.materials["all"] = std::make_shared<LocalMaterial<ShowingLaw>>(
      ShowingLaw(ElasticParameters{100.0, 0.25, 20.0, 0.1, Vector7::Zero()}));
  // Homogeneous: u1 = 0.01 x, u2 = 0, w = 0.
  problem.prescribed = {
      {"all", Dof::u1, TimeTable::ramp(0.01), [](const Eigen::Vector2d& x) { return x(0); }},
      {"all", Dof::u2, TimeTable::constant(0.0), {}}};
  Solver solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const std::filesystem::path file = folder_ / "fields_0001.vtu";
  write_vtu(file, solver.problem().mesh, collect_fields(solver));

  const FieldFile again = read_vtu(file);
  EXPECT_EQ(again.mesh.nodes, solver.problem().mesh.nodes);
  ASSERT_EQ(again.mesh.elements.size(), solver.problem().mesh.elements.size());
  for (std::size_t e = 0; e < again.mesh.elements.size(); ++e)
    EXPECT_EQ(again.mesh.elements[e].nodes, solver.problem().mesh.elements[e].nodes);
  ASSERT_NE(find_field(again.fields.cells, "stress"), nullptr);
  for (const Field& field : collect_fields(solver).cells)
    EXPECT_EQ(find_field(again.fields.cells, field.name)->values, field.values) << field.name;

  auto lines = run("/usr/bin/python3 " VTK_READER " " + file.string());
  const Mesh& mesh = solver.problem().mesh;
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

INSTANTIATE_TEST_SUITE_P(Elements, Output, testing::Values("Q8R", "Q4", "T6"));

TEST(pvd, lists_its_files) {
  const auto file = std::filesystem::temp_directory_path() / "fem_output_test.pvd";
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
  const auto file = std::filesystem::temp_directory_path() / "fem_output_refused.vtu";
  const Mesh mesh = rectangle({{1.0, 1.0}, {1, 1}});
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
