// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Runs a case of laws in the process of the test.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/run/take_step.hpp"
#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/structure_values.hpp"
#include "coupler/case/water_values.hpp"

namespace polargrain::testing {

inline coupler::Case case_of(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("case_of_laws." + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << text;
  coupler::Case the_case = coupler::read_case(file);
  std::filesystem::remove(file);
  return the_case;
}

/// Its faults, with their lines; empty: it has none.
inline std::string faults_of(const std::string& text) {
  try {
    (void)case_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// The values of the monitors after each step, step 0 first.
class RunOfLaws {
 public:
  /// @param interrupted the step behind which another solver goes on from what the first has saved
  explicit RunOfLaws(const std::string& text, int interrupted = -1)
      : text_(text), case_(case_of(text)), interrupted_(interrupted) {
    case_.space ? run<3>() : run<2>();
  }

  [[nodiscard]] std::size_t steps() const { return rows_.size() - 1; }
  [[nodiscard]] double value(const std::string& name, std::size_t step) const {
    return rows_.at(step).at(name);
  }
  [[nodiscard]] double last(const std::string& name) const { return value(name, steps()); }
  [[nodiscard]] const coupler::Case& the_case() const { return case_; }

 private:
  template <int dim>
  std::unique_ptr<fem::Solver<dim>> solver() {
    case_ = case_of(text_);  // contributions work for one solver alone
    fem::Problem<dim> problem = case_.problem_of<dim>();
    for (auto& [region, material] : problem.materials)
      material = case_.materials.at(case_.regions.at(region))->template make_for<dim>(nullptr);
    return std::make_unique<fem::Solver<dim>>(std::move(problem), case_.solver);
  }
  template <int dim>
  void run() {
    auto solver = this->solver<dim>();
    keep(solver->equilibrate(), *solver);
    for (int step = 1; step <= case_.steps(); ++step) {
      if (step == interrupted_ + 1) {
        MemoryArchive saved;
        solver->save(saved);
        solver = this->solver<dim>();
        solver->restore(saved);
      }
      app::begin_stage_of(case_, step, *solver);
      keep(app::take_balanced_step(case_.plan[static_cast<std::size_t>(step) - 1], *solver), *solver);
      if (HasFatalFailure()) return;
    }
  }
  template <int dim>
  void keep(const fem::StepReport& report, const fem::Solver<dim>& solver) {
    ASSERT_TRUE(report.converged) << report.message;
    std::map<std::string, double>& row = rows_.emplace_back();
    row["external_work"] = solver.state().external_work;
    row["internal_work"] = solver.state().internal_work;
    for (const coupler::Monitor& monitor : case_.monitors) {
      const auto dof = fem::place_of<dim>(monitor.dof);
      if (monitor.kind == coupler::Monitor::Kind::water)
        row[monitor.name] = coupler::value_of_water(solver, monitor.on, monitor.value);
      if (monitor.kind == coupler::Monitor::Kind::structure)
        row[monitor.name] = coupler::value_of_structure(solver.problem(), monitor.structure, monitor.value);
      if (monitor.kind == coupler::Monitor::Kind::displacement)
        row[monitor.name] = solver.mean_displacement(monitor.on)[dof];
      if (monitor.kind == coupler::Monitor::Kind::reaction)
        row[monitor.name] = solver.reaction(monitor.on)[dof];
    }
  }
  static bool HasFatalFailure() { return ::testing::Test::HasFatalFailure(); }

  std::string text_;
  coupler::Case case_;
  int interrupted_;
  std::vector<std::map<std::string, double>> rows_;
};

}  // namespace polargrain::testing
