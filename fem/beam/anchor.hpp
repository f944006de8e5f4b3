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
  /// N, tension positive: the force at which the stage that places it ends. Of an anchor that is there from the start: the force
  /// before the balance at the start, in which it gives way with the ground.
  double prestress = 0.0;
  double strength = HUGE_VAL;  ///< force at which it yields in tension, N
  /// The same in compression, positive. 0: a rope, which goes slack and keeps its length.
  double compressive_strength = HUGE_VAL;
};

/// N = EA (elongation / length) + prestress, with perfect yielding at both strengths. Small deformation. The length that yielding
/// leaves stays; a slack rope has no such length, and is taut again where it went slack.
///
/// With a prestress it is a jack during the stage that places it: a pair of constant forces, which the stage lets go like all that
/// it changes. A rod would lose force as the ground gives way. When the next stage begins (begin_stage, set_stage) it is locked: a rod
/// of the length that it has then. No body hangs on a jack alone, since faults of a problem count no anchor as a support. Where
/// the ground does not resist its force, the stage finds no balance.
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
  void set_stage(int stage, const std::vector<char>& there) override;
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
  [[nodiscard]] double stiffness() const { return settings_.axial_stiffness / length_; }  ///< N/m

  AnchorSettings<dim> settings_;
  std::vector<int> entries_;
  Eigen::VectorXd elongation_of_;  ///< elongation per value of the entries
  double length_;
  /// Elongation at which it has its prestress, m: that yielding has left, or that was there when it came or was locked.
  double committed_plastic_ = 0.0;
  double committed_force_;
  double plastic_ = 0.0;
  double force_;
  bool resists_ = true;  ///< its force follows its elongation: no jack, neither yielding nor slack
  bool active_ = true;   ///< in the stage
  bool jacks_ = false;   ///< in the stage
};

}  // namespace polargrain::fem
