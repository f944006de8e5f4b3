// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/contributions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/prefixed_archive.hpp"

namespace polargrain::fem {
namespace {

std::string prefix_of(std::size_t number) {
  return fmt::format("{}/", number);
}

}  // namespace

template <int dim>
void Contributions<dim>::learn(const Discretisation<dim>& discretisation,
                               std::span<const Response<dim>> committed) {
  for (const auto& contribution : all_) contribution->learn(discretisation, committed);
}

template <int dim>
void Contributions<dim>::prepare(const NodalStep& step) {
  for (const auto& contribution : all_) contribution->prepare(step);
}

template <int dim>
std::string Contributions<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  forces.internal = Eigen::VectorXd::Zero(step.start.size());
  forces.parts = forces.internal;
  for (const auto& contribution : all_) {
    if (const std::string message = contribution->evaluate(step, forces); !message.empty())
      return contribution->name() + ": " + message;
  }
  return {};
}

template <int dim>
Eigen::VectorXd Contributions<dim>::linearised_forces(const Eigen::VectorXd& nodal) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal.size());
  for (const auto& contribution : all_) {
    for (std::size_t e = 0; e < contribution->elements(); ++e) {
      if (!contribution->is_active(e)) continue;
      const std::vector<int>& entries = contribution->entries(e);
      const Eigen::VectorXd values = nodal(entries);
      if (!values.isZero(0.0)) forces(entries) += contribution->tangent(e) * values;
    }
  }
  return forces;
}

template <int dim>
double Contributions<dim>::work_from_outside() const {
  double sum = 0.0;
  for (const auto& contribution : all_) sum += contribution->work_from_outside();
  return sum;
}

template <int dim>
double Contributions<dim>::longest_step() const {
  double longest = HUGE_VAL;
  for (const auto& contribution : all_) longest = std::min(longest, contribution->longest_step());
  return longest;
}

template <int dim>
void Contributions<dim>::commit() {
  for (const auto& contribution : all_) contribution->commit();
}

template <int dim>
void Contributions<dim>::revert() {
  for (const auto& contribution : all_) contribution->revert();
}

template <int dim>
void Contributions<dim>::save(ArchiveWriter& archive) const {
  for (std::size_t k = 0; k < all_.size(); ++k) {
    PrefixedWriter own(archive, prefix_of(k));
    const std::string name = all_[k]->name();
    own.write("name", std::span<const std::int64_t>(std::vector<std::int64_t>(name.begin(), name.end())));
    all_[k]->save(own);
  }
}

template <int dim>
void Contributions<dim>::restore(ArchiveReader& archive) {
  for (std::size_t k = 0; k < all_.size(); ++k) {
    PrefixedReader own(archive, prefix_of(k));
    all_[k]->restore(own);
  }
}

template <int dim>
std::string Contributions<dim>::depends_on_duration() const {
  for (const auto& contribution : all_)
    if (contribution->depends_on_duration()) return contribution->name();
  return {};
}

template class Contributions<2>;
template class Contributions<3>;

}  // namespace polargrain::fem
