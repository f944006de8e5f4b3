// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/safety/safety.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/csv_file.hpp"
#include "app/remarks/remarks.hpp"
#include "app/run/take_step.hpp"
#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "common/standard_streams.hpp"
#include "fem/interface/interface.hpp"
#include "fem/spread/spread_slip.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::app {
namespace {

/// Growth of the factor until the body fails.
constexpr double kGrowth = 1.25;

/// Trials of one case.
template <int dim>
class StrengthReduction {
 public:
  StrengthReduction(const coupler::Case& the_case, const SafetyOptions& options)
      : case_(the_case), options_(options) {
    check_materials();
  }

  Safety find() {
    take_steps();
    Safety safety;
    double fails = kGrowth;
    while (attempt(fails, safety)) {
      if (fails >= options_.largest) return safety;
      fails = std::min(kGrowth * fails, options_.largest);
    }
    while (safety.fails - safety.stands > options_.resolution)
      attempt(0.5 * (safety.stands + safety.fails), safety);
    return safety;
  }

 private:
  void check_materials() const {
    std::vector<Fault> faults;
    bool has_strength =
        std::ranges::any_of(case_.template problem_of<dim>().contributions, [](const auto& contribution) {
          return dynamic_cast<const fem::Interface<dim>*>(contribution.get()) != nullptr;
        });
    for (const auto& [name, recipe] : case_.materials) {
      const coupler::Weakened weak = recipe->weakened(1.0);
      has_strength = has_strength || weak.recipe != nullptr;
      if (!weak.why_not.empty())
        faults.push_back({case_.file.string(), 0, fmt::format("material '{}': {}", name, weak.why_not)});
    }
    if (case_.is_explicit())
      faults.push_back({case_.file.string(), 0,
                        "steps: method: the factor of safety is found by balanced steps; use newton"});
    if (fem::pore_water_of(case_.template problem_of<dim>()) != nullptr)
      faults.push_back(
          {case_.file.string(), 0,
           "water: the factor of safety takes no pore water yet: no water would flow while strength falls; "
           "leave out 'water'"});
    look_at_movements(faults);
    if (faults.empty() && !has_strength)
      faults.push_back({case_.file.string(), 0,
                        "no material or interface of the case has a strength that could be reduced"});
    if (!faults.empty()) throw InputError(faults);
  }

  /// A body that a movement holds where it is does not fail, whatever its strength.
  void look_at_movements(std::vector<Fault>& faults) const {
    const coupler::CaseStage* const stage = case_.stage_of(last_step());
    for (const auto& item : case_.template problem_of<dim>().prescribed) {
      if (fem::is_rotation(item.dof) || item.value.largest_magnitude() == 0.0 ||
          !item.life.holds(stage == nullptr ? 0 : stage->number))
        continue;
      faults.push_back(
          {case_.file.string(), 0,
           fmt::format(
               "boundary: '{}' is moved, and would hold the body while strength falls: no factor would be found; give a "
               "load in the place of 'move', or end it in a stage before (name: NAME; end: NAME)",
               item.on)});
      return;
    }
  }

  /// The last step before strength is reduced.
  [[nodiscard]] int last_step() const {
    if (options_.stage.empty()) return case_.steps();
    std::vector<std::string> names;
    for (const coupler::CaseStage& stage : case_.stages) {
      if (stage.name == options_.stage) return stage.last_step;
      names.push_back(stage.name);
    }
    throw InputError({case_.file.string(), 0,
                      fmt::format("--stage: there is no stage '{}'; {}", options_.stage,
                                  names.empty() ? "give the stages of the case names"
                                                : fmt::format("there are {}", fmt::join(names, ", ")))});
  }

  /// A solver with the strength of all materials divided by a factor. It shares the interfaces of the case.
  [[nodiscard]] std::unique_ptr<fem::Solver<dim>> solver_at(double factor) const {
    fem::Problem<dim> problem = case_.template problem_of<dim>();
    for (auto& [region, material] : problem.materials) {
      const coupler::MaterialRecipe& recipe = *case_.materials.at(case_.regions.at(region));
      const coupler::Weakened weak = recipe.weakened(factor);
      material = (weak.recipe ? *weak.recipe : recipe).template make_for<dim>(nullptr);
    }
    if (case_.spread > 0.0) fem::add_spread_slip<dim>(problem, {case_.spread});
    return std::make_unique<fem::Solver<dim>>(std::move(problem), case_.solver);
  }

