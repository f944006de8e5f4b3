// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/interface/interface.hpp"
#include "fem/mesh/mesh.hpp"
#include "fem/solver/contribution.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// A face that water may stand at, while nothing else does.
template <int dim>
struct BareFace {
  const ElementType<dim - 1>* type;
  std::vector<int> nodes;  ///< that are pushed
  /// Of the normal of the face (interface_points) as its nodes go: 1 where it points into the water, -1 out of it.
  double into_water;
  int element = -1;                                    ///< must be there, unless -1
  int opposite = -1;                                   ///< must have gone, unless -1
  std::shared_ptr<const Contribution<dim>> wall = {};  ///< whose stages it has; null: all
};

/// The sides of ground along a boundary, also those that come when the ground beside them goes.
template <int dim>
std::vector<BareFace<dim>> bare_sides_of_ground(const Mesh<dim>& mesh, const std::string& boundary);
/// The faces of the wall behind an interface: towards its ground, once that has gone; and the other side where no ground was.
/// @param is_one_sided whether the wall has ground at this interface alone along a face
template <int dim>
std::vector<BareFace<dim>> bare_sides_of_wall(
    const std::shared_ptr<const Interface<dim>>& interface,
    const std::function<bool(const InterfaceFace<dim>&)>& is_one_sided);

/// Free water at rest: a river, a harbour, a pit that is full. It presses on bare faces with its weight over their depth, and not above
/// its level. The pressure in the pores of the ground there is a PrescribedField or an OpenSide. Small deformation.
template <int dim>
class FreeWater final : public StatelessContribution<dim> {
 public:
  /// @param level height of the water along the last axis, m @param unit_weight N/m^3
  FreeWater(const Mesh<dim>& mesh, std::string on, TimeTable level, double unit_weight,
            std::vector<BareFace<dim>> faces);

  [[nodiscard]] std::string name() const override { return "the water at '" + on_ + "'"; }
  [[nodiscard]] const std::string& on() const { return on_; }  ///< boundary or wall
  [[nodiscard]] const TimeTable& level() const { return level_; }
  [[nodiscard]] std::size_t elements() const override { return faces_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t e) const override { return faces_[e].entries; }
  [[nodiscard]] bool takes_stages() const override { return true; }
  [[nodiscard]] bool is_there(std::size_t e, int stage, const std::vector<char>& there) const override;
  void set_stage(int stage, const std::vector<char>& there) override;
  [[nodiscard]] bool is_active(std::size_t e) const override { return faces_[e].active; }
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t e) const override;
  void commit() override { committed_level_ = evaluated_level_; }
  [[nodiscard]] double work_from_outside() const override { return work_; }
  bool add_forces_on_face(const std::vector<int>& nodes, Eigen::VectorXd& forces) const override;
  [[nodiscard]] std::vector<std::string> faults(const Problem<dim>& problem) const override;
  [[nodiscard]] std::vector<std::string> faults_of_stage(const Problem<dim>& problem,
                                                         int stage) const override;

 private:
  struct Face {
    BareFace<dim> bare;
    VectorRows<dim> positions;
    std::vector<int> entries;  ///< displacements of the nodes
    bool active = true;
  };
  /// Forces of the water on the displacements of a face. @param level m
  [[nodiscard]] Eigen::VectorXd forces_on(const Face& face, double level) const;

  std::string on_;
  TimeTable level_;
  double unit_weight_;
  std::vector<Face> faces_;
  double evaluated_level_ = -HUGE_VAL;
  double committed_level_ = -HUGE_VAL;
  double work_ = 0.0;  ///< over the step evaluated last, trapezoidal
};

}  // namespace polargrain::fem
