// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/solver/contribution.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// The contributions of a problem as one.
template <int dim>
class Contributions {
 public:
  /// Allocates their states. @param problem must outlive this object
  explicit Contributions(const Problem<dim>& problem) : all_(problem.contributions) {
    for (const auto& contribution : all_) contribution->allocate();
  }

  void learn(const Discretisation<dim>& discretisation, std::span<const Response<dim>> committed);
  /// See Contribution.
  void set_stage(int stage, const std::vector<char>& there) {
    for (const auto& contribution : all_) contribution->set_stage(stage, there);
  }
  void begin_stage(const StageBegin<dim>& now) {
    for (const auto& contribution : all_) contribution->begin_stage(now);
  }
  void begin_at_rest(const StageBegin<dim>& now) {
    for (const auto& contribution : all_) contribution->begin_at_rest(now);
  }
  [[nodiscard]] bool is_empty() const { return all_.empty(); }
  void prepare(const NodalStep& step);
  /// Overwrites the forces. @returns why one of them cannot, with its name; empty when all can
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces);
  /// The tangent of the last evaluation times nodal values.
  [[nodiscard]] Eigen::VectorXd linearised_forces(const Eigen::VectorXd& nodal) const;
  /// The sum of Contribution::work_from_outside.
  [[nodiscard]] double work_from_outside() const;
  /// The least of Contribution::longest_step.
  [[nodiscard]] double longest_step() const;
  void commit();
  void revert();
  /// Each under a number of its own.
  void save(ArchiveWriter& archive) const;
  void restore(ArchiveReader& archive);
  /// The first whose forces depend on the duration of a step; empty: no contribution depends on it.
  [[nodiscard]] std::string depends_on_duration() const;

 private:
  const std::vector<std::shared_ptr<Contribution<dim>>>& all_;
};

}  // namespace polargrain::fem