  /// After a restart, which brings the friction of the state.
  void divide_interfaces(double factor) const {
    for (const auto& contribution : case_.template problem_of<dim>().contributions)
      if (auto* const interface = dynamic_cast<fem::Interface<dim>*>(contribution.get()))
        interface->divide_strength(factor);
  }

  fem::StepReport take(int step, fem::Solver<dim>& solver) const {
    begin_stage_of(case_, step, solver);
    return take_balanced_step(case_.plan[static_cast<std::size_t>(step) - 1], solver);
  }

  void take_steps() {
    if (!case_.start_from.empty())
      throw InputError(
          {case_.file.string(), 0,
           "start_from: the factor of safety begins with a start of its own; give initial_stress, and the "
           "stages that lead here"});
    const std::unique_ptr<fem::Solver<dim>> solver = solver_at(1.0);
    const int last = last_step();
    for (int step = 0; step <= last; ++step) {
      const fem::StepReport report = step == 0 ? solver->equilibrate() : take(step, *solver);
      if (!report.converged)
        throw RunError(
            fmt::format("the case does not stand with its own strength: step {} of {} found no balance ({})",
                        step, last, report.message));
    }
    solver->save(end_);
    displacement_ = solver->state().displacement;
  }

  bool attempt(double factor, Safety& safety) {
    const std::unique_ptr<fem::Solver<dim>> solver = solver_at(factor);
    MemoryArchive from = end_;
    solver->restore(from);
    divide_interfaces(factor);
    const fem::StepReport report = solver->redistribute();
    const Eigen::VectorXd moved = solver->state().displacement - displacement_;
    double largest = 0.0;
    for (std::size_t node = 0; node < solver->problem().mesh.nodes.size(); ++node)
      largest = std::max(
          largest, moved.template segment<dim>(fem::entry_of<dim>(static_cast<Eigen::Index>(node))).norm());
    safety.trials.push_back({factor, report.converged, largest, report.iterations, report.message});
    (report.converged ? safety.stands : safety.fails) = factor;
    return report.converged;
  }

  const coupler::Case& case_;
  const SafetyOptions& options_;
  MemoryArchive end_;
  Eigen::VectorXd displacement_;
};

void write_table(const std::filesystem::path& file, const Safety& safety) {
  CsvFile table(file, {"factor", "stands", "displacement", "iterations"});
  for (const SafetyTrial& trial : safety.trials)
    table.add({exact(trial.factor), trial.stands ? "1" : "0", exact(trial.displacement),
               std::to_string(trial.iterations)});
  table.write();
}

}  // namespace

Safety factor_of_safety(const coupler::Case& the_case, const SafetyOptions& options) {
  return the_case.dimension() == 3 ? StrengthReduction<3>(the_case, options).find()
                                   : StrengthReduction<2>(the_case, options).find();
}

int safety(const SafetyOptions& options) {
  const coupler::Case the_case = coupler::read_case(options.case_file, options.settings, options.scripts);
  // A case that says another thing than is meant has another factor.
  if (const Remarks remarks = remarks_on(the_case, options.settings, {}); !remarks.empty())
    tell(stderr, "{}", text_of(remarks, false));
  const Safety found = factor_of_safety(the_case, options);
  tell(stdout, "{}\n{:>10}  {:>7}  {:>16}  {:>10}\n", the_case.title, "factor", "stands", "displacement, m",
       "iterations");
  for (const SafetyTrial& trial : found.trials)
    tell(stdout, "{:>10.4f}  {:>7}  {:>16.4e}  {:>10}\n", trial.factor, trial.stands ? "yes" : "no",
         trial.displacement, trial.iterations);
  if (found.fails > 0.0) {
    tell(stdout, "factor of safety between {:.4f} (a balance was found) and {:.4f} (no balance was found)\n",
         found.stands, found.fails);
  } else {
    tell(stdout, "factor of safety above {:.4f}: a balance was found at the largest factor that was tried\n",
         found.stands);
  }
  if (!options.file.empty()) write_table(options.file, found);
  return 0;
}

}  // namespace polargrain::app
