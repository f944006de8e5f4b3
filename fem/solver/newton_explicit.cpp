// SPDX-License-Identifier: GPL-2.0-or-later
// A step that goes where it is told: the explicit steps of Solver.
#include <Eigen/Cholesky>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/error.hpp"
#include "fem/mesh/box_around.hpp"
#include "fem/solver/newton.hpp"
#include "fem/solver/stopwatch.hpp"

namespace polargrain::fem {

template <int dim>
double Newton<dim>::force_of_path() const {
  Eigen::VectorXd forces =
      discretisation.linearised_forces(linearised(state.responses), constraints.largest()).cwiseAbs();
  if (withheld_.size() > 0) forces += withheld_.cwiseAbs();
  double sum = loads.largest_moment() / reference_length;
  for (Eigen::Index entry = 0; entry < constraints.places().mechanics(); ++entry)
    sum += forces(entry) / (is_rotation(dof_at<dim>(entry)) ? reference_length : 1.0);
  return sum;
}

template <int dim>
bool Newton<dim>::fields_follow_answers() const {
  return !std::ranges::all_of(problem.contributions, [](const auto& one) { return one->fields_store(); });
}

template <int dim>
std::string Newton<dim>::carry_fields(Iterate& iterate) {
  const int mechanical = constraints.mechanical_unknowns();
  const int unknowns = constraints.field_unknowns();
  if (unknowns == 0) return {};
  if (fields_follow_answers()) {
    const auto evaluate = [&](const Eigen::VectorXd& increment) {
      return contribute(iterate.time, increment);
    };
    return field_balance_.balance(problem, constraints, evaluate, contributed_, iterate.displacement);
  }
  if (std::string why = contribute(iterate.time, iterate.displacement); !why.empty()) return why;
  const Eigen::VectorXd rows =
      constraints.restrict_to_free(contributed_.internal).segment(mechanical, unknowns);
  const Eigen::SparseMatrix<double> storage = matrix_of_fields(problem, constraints);
  // Steps are short, so storage rules over flow and few iterations reach rounding.
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(storage);
  solver.setTolerance(1e-13);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(constraints.unknowns());
  change.segment(mechanical, unknowns) = solver.solve(rows);
  if (solver.info() != Eigen::Success || !change.allFinite())
    return "the fields beside the displacements cannot be carried on: they store nothing somewhere";
  constraints.add_free(change, iterate.displacement);
  return {};
}

template <int dim>
std::vector<Eigen::MatrixXd> Newton<dim>::stiffness_of_fields() {
  if (problem.fields.empty()) return {};
  std::map<std::vector<int>, std::size_t> element_with;  // sorted entries of its displacements
  const auto displacements = [](std::vector<int> entries) {
    std::erase_if(entries, [](int entry) { return is_rotation(dof_at<dim>(entry)); });
    std::ranges::sort(entries);
    return entries;
  };
  for (std::size_t e = 0; e < discretisation.elements(); ++e)
    element_with[displacements(discretisation.element_dofs(e))] = e;
  contributions.learn(discretisation, state.responses);
  if (std::string why = contribute(state.time, Eigen::VectorXd::Zero(state.displacement.size()));
      !why.empty())
    throw RunError(why);
  std::vector<Eigen::MatrixXd> all(discretisation.elements());
  for (const auto& contribution : problem.contributions) {
    if (!contribution->fields_store()) continue;
    for (std::size_t k = 0; k < contribution->elements(); ++k) {
      const std::vector<int>& own = contribution->entries(k);
      const PartsOfElement parts = parts_of_element(own, constraints.places().mechanics());
      if (parts.fields.empty() || !contribution->is_active(k)) continue;
      std::vector<int> moved;
      for (const Eigen::Index i : parts.mechanics) moved.push_back(own[static_cast<std::size_t>(i)]);
      const auto found = element_with.find(displacements(moved));
      if (found == element_with.end()) continue;
      const Eigen::MatrixXd tangent = contribution->tangent(k);
      const Eigen::LLT<Eigen::MatrixXd> storage(-tangent(parts.fields, parts.fields));
      if (storage.info() != Eigen::Success)
        throw RunError(contribution->name() +
                       " stores nothing: explicit steps need water that yields, give its 'bulk_modulus'");
      const Eigen::MatrixXd condensed =
          tangent(parts.mechanics, parts.mechanics) +
          tangent(parts.mechanics, parts.fields) * storage.solve(tangent(parts.fields, parts.mechanics));
      const std::vector<int>& dofs = discretisation.element_dofs(found->second);
      std::vector<Eigen::Index> places;
      for (const int entry : moved) places.push_back(std::ranges::find(dofs, entry) - dofs.begin());
      Eigen::MatrixXd& sum = all[found->second];
      if (sum.size() == 0)
        sum.setZero(static_cast<Eigen::Index>(dofs.size()), static_cast<Eigen::Index>(dofs.size()));
      sum(places, places) += condensed;
    }
  }
  contributions.revert();
  return all;
}

template <int dim>
Attempt Newton<dim>::go_on(double time, double released, const Eigen::VectorXd& moved, StepReport& report) {
  move_to_committed();
  internal_before_ = committed_internal_forces();
  loads_before_ = loads_at(state.time, released_, jump_let_go_);
  Iterate iterate = start_of({.time = time, .measure = {}, .released = released});
  constraints.add_free(moved, iterate.displacement);
  if (allowed_share(Eigen::VectorXd::Zero(iterate.displacement.size()), iterate.displacement) < 1.0)
    return {
        false,
        "a point would be strained by more than `largest_strain` in one explicit step: the nodes move too fast"};
  if (!contributions.is_empty()) contributions.learn(discretisation, state.responses);
  const auto failure = [&]() -> std::optional<Attempt> {
    const Response<dim>& worst = worst_response();
    if (worst.quality != Quality::failed) return {};
    return Attempt{false, (refusal_.empty() ? "a material failed: " : "") + worst.message, worst.step_factor};
  };
  const long evaluations = report.evaluations;
  if (fields_follow_answers()) {
    ask_materials(iterate, report);
    if (!refusal_.empty()) return {false, refusal_, 0.5};
    if (const auto failed = failure()) return *failed;
  }
  {
    const Stopwatch watch(report.solve_seconds);
    if (const std::string why = carry_fields(iterate); !why.empty()) return {false, why, 0.5};
  }
  double of_path = 0.0;
  if (state.reference_force == 0.0) {
    move_to_committed();
    of_path = force_of_path();
  }
  evaluate(iterate, report);
  report.evaluations = evaluations + static_cast<long>(trial_.size());
  ++report.iterations;
  if (const auto failed = failure()) return *failed;
  const auto is_finite = [&] { return std::isfinite(iterate.residual.force + iterate.residual.moment); };
  if (!is_finite() && state.reference_force == 0.0) {  // the reference was zero
    state.reference_force = of_path;
    iterate.residual = relative(iterate.unbalanced);
  }
  if (!is_finite()) return {false, "the forces are not finite"};
  commit(iterate, Balance::within_tolerance, report);
  return {true, ""};
}

template <int dim>
Eigen::VectorXd Newton<dim>::unbalanced() const {
  return loads_at(state.time, released_, jump_let_go_) - committed_internal_forces();
}

template <int dim>
Eigen::VectorXd Newton<dim>::last_supplied() const {
  Eigen::VectorXd forces = -unbalanced_;
  if (released_ < 1.0) forces -= (1.0 - released_) * withheld_;
  return forces;
}

template <int dim>
int Newton<dim>::steps_of_wave() const {
  double mass = 0.0;
  int entries = 0;
  for (std::size_t node = 0; node < problem.mesh.nodes.size(); ++node) {
    for (std::size_t i = 0; i < dim; ++i) {
      const std::size_t entry = entry_of<dim>(node) + i;
      if (!constraints.is_free(entry)) continue;
      mass += state.mass(constraints.equation(entry));
      ++entries;
    }
  }
  double modulus = 0.0;
  for (std::size_t i = 0; i < discretisation.points(); ++i) {
    modulus += discretisation.point(i).volume * state.responses[i].tangent(0, 0);
  }
  if (entries == 0 || !(modulus > 0.0)) return 0;
  // The nodes that are held have mass too.
  const double all = mass * static_cast<double>(problem.mesh.nodes.size()) / entries;
  const double speed = std::sqrt(modulus / all);  // of modulus / volume over mass / volume
  return static_cast<int>(std::ceil(2.0 * box_around(problem.mesh).sides().maxCoeff() / speed));
}

template <int dim>
double Newton<dim>::stable_share() {
  constexpr double kReserve = 1.25;  // 0.6 of the critical step come to 0.75
  if (problem.deformation == Deformation::small) return 1.0;
  (void)start_.move_to(Eigen::VectorXd::Zero(state.displacement.size()));
  const std::vector<double> before = swings_of_shapes(start_);
  move_to_committed();
  const std::vector<double> now = swings_of_shapes(discretisation);
  double faster = 1.0;
  for (std::size_t e = 0; e < now.size(); ++e)
    if (before[e] > 0.0) faster = std::max(faster, std::sqrt(now[e] / before[e]));
  return faster > kReserve ? 1.0 / faster : 1.0;
}

template <int dim>
Eigen::VectorXd Newton<dim>::stable_masses(double safety) {
  move_to_committed();
  return nodal_masses(discretisation, linearised(state.responses), safety, stiffness_of_fields());
}

template <int dim>
std::vector<double> Newton<dim>::densities() const {
  std::vector<double> all(discretisation.elements(), 0.0);
  for (const auto& [region, elements] : problem.mesh.regions) {
    const auto density = problem.densities.find(region);
    if (density == problem.densities.end()) continue;
    for (const int element : elements) all[static_cast<std::size_t>(element)] = density->second;
  }
  for (const double density : all)
    if (!(density > 0.0)) throw RunError("steps in real time need the density of each region");
  return all;
}

template <int dim>
TrueMasses Newton<dim>::real_masses(const std::vector<Response<dim>>& answers, double safety) {
  move_to_committed();
  return true_masses(discretisation, linearised(answers), densities(), safety, stiffness_of_fields());
}

template std::vector<double> Newton<2>::densities() const;
template TrueMasses Newton<2>::real_masses(const std::vector<Response<2>>&, double);
template std::vector<double> Newton<3>::densities() const;
template TrueMasses Newton<3>::real_masses(const std::vector<Response<3>>&, double);
template Attempt Newton<2>::go_on(double, double, const Eigen::VectorXd&, StepReport&);
template Eigen::VectorXd Newton<2>::unbalanced() const;
template double Newton<2>::stable_share();
template double Newton<3>::stable_share();
template Eigen::VectorXd Newton<2>::stable_masses(double);
template Eigen::VectorXd Newton<2>::last_supplied() const;
template int Newton<2>::steps_of_wave() const;
template Attempt Newton<3>::go_on(double, double, const Eigen::VectorXd&, StepReport&);
template Eigen::VectorXd Newton<3>::unbalanced() const;
template Eigen::VectorXd Newton<3>::stable_masses(double);
template Eigen::VectorXd Newton<3>::last_supplied() const;
template int Newton<3>::steps_of_wave() const;

}  // namespace polargrain::fem
