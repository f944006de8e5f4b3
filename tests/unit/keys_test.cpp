// SPDX-License-Identifier: GPL-2.0-or-later
// Keys that are told once: reading, faults, suggestions and the rows of the user guide come from one description.
#include <gtest/gtest.h>

#include <fstream>

#include "coupler/case/models/cell_control_keys.hpp"
#include "coupler/case/workers_keys.hpp"

namespace polargrain::coupler {
namespace {

/// A map of one key and its text, in line 7 of a case.
Entry map_of(const std::string& key, const std::string& text) {
  Entry map;
  map.kind = Entry::Kind::map;
  map.file = "case.yaml";
  Entry value;
  value.kind = Entry::Kind::scalar;
  value.text = text;
  value.file = map.file;
  value.line = 7;
  map.members.push_back({key, 7, value});
  return map;
}

/// What reading a family says of one key; empty: nothing. @param record gets the value
template <class Record>
std::string faults_of(Record& record, const std::string& key, const std::string& text) {
  const Entry map = map_of(key, text);
  Faults faults;
  Section section(map, "here", faults);
  read_keys(section, record);
  section.finish();
  return faults.empty() ? "" : fmt::format("{}: {}", faults.front().line, faults.front().message);
}

TEST(Keys, AreReadIntoTheirPlaces) {
  CellControl control;
  EXPECT_EQ(faults_of(control, "damping", "0.3"), "");
  EXPECT_EQ(control.damping, 0.3);
  EXPECT_EQ(faults_of(control, "least_steps", "400"), "");
  EXPECT_EQ(control.least_steps, 400);
  EXPECT_EQ(faults_of(control, "tangent", "voigt"), "");
  EXPECT_EQ(control.tangent, CellTangent::voigt);
  EXPECT_EQ(faults_of(control, "loop", "engine"), "");
  EXPECT_EQ(control.loop, CellLoop::engine);
  // Others keep their values.
  EXPECT_EQ(control.inertial_number, CellControl{}.inertial_number);
  EXPECT_EQ(control.unbalanced_moment_ratio, CellControl{}.unbalanced_moment_ratio);
  WorkersOfCase workers;
  EXPECT_EQ(faults_of(workers, "silence", "2 min"), "");
  EXPECT_EQ(workers.patience.silence_seconds, 120.0);
  EXPECT_EQ(faults_of(workers, "check", "100 %"), "");
  EXPECT_EQ(workers.check_share, 1.0);
}

TEST(Keys, BeyondTheirLimitsAreFaults) {
  CellControl control;
  EXPECT_EQ(faults_of(control, "damping", "1"),
            "7: here: damping: must be below 1, found '1': grains would creep to where they rest");
  EXPECT_NE(faults_of(control, "inertial_number", "0").find("inertial_number"), std::string::npos);
  EXPECT_NE(faults_of(control, "inertial_number", "0.1").find("grains would fly past each other"),
            std::string::npos);
  EXPECT_NE(faults_of(control, "least_steps", "0").find("least_steps"), std::string::npos);
  EXPECT_NE(faults_of(control, "tangent", "voight").find("did you mean 'voigt'?"), std::string::npos);
  WorkersOfCase workers;
  EXPECT_EQ(faults_of(workers, "check", "2"),
            "7: here: check: must be at most 1, found '2': it is a share of the evaluations, 100 % is all");
}

TEST(Keys, AreSuggested) {
  CellControl control;
  EXPECT_NE(faults_of(control, "dampin", "0.2").find("did you mean 'damping'?"), std::string::npos);
  WorkersOfCase workers;
  EXPECT_NE(faults_of(workers, "silense", "1 min").find("did you mean 'silence'?"), std::string::npos);
}

TEST(Keys, StandInTheUserGuide) {
  std::ifstream file(POLARGRAIN_SOURCE_DIRECTORY "/docs/user_guide.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const std::string& rows : {rows_of_keys(CellControl{}), rows_of_keys(WorkersOfCase{})})
    EXPECT_NE(page.find(rows), std::string::npos) << "docs/user_guide.md must hold these rows:\n" << rows;
}

TEST(Keys, DefaultsAreShortAndReadBack) {
  for (const auto& [value, dimension, text] :
       {std::tuple{6e-4, Dimension::number, "6e-4"}, std::tuple{0.12, Dimension::number, "0.12"},
        std::tuple{0.0, Dimension::number, "0"}, std::tuple{30.0, Dimension::duration, "30 s"},
        std::tuple{600.0, Dimension::duration, "10 min"}, std::tuple{100.0, Dimension::pressure, "100 Pa"}}) {
    EXPECT_EQ(value_text(value, dimension), text);
    EXPECT_EQ(parse_quantity(text, dimension), value);
  }
}

}  // namespace
}  // namespace polargrain::coupler
