// SPDX-License-Identifier: GPL-2.0-or-later
// The tangent of large deformation against central differences, for every element, continuum and law.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>

#include "fem/element/dofs.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/discretisation.hpp"
#include "tests/support/synthetic_sand.hpp"

namespace polargrain::fem {
namespace {

/// One step of one element: from a shape that has turned already, turned on by 0.4 rad while it is strained unevenly.
class OneStep {
 public:
  OneStep(const std::string& element, Continuum continuum, std::shared_ptr<Material<2>> material,
          double strain)
      : mesh_(rectangle({{0.1, 0.08}, {1, 1}}, element)),
        start_(mesh_, continuum),
        end_(mesh_, continuum),
        material_(std::move(material)) {
    Eigen::VectorXd before = nodal(0.5, 0.02);
    before_ = before;
    increment = nodal(0.9, strain) - before;
    EXPECT_EQ(start_.move_to(before), "");
    material_->allocate(start_.points());
  }

  Eigen::VectorXd forces() {
    EXPECT_EQ(end_.move_to(before_ + increment), "");
    increments_ = start_.increments_to(end_, increment);
    answers_.resize(increments_.size());
    material_->evaluate(increments_, answers_);
    for (const Response<2>& answer : answers_) EXPECT_EQ(answer.quality, Quality::good) << answer.message;
    return end_.internal_forces(answers_);
  }

  /// Of all elements, at the last forces.
  [[nodiscard]] Eigen::MatrixXd tangent() const {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(increment.size(), increment.size());
    for (std::size_t e = 0; e < end_.elements(); ++e)
      whole(end_.element_dofs(e), end_.element_dofs(e)) +=
          end_.element_tangent(e, {answers_, Linearisation<2>::Moving{start_, increments_}});
    return whole;
  }

  Eigen::VectorXd increment;

 private:
  [[nodiscard]] Eigen::VectorXd nodal(double angle, double strain) const {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(start_.nodal_size());
    for (std::size_t node = 0; node < mesh_.nodes.size(); ++node) {
      const Eigen::Vector2d x = mesh_.nodes[node];
      const double k = static_cast<double>(node);
      const Eigen::Vector2d strained =
          x + strain * Eigen::Vector2d(0.8 * x(0) + 0.6 * x(1) + 0.01 * std::sin(2.1 * k),
                                       -x(1) + 0.2 * x(0) + 0.01 * std::cos(1.3 * k));
      const Eigen::Index entry = entry_of<2>(static_cast<Eigen::Index>(node));
      values.segment<2>(entry) = Eigen::Rotation2Dd(angle) * strained - x;
      values(entry + 2) = angle + 0.3 * strain * std::sin(0.7 * k);
    }
    return values;
  }

  Mesh<2> mesh_;
  Discretisation<2> start_, end_;
  std::shared_ptr<Material<2>> material_;
  Eigen::VectorXd before_;
  std::vector<Increment<2>> increments_;
  std::vector<Response<2>> answers_;
};

TEST(LargeTangent, IsTheDerivativeOfTheForces) {
  ElasticParameters<2> elastic = testing::elasticity();
  elastic.internal_length = 0.02;
  for (const bool plastic : {false, true}) {
    // An initial stress as large as the moduli shows every turn of it.
    elastic.initial_stress << -3e7, -1e7, -2e7, 6e6, 4e6, 2e5, -1e5;
    for (const std::string& element : element_names<2>()) {
      for (const Continuum continuum : {Continuum::cosserat, Continuum::cauchy}) {
        ElasticParameters<2> of_case = elastic;
        if (continuum == Continuum::cauchy) of_case.initial_stress << -3e7, -1e7, -2e7, 5e6, 5e6, 0, 0;
        std::shared_ptr<Material<2>> material =
            std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(of_case));
        if (plastic)
          material = std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(
              ElastoplasticLaw<2>({of_case, {}, {PiecewiseLinear(0.8), PiecewiseLinear(0.2), 1e7}}));
        OneStep step(element, continuum, material, plastic ? 0.2 : 0.3);
        (void)step.forces();
        const Eigen::MatrixXd tangent = step.tangent();
        double error = 0.0;
        for (Eigen::Index j = 0; j < step.increment.size(); ++j) {
          if (continuum == Continuum::cauchy && j % 3 == 2) continue;
          const double size = j % 3 == 2 ? 1e-5 : 1e-6;
          const double kept = step.increment(j);
          step.increment(j) = kept + size;
          const Eigen::VectorXd plus = step.forces();
          step.increment(j) = kept - size;
          const Eigen::VectorXd difference = (plus - step.forces()) / (2.0 * size);
          step.increment(j) = kept;
          error = std::max(error, (difference - tangent.col(j)).norm() / tangent.col(j).norm());
        }
        std::cout << "[figure] tangent of " << element << (plastic ? ", elastoplastic" : ", elastic")
                  << (continuum == Continuum::cauchy ? ", cauchy" : ", cosserat")
                  << ": relative error against central differences " << error << '\n';
        // Rounding of 1e-16 over 1e-6 of 0.1 m, and the square of that over the strains.
        EXPECT_LT(error, 2e-7) << element << plastic;
      }
    }
  }
}

}  // namespace
}  // namespace polargrain::fem
