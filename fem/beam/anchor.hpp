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
  double prestress = 0.0;                  ///< force at the start, N, tension positive
  double strength = HUGE_VAL;              ///< force at which it yields in tension, N
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
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t) const override;
  void commit() override;
  void revert() override;
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  [[nodiscard]] std::vector<std::pair<int, int>> joined_nodes() const override;
  [[nodiscard]] std::vector<std::string> faults(const Problem<dim>& problem) const override;

  /// N, tension positive, as committed.
  [[nodiscard]] double force() const { return committed_force_; }

 private:
  AnchorSettings<dim> settings_;
  std::vector<int> entries_;
  Eigen::VectorXd elongation_of_;  ///< elongation per value of the entries
  double length_;
  double committed_plastic_ = 0.0;  ///< elongation that yielding has left, m
  double committed_force_;
  double plastic_ = 0.0;
  double force_;
  bool yields_ = false;
};

}  // namespace polargrain::fem
