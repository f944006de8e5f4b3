// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>

#include "fem/element/hourglass.hpp"
#include "fem/mesh/mesh.hpp"
#include "fem/solver/contribution.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

template <int dim>
class Solver;

/// Springs against the hourglass patterns of elements with one integration point (hourglass.hpp), of displacements and of
/// micro-rotations. Their energy is a square of nodal values counted from the mesh as it was made, so that rigid turns of any
/// size leave it alone, and no state is needed. Their stiffness is a share of the tangent that the element has first.
template <int dim>
class Stabilisation final : public Contribution<dim> {
 public:
  /// Of the bending stiffness of an elastic element: plastic flow is hardly held back, and no pattern grows.
  static constexpr double kShare = 0.1;

  /// @return nothing where no element has one point alone. @param mesh must outlive this object
  static std::shared_ptr<Stabilisation> of(const Mesh<dim>& mesh, Continuum continuum, double share = kShare);

  [[nodiscard]] std::string name() const override { return "elements with one integration point"; }
  [[nodiscard]] std::size_t elements() const override { return elements_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t element) const override {
    return elements_[element].entries;
  }
  void allocate() override;
  void learn(const Discretisation<dim>& discretisation, std::span<const Response<dim>> committed) override;
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t element) const override;
  /// Where springs hold a noticeable part of the deformation, with their small share of its stiffness, as where few elements bend:
  /// the message for the user, empty elsewhere. @param solver of a problem that these springs are in
  [[nodiscard]] std::string doubt(const Solver<dim>& solver) const;
  void commit() override { energy_ = trial_energy_; }
  void revert() override {}
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  [[nodiscard]] bool takes_explicit_steps() const override { return true; }
  [[nodiscard]] double stored_energy() const override { return energy_; }

 private:
  struct OfElement {
    int number;
    std::vector<int> entries;
    HourglassModes hourglass;
    double displacement_modulus = 0.0;  ///< Pa, 0 until it is learned
    double rotation_modulus = 0.0;      ///< N
  };
  Stabilisation(const Mesh<dim>& mesh, Continuum continuum, double share);
  /// Stiffness of each mode against an unknown of a node. @param component of node_dofs
  [[nodiscard]] Eigen::VectorXd stiffness(const OfElement& element, int component) const;

  Continuum continuum_;
  double share_;
  std::vector<OfElement> elements_;
  double energy_ = 0.0;        ///< J, committed
  double trial_energy_ = 0.0;  ///< of the last evaluation
};

/// Stabilisation::doubt of the springs of a problem; empty without springs.
template <int dim>
std::string doubt_of_one_point_elements(const Solver<dim>& solver);

}  // namespace polargrain::fem
