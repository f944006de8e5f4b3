// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fem/material/slip_driven.hpp"
#include "fem/solver/contribution.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

struct SpreadOptions {
  /// Full width at half maximum of the slip that one line of slipping material spreads over, m.
  double width = 0.0;
  /// Overstress that a step needs for a growth of the source of 1, over the strength at its start (SlipAnswer::scale). It decides
  /// where neighbouring lines could slip alike; the smaller the steps, the smaller the overstress.
  double overstress = 0.01;
  /// The same of explicit steps, in which sources grow by a thousandth or less: of the strength that is as little. With less of it
  /// nodes would begin and end to slip in each step, which cost more than the boxes.
  double overstress_of_explicit_steps = 1.0;
  /// Of the rows of both fields (NodalField::tolerance).
  double tolerance = 1e-8;
};

/// Names of the fields: the slip, the overstress over SlipDriven::slip_stiffness, and what stands between the two operators.
inline constexpr const char* kSlip = "slip";
inline constexpr const char* kOverstress = "overstress";
inline constexpr const char* kSlipBetween = "slip_between";
inline constexpr const char* kOverstressBetween = "overstress_between";
/// All of them are given as zero (PrescribedField) where a rough plate holds slips: a source there would have no slip to feed.
inline constexpr const char* kSpreadFields[] = {kSlip, kOverstress, kSlipBetween, kOverstressBetween};

/// Slips that are spread over a length, which gives bands a thickness (docs/theory/spread.md). The source of slip lambda never
/// goes back, and slips spread from it:
///
///     lambda = A A g,   A A mu = F(strain, g),   d lambda = <mu> / r,   A = 1 - l^2 lap,
///
/// with the drive F of the law, its spread overstress mu, and a small r. One line of sources slips by (1 + |x|/l) exp(-|x|/l). A once
/// would have a cusp, which sources on the staircase of nodes along an inclined band cut off (docs/theory/spread.md). Materials answer at the slip g (SlipDriven). Slip and
/// overstress have values at the corners of elements. In large deformation slips spread over the mesh as it was made.
template <int dim>
class SpreadSlip final : public StatelessContribution<dim> {
 public:
  /// @param field number of the first of its fields @param materials SlipDriven ones of the problem, by region
  SpreadSlip(const Problem<dim>& problem, std::size_t field,
             const std::map<std::string, std::shared_ptr<SlipDriven<dim>>>& materials, SpreadOptions options);

  [[nodiscard]] std::string name() const override { return "spread slips"; }
  [[nodiscard]] std::size_t elements() const override { return elements_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t e) const override { return elements_[e].entries; }
  void learn(const Discretisation<dim>& discretisation, std::span<const Response<dim>> committed) override;
  void prepare(const NodalStep& step) override;
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t e) const override;
  [[nodiscard]] std::vector<std::string> faults(const Problem<dim>& problem) const override;
  [[nodiscard]] bool takes_explicit_steps() const override { return true; }
  [[nodiscard]] bool fields_store() const override { return false; }

 private:
  struct Point {
    double volume;
    Eigen::VectorXd shape;  ///< of the corners
    StrainMatrix<dim> strain;
  };
  struct Part {  ///< an element
    const ElementType<dim>* type;
    VectorRows<dim> nodes;  ///< where they are, a row a node
    std::size_t batch;
    std::size_t first;         ///< its first point among those of the material
    std::vector<int> entries;  ///< displacements and micro-rotations, slips, overstresses, and those between
    std::vector<int> slips, overstresses, slips_between, overstresses_between;
    std::vector<Point> points;
    Eigen::VectorXd mass;      ///< lumped
    Eigen::MatrixXd spread;    ///< A = mass + l^2 of the gradients
    double resistance = 1.0;   ///< r over slip_stiffness, of this step
    Eigen::VectorXd slipping;  ///< 1 where the overstress is positive, else 0; of the last evaluation
  };
  struct Batch {  ///< the points of one material
    std::shared_ptr<SlipDriven<dim>> material;
    std::vector<double> slips;  ///< growth over the step that the material was asked with
  };
  void add_element(const Problem<dim>& problem, const FieldPlaces<dim>& places, std::size_t field, int number,
                   std::size_t batch);
  /// How stresses and drives of the last evaluation, in the axes of the end of the step, meet the displacements.
  struct Coupling {
    double volume;
    StrainMatrix<dim> of_forces, of_drive;
  };
  [[nodiscard]] std::vector<Coupling> couplings(const Part& part) const;
  /// The rows between the drive and the overstress, and between the source and the slip.
  void evaluate_between(const Part& part, const NodalStep& step, NodalForces& forces) const;

  SpreadOptions options_;
  Continuum continuum_;
  bool moves_;                         ///< large deformation
  Eigen::VectorXd start_, increment_;  ///< of the last evaluation, where the mesh moves
  double stiffness_ =
      1.0;  ///< by which rows and values of the overstress are measured, Pa; of the first answers
  std::vector<Batch> batches_;
  std::vector<Part> elements_;
};

/// Gives a problem, whose materials are known, its spread slips: two fields and the contribution. Regions whose material is not
/// SlipDriven have no slip.
/// @throws RunError when no material is SlipDriven
template <int dim>
std::shared_ptr<SpreadSlip<dim>> add_spread_slip(Problem<dim>& problem, const SpreadOptions& options);

}  // namespace polargrain::fem
