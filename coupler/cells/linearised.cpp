// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/linearised.hpp"

#include "coupler/cells/cosserat_part.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {

Vector7 linearised_stress(const Response<2>& answer, const Increment<2>& offset) {
  if (offset.configuration != Configuration::fixed) {
    const fem::StretchAndTurn<2> step = fem::stretch_and_turn(offset);
    return fem::rotated(Vector7(answer.stress + answer.tangent * step.stretch.strain()), step.turn);
  }
  Vector7 stress = answer.stress + answer.tangent * offset.strain();
  const Eigen::Matrix2d& h = offset.displacement_gradient;
  const double turn = 0.5 * (h(1, 0) - h(0, 1));
  const double shear = 0.5 * (answer.stress[k12] + answer.stress[k21]);
  stress[k11] -= 2.0 * turn * shear;
  stress[k22] += 2.0 * turn * shear;
  const double difference = turn * (answer.stress[k11] - answer.stress[k22]);
  stress[k12] += difference;
  stress[k21] += difference;
  stress[kCurvature1] -= turn * answer.stress[kCurvature2];
  stress[kCurvature2] += turn * answer.stress[kCurvature1];
  return stress;
}

Vector18 linearised_stress(const Response<3>& answer, const Increment<3>& offset) {
  if (offset.configuration != Configuration::fixed) {
    const fem::StretchAndTurn<3> step = fem::stretch_and_turn(offset);
    return fem::rotated(Vector18(answer.stress + answer.tangent * step.stretch.strain()), step.turn);
  }
  const Eigen::Matrix3d turn = fem::cross_matrix(fem::axial(offset.displacement_gradient));
  const auto spun = [&turn](const Eigen::Matrix<double, 9, 1>& components) {
    Eigen::Matrix3d tensor;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) tensor(i, j) = components(Cosserat<3>::stress_place(i, j));
    tensor = (turn * tensor - tensor * turn).eval();
    Eigen::Matrix<double, 9, 1> made;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) made(Cosserat<3>::stress_place(i, j)) = tensor(i, j);
    return made;
  };
  Vector18 stress = answer.stress + answer.tangent * offset.strain();
  stress.head<9>() += spun(answer.stress.head<9>());
  stress.tail<9>() += spun(answer.stress.tail<9>());
  return stress;
}

template <int dim>
Response<dim> with_tangent_turned(Response<dim> answer, const Increment<dim>& offset) {
  if (offset.configuration != Configuration::fixed)
    answer.tangent = fem::rotated(answer.tangent, rotation_of(offset));
  return answer;
}

template Response<2> with_tangent_turned(Response<2>, const Increment<2>&);
template Response<3> with_tangent_turned(Response<3>, const Increment<3>&);

}  // namespace polargrain::coupler
