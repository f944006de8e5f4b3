// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
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
/// size leave it alone. In large deformation in space micro-rotations of the steps add up in the axes of the material. Their stiffness is a share of the tangent that the element has first, times the secant of its point:
/// the largest stress so far over that of the first tangent for the largest strain. A reversal of the strain leaves it. Elastic springs would carry ever more load
/// where grains flow (docs/theory/solver.md, elements with one point).
template <int dim>
class Stabilisation final : public Contribution<dim> {
 public:
  /// Of the bending stiffness of an elastic element, and of a flowing one by its secant.
  static constexpr double kShare = 0.1;

  /// @return nothing where no element has one point alone. @param mesh must outlive this object
  static std::shared_ptr<Stabilisation> of(const Mesh<dim>& mesh, Continuum continuum,
                                           Deformation deformation, double share = kShare);

  static constexpr const char* kName = "elements with one integration point";
  [[nodiscard]] std::string name() const override { return kName; }
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
  void commit() override;
  void revert() override {}
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  [[nodiscard]] bool takes_explicit_steps() const override { return true; }

 private:
  /// Displacements, and micro-rotations.
  struct Pair {
    double displacement = 0.0;
    double rotation = 0.0;
  };
  using CurvatureTensor = Eigen::Matrix<double, Cosserat<dim>::rotations, dim>;
  using RotationPatterns = Eigen::Matrix<double, Cosserat<dim>::rotations, Eigen::Dynamic>;
  /// From the mesh as it was made.
  struct Moved {
    typename Cosserat<dim>::Gradient gradient = Cosserat<dim>::Gradient::Zero();  ///< mean d u_i / d x_j
    /// Mean d w_i / d x_j, 1/m; with i in the axes of the material where micro-rotations turn with it.
    CurvatureTensor curvature = CurvatureTensor::Zero();
    /// Of micro-rotations that turn with the material, in its axes, a column a mode; empty elsewhere.
    RotationPatterns patterns = RotationPatterns(Cosserat<dim>::rotations, 0);
    Pair energy;  ///< of patterns held by springs with a secant of 1, J
  };
  struct OfElement {
    int number;
    std::vector<int> entries;
    HourglassModes hourglass;
    VectorRows<dim> gradient;    ///< mean of those of the shape functions, 1/m
    double shear_modulus = 0.0;  ///< of the first tangent, Pa
    /// The same against curvature: d w_k / d x_k on the diagonal, transposed, and as it is; N.
    std::array<double, 3> couple_moduli{};
    Pair modulus;  ///< share of the first tangent: Pa, 0 until it is learned, and N
    Pair
        largest_stress;  ///< of the point, change since the first: norm of its deviator, Pa, and of couples, N/m
    Pair largest_elastic_stress;  ///< the same by the first tangent
    Pair secant{1.0, 1.0};        ///< one over the other; at most 1
    typename Cosserat<dim>::Vector first_stress = Cosserat<dim>::Vector::Zero();
    Moved committed, trial;
  };
  Stabilisation(const Mesh<dim>& mesh, Continuum continuum, Deformation deformation, double share);
  /// Whether micro-rotations are vectors that turn with the material.
  [[nodiscard]] bool turns() const { return dim == 3 && deformation_ == Deformation::large; }
  /// Those at the end of the step, in the axes of space; keeps them and the curvature in the axes of the material.
  /// @param increment of the nodal values of the element
  RotationPatterns turned_patterns(OfElement& element, const Eigen::VectorXd& increment) const
      requires(dim == 3);
  void follow(OfElement& element, const typename Cosserat<dim>::Vector& stress) const;
  /// Stiffness of each mode against an unknown of a node. @param component of node_dofs
  [[nodiscard]] Eigen::VectorXd stiffness(const OfElement& element, int component) const;

  Continuum continuum_;
  Deformation deformation_;
  double share_;
  std::vector<OfElement> elements_;
};

/// Stabilisation::doubt of the springs of a problem; empty without springs.
template <int dim>
std::string doubt_of_one_point_elements(const Solver<dim>& solver);

}  // namespace polargrain::fem
