// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "fem/mesh/mesh.hpp"
#include "fem/solver/contribution.hpp"

namespace polargrain::fem {

/// A tie rod, strut or spring: a straight bar between two nodes, or from a node to a fixed place. In the plane stiffness and
/// forces are per m of thickness.
template <int dim>
struct AnchorSettings {
  std::string name;
  int from;                                                            ///< node
  std::optional<int> to = {};                                          ///< node
  typename Cosserat<dim>::Place fixed = Cosserat<dim>::Place::Zero();  ///< its other end without `to`, m
  double axial_stiffness;                                              ///< EA, N, positive
  double prestress = 0.0;      ///< force at the start, or when a stage places it, N, tension positive
  double strength = HUGE_VAL;  ///< force at which it yields in tension, N
  double compressive_strength = HUGE_VAL;  ///< the same in compression, positive; 0: a rope
};

/// N = EA (elongation / length) + prestress, with perfect yielding at both strengths. Small deformation.
template <int dim>
class Anchor : public Contribution<dim> {
 public:
  Anchor(const Mesh<dim>& mesh, const AnchorSettings<dim>& settings);

  [[nodiscard]] std::string name() const override { return "the anchor '" + settings_.name + "'"; }
  [[nodiscard]] const std::string& short_name() const { return settings_.name; }
  [[nodiscard]] std::size_t elements() const override { return 1; }
  [[nodiscard]] const std::vector<int>& entries(std::size_t) const override { return entries_; }
  void allocate() override;
  [[nodiscard]] bool takes_stages() const override { return true; }
  void set_stage(int stage, const std::vector<char>&) override { active_ = this->life.holds(stage); }
  void begin_stage(const StageBegin<dim>& now) override;
  [[nodiscard]] bool is_active(std::size_t) const override { return active_; }
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t) const override;
  void commit() override;
  void revert() override;
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  [[nodiscard]] std::vector<std::pair<int, int>> joined_nodes() const override;
  [[nodiscard]] std::vector<std::string> faults(const Problem<dim>& problem) const override;
  [[nodiscard]] std::vector<std::string> faults_of_stage(const Problem<dim>& problem,
                                                         int stage) const override;

  /// N, tension positive, as committed.
  [[nodiscard]] double force() const { return active_ ? committed_force_ : 0.0; }

 private:
  AnchorSettings<dim> settings_;
  std::vector<int> entries_;
  Eigen::VectorXd elongation_of_;  ///< elongation per value of the entries
  double length_;
  double committed_plastic_ = 0.0;  ///< elongation that yielding has left, or that was there when it came, m
  double committed_force_;
  double plastic_ = 0.0;
  double force_;
  bool yields_ = false;
  bool active_ = true;  ///< in the stage
};

}  // namespace polargrain::fem
