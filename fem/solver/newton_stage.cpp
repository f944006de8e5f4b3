// SPDX-License-Identifier: GPL-2.0-or-later
// Stages of construction (docs/theory/solver.md, stages): parts that come and go between two steps.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/error.hpp"
#include "common/packed_values.hpp"
#include "fem/solver/free_rotations.hpp"
#include "fem/solver/newton.hpp"

namespace polargrain::fem {

template <int dim>
void Newton<dim>::enter_stage() {
  const std::vector<char> there = elements_in_stage(problem, state.stage);
  discretisation.set_there(there);
  start_.set_there(there);
  contributions.set_stage(state.stage, there);
  constraints = Constraints<dim>(problem, state.stage, state.offsets);
  loads = Loads<dim>(problem, state.stage);
  tangent_.renew();
  linear_solver_.change_pattern(coarse_space<dim>(problem.mesh, constraints));
}

template <int dim>
void Newton<dim>::begin_stage(int stage) {
  const std::vector<char> there_before = elements_in_stage(problem, state.stage);
  left_behind_ = constraints.folded(unbalanced());
  for (std::size_t entry = 0; entry < static_cast<std::size_t>(left_behind_.size()); ++entry)
    if (!constraints.is_free(entry)) left_behind_(static_cast<Eigen::Index>(entry)) = 0.0;
  state.offsets = Constraints<dim>::new_offsets(problem, state, stage);
  begin_contributions(stage, false);
  state.stage = stage;
  enter_stage();
  note_placed(there_before);
  if (problem.deformation == Deformation::large) {
    if (const std::string inverted = discretisation.move_to(state.displacement); !inverted.empty())
      throw RunError(fmt::format("stage '{}': {} by what has moved before it came",
                                 problem.stages.at(static_cast<std::size_t>(stage)), inverted));
    move_to_committed();
  }
  if (problem.continuum == Continuum::cosserat) {
    if (const std::string message =
            unresisted_rotation<dim>(problem.mesh, discretisation, constraints, state.responses);
        !message.empty())
      throw RunError(message);
  }
  // A reference that only knows the stages before may be far too small for what comes now.
  if (options.reference_force == 0.0)
    state.reference_force = std::max(state.reference_force, loads.largest_force());
  state.next_step = 0.0;
  if (const std::string message = contribute_at_rest(state.responses); !message.empty())
    throw RunError(
        fmt::format("stage '{}': {}", problem.stages.at(static_cast<std::size_t>(stage)), message));
  withhold_imbalance();
}

template <int dim>
double Newton<dim>::forces_to_change() const {
  for (const PrescribedDof<dim>* given : in_precedence(problem, state.stage))
    if (given->value.largest_change(state.time) > 0.0) return 0.0;
  double sum = loads.largest_change(state.time);
  for (Eigen::Index entry = 0; entry < std::min(withheld_.size(), constraints.places().mechanics()); ++entry)
    if (constraints.is_free(static_cast<std::size_t>(entry)) && !is_rotation(dof_at<dim>(entry)))
      sum += (1.0 - released_) *
             std::abs(withheld_(entry) - (left_behind_.size() > 0 ? left_behind_(entry) : 0.0));
  return sum;
}

template <int dim>
void Newton<dim>::note_placed(const std::vector<char>& there_before) {
  if (there_before.empty() || problem.deformation == Deformation::large) return;
  const std::vector<Increment<dim>> moved = discretisation.increments(state.displacement);
  for (std::size_t point = 0; point < moved.size(); ++point) {
    const auto element = static_cast<std::size_t>(discretisation.element_of_point(point));
    if (there_before[element] != 0 || !discretisation.is_there(element)) continue;
    state.placed_with.resize(moved.size(), Cosserat<dim>::Gradient::Zero());
    state.placed_with[point] = moved[point].displacement_gradient;
  }
}

template <int dim>
Attempt Newton<dim>::begin_at_rest() {
  begin_contributions(state.stage, true);
  const std::string message = contribute_at_rest(state.responses);
  return {message.empty(), message.empty() ? "" : "the initial state is not usable: " + message};
}

template <int dim>
std::string Newton<dim>::contribute_at_rest(std::span<const Response<dim>> responses) {
  if (contributions.is_empty()) return {};
  contributions.learn(discretisation, responses);
  if (std::string message = contribute(state.time, Eigen::VectorXd::Zero(state.displacement.size()));
      !message.empty())
    return message;
  contributions.commit();
  state.contributed = contributed_.internal;
  return {};
}

template <int dim>
void Newton<dim>::begin_contributions(int stage, bool at_rest) {
  if (contributions.is_empty()) return;
  const Eigen::VectorXd unbalanced = loads.at(state.time) - committed_internal_forces();
  std::vector<char> given(static_cast<std::size_t>(unbalanced.size()), 0);
  for (std::size_t entry = 0; entry < given.size(); ++entry)
    given[entry] = constraints.is_free(entry) ? 0 : 1;
  const std::vector<char> there = elements_in_stage(problem, stage);
  const StageBegin<dim> now{stage, there,          state.displacement, unbalanced,
                            given, discretisation, state.responses};
  at_rest ? contributions.begin_at_rest(now) : contributions.begin_stage(now);
}

template <int dim>
void Newton<dim>::save_stage(ArchiveWriter& archive) const {
  const std::array<double, 2> scalars{static_cast<double>(state.stage), released_};
  archive.write("stage_released", std::span<const double>(scalars));
  const auto write = [&](const char* name, const Eigen::VectorXd& values) {
    archive.write(name, std::span<const double>(values.data(), static_cast<std::size_t>(values.size())));
  };
  write("stage_offsets", state.offsets);
  write("stage_shown_from", state.shown_from);
  write("stage_withheld", withheld_);
  std::vector<double> placed;
  for (const typename Cosserat<dim>::Gradient& h : state.placed_with)
    placed.insert(placed.end(), h.data(), h.data() + h.size());
  archive.write("stage_placed_with", std::span<const double>(placed));
}

template <int dim>
void Newton<dim>::restore_stage(ArchiveReader& archive) {
  const std::vector<double> scalars = read_lists(archive, "stage_released", 1, 2);
  const auto read = [&](const char* name) {
    const std::vector<double> values = archive.doubles(name);
    if (!values.empty() && static_cast<Eigen::Index>(values.size()) != discretisation.nodal_size())
      throw RunError("the checkpoint holds a stage of another mesh");
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  state.stage = static_cast<int>(scalars[0]);
  released_ = scalars[1];
  state.offsets = read("stage_offsets");
  state.shown_from = read("stage_shown_from");
  withheld_ = read("stage_withheld");
  const std::vector<double> placed = archive.doubles("stage_placed_with");
  constexpr std::size_t kSize = dim * dim;
  if (!placed.empty() && placed.size() != kSize * discretisation.points())
    throw RunError("the checkpoint holds regions placed on another mesh");
  state.placed_with.clear();
  for (std::size_t at = 0; at < placed.size(); at += kSize)
    state.placed_with.emplace_back(Eigen::Map<const typename Cosserat<dim>::Gradient>(&placed[at]));
  if (!problem.stages.empty() || state.offsets.size() > 0) enter_stage();
}

template <int dim>
void Newton<dim>::count_supports_from_here() {
  Eigen::VectorXd given = state.displacement;
  constraints.apply(state.time, given);
  state.offsets = state.displacement - given;
  const FieldPlaces<dim>& places = constraints.places();
  Eigen::VectorXd kept = Eigen::VectorXd::Zero(state.offsets.size());
  kept.head(places.mechanics())
      .setOnes();  // fields take their values at once, unless an item counts from here
  for (const PrescribedField<dim>& item : problem.prescribed_fields) {
    if (!item.from_here) continue;
    for (const int node : problem.mesh.nodes_on(item.on))
      if (const int entry = places.entry(number_of_field(problem.fields, item.field), node); entry >= 0)
        kept(entry) = 1.0;
  }
  state.offsets = state.offsets.cwiseProduct(kept);
  enter_stage();
}

template void Newton<2>::enter_stage();
template void Newton<2>::begin_stage(int);
template double Newton<2>::forces_to_change() const;
template Attempt Newton<2>::begin_at_rest();
template void Newton<2>::note_placed(const std::vector<char>&);
template void Newton<2>::begin_contributions(int, bool);
template std::string Newton<2>::contribute_at_rest(std::span<const Response<2>>);
template void Newton<2>::save_stage(ArchiveWriter&) const;
template void Newton<2>::restore_stage(ArchiveReader&);
template void Newton<2>::count_supports_from_here();
template void Newton<3>::enter_stage();
template void Newton<3>::begin_stage(int);
template double Newton<3>::forces_to_change() const;
template Attempt Newton<3>::begin_at_rest();
template void Newton<3>::note_placed(const std::vector<char>&);
template void Newton<3>::begin_contributions(int, bool);
template std::string Newton<3>::contribute_at_rest(std::span<const Response<3>>);
template void Newton<3>::save_stage(ArchiveWriter&) const;
template void Newton<3>::restore_stage(ArchiveReader&);
template void Newton<3>::count_supports_from_here();

}  // namespace polargrain::fem
