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
  /// Full width at half maximum of the slip that one line of slipping material spreads over, m; the operator
  /// (1 - l^2 lap)^-1 has l = width / (2 ln 2).
  double width = 0.0;
  /// Overstress that a step needs for a growth of the source of 1, over the strength at its start (SlipAnswer::scale). It decides
  /// where neighbouring lines could slip alike; the smaller the steps, the smaller the overstress.
  double overstress = 0.001;
};

/// Names of the fields: the slip, and the overstress over SlipDriven::slip_stiffness.
inline constexpr const char* kSlip = "slip";
inline constexpr const char* kOverstress = "overstress";

/// Slips that are spread over a length, which gives bands a thickness (docs/theory/spread.md). The source of slip lambda never
/// goes back, and slips spread from it, no slip leaving through boundaries:
///
///     lambda = g - l^2 lap g,   mu - l^2 lap mu = F(strain, g),   d lambda = <mu> / r,
///
/// with the drive F of the law, its spread overstress mu, and a small r. Materials answer at the slip g (SlipDriven). Slip and
/// overstress have values at the corners of elements. Small deformation.
template <int dim>
class SpreadSlip final : public Contribution<dim> {
 public:
  /// @param slip, overstress numbers of the fields @param materials SlipDriven ones of the problem, by region
  SpreadSlip(const Problem<dim>& problem, std::size_t slip, std::size_t overstress,
             const std::map<std::string, std::shared_ptr<SlipDriven<dim>>>& materials, SpreadOptions options);

  [[nodiscard]] std::string name() const override { return "spread slips"; }
  [[nodiscard]] std::size_t elements() const override { return elements_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t e) const override { return elements_[e].entries; }
  void allocate() override {}
  void learn(const Discretisation<dim>& discretisation, std::span<const Response<dim>> committed) override;
  void prepare(const NodalStep& step) override;
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override;
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t e) const override;
  void commit() override {}
  void revert() override {}
  void save(ArchiveWriter&) const override {}
  void restore(ArchiveReader&) override {}
  [[nodiscard]] std::vector<std::string> faults(const Problem<dim>& problem) const override;

 private:
  struct Point {
    double volume;
    Eigen::VectorXd shape;  ///< of the corners
    StrainMatrix<dim> strain;
  };
  struct Part {  ///< an element
    std::size_t batch;
    std::size_t first;         ///< its first point among those of the material
    std::vector<int> entries;  ///< displacements and micro-rotations, slips, overstresses
    std::vector<int> slips, overstresses;
    std::vector<Point> points;
    Eigen::VectorXd mass;      ///< lumped
    Eigen::MatrixXd spread;    ///< A = mass + l^2 of the gradients
    double resistance = 1.0;   ///< r over slip_stiffness, of this step
    Eigen::VectorXd slipping;  ///< 1 where the overstress is positive, else 0; of the last evaluation
  };
  struct Batch {  ///< the points of one material
    std::shared_ptr<SlipDriven<dim>> material;
    std::vector<double> slips;
  };
  void add_element(const Problem<dim>& problem, const FieldPlaces<dim>& places, std::size_t slip,
                   std::size_t overstress, int number, std::size_t batch);

  SpreadOptions options_;
  double stiffness_ = 0.0;  ///< by which rows and values of the overstress are measured, Pa
  std::vector<Batch> batches_;
  std::vector<Part> elements_;
};

/// Gives a problem, whose materials are known, its spread slips: two fields and the contribution. Regions whose material is not
/// SlipDriven have no slip.
/// @throws RunError when no material is SlipDriven
template <int dim>
std::shared_ptr<SpreadSlip<dim>> add_spread_slip(Problem<dim>& problem, const SpreadOptions& options);

}  // namespace polargrain::fem
