// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/beam/anchor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/error.hpp"
#include "fem/element/dofs.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

namespace {

/// Share that the tangent keeps where the force is constant, so that no mechanism makes it singular.
constexpr double kStiffnessOfConstantForce = 1e-6;

}  // namespace

template <int dim>
Anchor<dim>::Anchor(const Mesh<dim>& mesh, const AnchorSettings<dim>& settings)
    : settings_(settings), committed_force_(settings.prestress), force_(settings.prestress) {
  using Place = typename Cosserat<dim>::Place;
  const Place start = mesh.nodes[static_cast<std::size_t>(settings.from)];
  const Place end = settings.to ? mesh.nodes[static_cast<std::size_t>(*settings.to)] : settings.fixed;
  length_ = (end - start).norm();
  if (!(length_ > 0.0)) throw RunError(fmt::format("{} has no length: its ends are one place", name()));
  const Place direction = (end - start) / length_;
  for (int i = 0; i < dim; ++i) entries_.push_back(entry_of<dim>(settings.from, static_cast<Dof>(i)));
  elongation_of_ = -direction;
  if (!settings.to) return;
  for (int i = 0; i < dim; ++i) entries_.push_back(entry_of<dim>(*settings.to, static_cast<Dof>(i)));
  elongation_of_.conservativeResize(2 * dim);
  elongation_of_.template tail<dim>() = direction;
}

template <int dim>
void Anchor<dim>::allocate() {
  committed_plastic_ = 0.0;
  committed_force_ = settings_.prestress;
  revert();
}

template <int dim>
void Anchor<dim>::set_stage(int stage, const std::vector<char>&) {
  active_ = this->life.holds(stage);
  const bool is_placed = stage > 0 && stage == this->life.begin;
  jacks_ = is_placed && settings_.prestress != 0.0;
}

template <int dim>
void Anchor<dim>::begin_stage(const StageBegin<dim>& now) {
  const bool before = active_;
  set_stage(now.stage, now.there);
  if (before == active_) return;
  allocate();
  if (!active_) return;
  committed_plastic_ = elongation_of_.dot(now.nodal(entries_));
  revert();
}

template <int dim>
std::string Anchor<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  if (!active_) return {};
  const double elongation = elongation_of_.dot(step.end(entries_));
  const double trial = settings_.prestress + stiffness() * (elongation - committed_plastic_);
  force_ =
      std::clamp(jacks_ ? settings_.prestress : trial, -settings_.compressive_strength, settings_.strength);
  resists_ = !jacks_ && force_ == trial;
  // The length of a jack follows the ground as that of a yielding rod does, so that it is locked without a change of force.
  const bool is_slack = !jacks_ && settings_.compressive_strength == 0.0 && trial < 0.0;
  plastic_ = committed_plastic_ + (is_slack ? 0.0 : (trial - force_) / stiffness());
  const Eigen::VectorXd own = force_ * elongation_of_;
  forces.internal(entries_) += own;
  forces.parts(entries_) += own.cwiseAbs();
  return {};
}

template <int dim>
Eigen::MatrixXd Anchor<dim>::tangent(std::size_t) const {
  const double slope = (resists_ ? 1.0 : kStiffnessOfConstantForce) * stiffness();
  return slope * elongation_of_ * elongation_of_.transpose();
}

template <int dim>
void Anchor<dim>::commit() {
  if (!active_) return;
  committed_plastic_ = plastic_;
  committed_force_ = force_;
}

template <int dim>
void Anchor<dim>::revert() {
  plastic_ = committed_plastic_;
  force_ = committed_force_;
}

template <int dim>
void Anchor<dim>::save(ArchiveWriter& archive) const {
  const std::array values{committed_plastic_, committed_force_};
  archive.write("anchor", std::span<const double>(values));
}

template <int dim>
void Anchor<dim>::restore(ArchiveReader& archive) {
  const std::vector<double> values = archive.doubles("anchor");
  if (values.size() != 2) throw RunError(fmt::format("{}: the checkpoint is of something else", name()));
  committed_plastic_ = values[0];
  committed_force_ = values[1];
  revert();
}

template <int dim>
std::vector<std::pair<int, int>> Anchor<dim>::joined_nodes() const {
  return {};  // it holds them in one direction alone
}

template <int dim>
std::vector<std::string> Anchor<dim>::faults(const Problem<dim>& problem) const {
  if (problem.deformation == Deformation::large)
    return {"anchors are of small deformation; set 'deformation: small'"};
  return {};
}

// Its ends need something to hold on to: an element, a beam or a rigid body.
template <int dim>
std::vector<std::string> Anchor<dim>::faults_of_stage(const Problem<dim>& problem, int stage) const {
  const std::vector<char> of_mesh = nodes_of_elements(problem.mesh, {});
  const std::vector<char> left = nodes_of_elements(problem.mesh, elements_in_stage(problem, stage));
  for (const int node : {settings_.from, settings_.to.value_or(settings_.from)}) {
    const auto number = static_cast<std::size_t>(node);
    if (of_mesh[number] == 0 || left[number] != 0) continue;
    return {fmt::format(
        "{} ends at {}, where the ground is not there; 'remove' the anchor too, or 'place' it behind "
        "that ground",
        name(), place_text<dim>(problem.mesh.nodes[number]))};
  }
  return {};
}

template class Anchor<2>;
template class Anchor<3>;

}  // namespace polargrain::fem
