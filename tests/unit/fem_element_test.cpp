// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <iostream>

#include "fem/element/kinematics.hpp"
#include "fem/material/elastic.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/stabilisation.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

class EveryElementType : public ::testing::TestWithParam<std::string> {
 protected:
  /// One strongly distorted element with curved sides where it has middle nodes.
  Mesh<2> distorted() const {
    const ElementType<2>& type = element_type<2>(GetParam());
    Mesh<2> mesh;
    mesh.elements.push_back({&type, {}});
    for (int a = 0; a < type.nodes; ++a) {
      const double x = type.node_positions[a](0);
      const double y = type.node_positions[a](1);
      mesh.nodes.emplace_back(2.0 * x + 0.5 * y + 0.3 * x * y + 0.05 * x * x,
                              1.3 * y - 0.2 * x + 0.08 * x * y * y);
      mesh.elements[0].nodes.push_back(a);
    }
    return mesh;
  }

  static Eigen::VectorXd rigid_motion(const Mesh<2>& mesh, double a, double b, double rotation) {
    Eigen::VectorXd nodal(3 * mesh.nodes.size());
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      nodal.segment<3>(3 * n) << a - rotation * mesh.nodes[n](1), b + rotation * mesh.nodes[n](0), rotation;
    }
    return nodal;
  }
};

TEST_P(EveryElementType, shape_functions_are_one_at_their_node_and_sum_to_one) {
  const ElementType<2>& type = element_type<2>(GetParam());
  for (int a = 0; a < type.nodes; ++a) {
    const ShapeFunctions<2> shape = type.shape_functions(type.node_positions[a]);
    EXPECT_LT((shape.value - Eigen::VectorXd::Unit(type.nodes, a)).norm(), 1e-15);
  }
  for (const QuadraturePoint<2>& point : type.quadrature) {
    EXPECT_NEAR(type.shape_functions(point.position).value.sum(), 1.0, 1e-15);
  }
}

TEST_P(EveryElementType, derivatives_of_the_shape_functions_are_their_differences) {
  const ElementType<2>& type = element_type<2>(GetParam());
  const Eigen::Vector2d place(0.21, 0.37);
  const ShapeFunctions<2> shape = type.shape_functions(place);
  constexpr double kStep = 1e-5;  // central differences of a cubic: error 1e-10, rounding 1e-11
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(i);
    const Eigen::VectorXd difference =
        (type.shape_functions(place + step).value - type.shape_functions(place - step).value) / (2 * kStep);
    EXPECT_LT((difference - shape.derivative.col(i)).norm(), 1e-9);
  }
}

TEST_P(EveryElementType, rigid_motion_gives_no_strain) {
  const Mesh<2> mesh = distorted();
  const Discretisation<2> discretisation(mesh, Continuum::cosserat);
  for (const Increment<2>& increment : discretisation.increments(rigid_motion(mesh, 0.3, -0.7, 0.9))) {
    EXPECT_LT(increment.strain().norm(), 1e-14);
    EXPECT_NEAR(increment.micro_rotation, 0.9, 1e-14);
  }
}

TEST_P(EveryElementType, increments_agree_with_the_strain_matrix) {
  const Mesh<2> mesh = distorted();
  const Eigen::VectorXd nodal = Eigen::VectorXd::LinSpaced(3 * mesh.nodes.size(), -1.0, 2.0).array().sin();
  for (const Continuum continuum : {Continuum::cosserat, Continuum::cauchy}) {
    for (const PointGeometry<2>& point :
         point_geometries(*mesh.elements[0].type, mesh.element_positions(0))) {
      const Vector7 direct = increment_at(point, continuum, nodal).strain();
      EXPECT_LT((direct - strain_matrix(point, continuum) * nodal).norm(), 1e-14);
    }
  }
}

TEST_P(EveryElementType, has_three_zero_modes_when_distorted) {
  const Mesh<2> mesh = distorted();
  ElasticParameters<2> parameters{1.0, 0.3, 0.4, 0.5, Vector7::Zero()};
  std::vector<Response<2>> responses(mesh.elements[0].type->quadrature.size());
  for (Response<2>& response : responses) response.tangent = elastic_stiffness(parameters);
  const Discretisation<2> discretisation(mesh, Continuum::cosserat);
  Eigen::MatrixXd stiffness = discretisation.element_tangent(0, {responses});
  if (const auto springs = Stabilisation<2>::of(mesh, Continuum::cosserat, Deformation::small)) {
    springs->learn(discretisation, responses);
    stiffness += springs->tangent(0);
  }
  EXPECT_LT((stiffness - stiffness.transpose()).norm(), 1e-14);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness).eigenvalues();
  const double largest = values.tail<1>()(0);
  std::cout << "[figure] " << GetParam() << " eigenvalues 3 and 4 over the largest: " << values(2) / largest
            << ", " << values(3) / largest << '\n';
  EXPECT_LT(std::abs(values(2)) / largest, 1e-14);  // rounding of a 24 x 24 matrix
  EXPECT_GT(values(3) / largest, 1e-4);             // ten orders above rounding: a real stiffness
}

INSTANTIATE_TEST_SUITE_P(Elements, EveryElementType, ::testing::ValuesIn(element_names<2>()));

}  // namespace
