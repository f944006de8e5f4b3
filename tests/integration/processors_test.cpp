// SPDX-License-Identifier: GPL-2.0-or-later
// Results have the same bits on every x86-64 processor, with any number of workers. Other processors are
// played by the switches of the system's libraries: OpenBLAS takes the kernels of a named core, the C library
// leaves its versions of the elementary functions with fused multiply-add aside.
#include <gtest/gtest.h>

#include <map>

#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;
const std::string kWithoutFusing = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4";

const std::map<std::string, std::string> kProcessors = {
    {"Haswell", "OPENBLAS_CORETYPE=Haswell"},
    {"Zen", "OPENBLAS_CORETYPE=Zen"},
    {"Nehalem", "OPENBLAS_CORETYPE=Nehalem"},
    {"Prescott", "OPENBLAS_CORETYPE=Prescott " + kWithoutFusing},
};

/// A plastic block between rough plates: UMFPACK's fronts are wide enough for products of matrices.
std::string plastic_case() {
  return "title: Plastic block\n"
         "deformation: large\n"
         "mesh: {rectangle: {size: [0.04 m, 0.08 m], elements: [12, 24]}}\n"
         "materials:\n"
         "  sand: {model: elastoplastic, E: 40 MPa, nu: 0.3, Gc: 10 MPa, lc: 1 mm, friction_angle: [30 deg, "
         "38 deg],\n"
         "         dilatancy_angle: 5 deg, cohesion: 1 kPa, confining: 100 kPa}\n"
         "regions: {all: sand}\n"
         "boundary:\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "  - {on: top, fix: [u1], move: {u2: -2 mm}}\n"
         "  - {on: [left, right], pressure: 100 kPa}\n"
         "steps: {count: 5, tolerance: 1e-8}\n"
         "monitors: {top_force: {on: top, reaction: u2}}\n";
}

/// Two elements of grains between rough plates.
std::string cell_case() {
  return "title: Two elements of grains\n"
         "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}}\n"
         "materials:\n"
         "  sand: {model: cell, script: cells/hooke_rolling.in, packing: packing400.csv, G: 37 MPa, Gc: 33 "
         "MPa, lc: 20 mm}\n"
         "regions: {all: sand}\n"
         "boundary:\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "  - {on: top, fix: [u1], move: {u2: -2.4 mm}}\n"
         "  - {on: [left, right], pressure: 100 kPa}\n"
         "steps: {count: 3, tolerance: 5e-3}\n"
         "monitors: {top_force: {on: top, reaction: u2}}\n";
}

class ProcessorsTest : public ::testing::Test {
 protected:
  ProcessorsTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::copy(kSource / "cases/biaxial/packing400.csv", scratch_.path());
  }

  /// history.csv of the case on a processor.
  [[nodiscard]] std::string history(const std::string& environment, int workers) const {
    const Outcome outcome = run_in(scratch_.path(), "env " + environment +
                                                        " " POLARGRAIN
                                                        " run case.yaml --quiet -o result "
                                                        "-w " +
                                                        std::to_string(workers));
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.errors;
    const std::string text = content(scratch_.path() / "result/history.csv");
    std::filesystem::remove_all(scratch_.path() / "result");
    return text;
  }

  void expect_same_bits(const std::string& text, int workers) const {
    write(scratch_.path() / "case.yaml", text);
    const std::string here = history("", workers);
    ASSERT_FALSE(here.empty());
    for (const auto& [name, environment] : kProcessors)
      EXPECT_EQ(history(environment, workers > 0 ? 1 : 0), here) << name;
  }

  Scratch scratch_;
};

TEST_F(ProcessorsTest, other_versions_of_the_elementary_functions_have_other_bits) {
  const std::string here = run_in(scratch_.path(), PROCESSOR_PROBE).out;
  const std::string other = run_in(scratch_.path(), "env " + kWithoutFusing + " " PROCESSOR_PROBE).out;
  ASSERT_FALSE(here.empty());
  if (here == other)
    GTEST_SKIP() << "this processor or C library has one version only: the tests show less here";
}

TEST_F(ProcessorsTest, finite_elements_have_the_same_bits) {
  expect_same_bits(plastic_case(), 0);
}

TEST_F(ProcessorsTest, cells_have_the_same_bits) {
  expect_same_bits(cell_case(), 2);
}

/// Three machines in one run: each worker believes to run on another processor. Who takes which cell is chance.
TEST_F(ProcessorsTest, workers_of_three_kinds_agree_on_every_bit) {
  write(scratch_.path() / "case.yaml", cell_case());
  const std::string here = history("", 2);
  ASSERT_EQ(run_in(scratch_.path(), POLARGRAIN " keys keys").status, 0);
  std::string guests;
  for (const char* kind : {"Haswell", "Nehalem", "Prescott"})
    guests += "env " + kProcessors.at(kind) +
              " " POLARGRAIN " worker --patience 20 --key keys/worker.key --connect $url & ";
  const Outcome outcome = run_in(
      scratch_.path(), "{ " POLARGRAIN
                       " run case.yaml --quiet -o result -w 0 --keys keys --set workers.check=1 "
                       "--listen 'tcp://127.0.0.1:*' & run=$!; " +
                           await_url("result") + guests + "wait $run; status=$?; wait; exit $status; }");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(content(scratch_.path() / "result/history.csv"), here);
  const std::string summary = content(scratch_.path() / "result/summary.json");
  // Every evaluation was made by two of them, with the same bits; each says what it runs on.
  EXPECT_EQ(summary.find("\"evaluations_checked\": 0,"), std::string::npos);
  const std::size_t workers = summary.find("\"workers\": {");
  ASSERT_NE(workers, std::string::npos);
  for (const char* guest : {"guest 1", "guest 2"}) {
    const std::size_t at = summary.find(guest, workers);
    ASSERT_NE(at, std::string::npos) << guest;
    const std::size_t kind = summary.find("\"processor\": \"", at);
    ASSERT_NE(kind, std::string::npos);
    EXPECT_NE(summary[kind + 14], '"') << summary.substr(at, 200);
  }
}

}  // namespace
}  // namespace polargrain::testing
