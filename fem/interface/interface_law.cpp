// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/interface/interface_law.hpp"

#include <algorithm>

namespace polargrain::fem {
namespace {

template <int dim>
FaceVector<dim> stiffness(const InterfaceParameters& parameters) {
  FaceVector<dim> k = FaceVector<dim>::Constant(parameters.shear_stiffness);
  k(dim - 1) = parameters.normal_stiffness;
  return k;
}

/// Tension and cohesion are lost where the interface has been open.
template <int dim>
InterfaceParameters remaining(InterfaceParameters parameters, const InterfaceState<dim>& state) {
  if (state.has_opened) {
    parameters.tension = 0.0;
    if (!parameters.cohesion_lasts) parameters.cohesion = 0.0;
  }
  if (state.slip >= parameters.dilation_until) parameters.tan_dilation = 0.0;
  return parameters;
}

template <int dim>
InterfaceAnswer<dim> open(const InterfaceParameters& parameters, const InterfaceState<dim>& committed,
                          const FaceVector<dim>& jump) {
  InterfaceAnswer<dim> answer{FaceVector<dim>::Zero(), Eigen::Matrix<double, dim, dim>::Zero(), Contact::open,
                              committed};
  answer.state.has_opened = true;
  // The tangential plastic jump follows the open one, so that the point closes without shear.
  answer.state.plastic_jump.template head<dim - 1>() =
      jump.template head<dim - 1>() +
      committed.initial_traction.template head<dim - 1>() / parameters.shear_stiffness;
  return answer;
}

}  // namespace

template <int dim>
InterfaceAnswer<dim> respond(const InterfaceParameters& given, const InterfaceState<dim>& committed,
                             const FaceVector<dim>& jump) {
  using Shear = Eigen::Matrix<double, dim - 1, 1>;
  constexpr int normal = dim - 1;
  const InterfaceParameters parameters = remaining(given, committed);
  const FaceVector<dim> k = stiffness<dim>(parameters);
  const FaceVector<dim> trial = committed.initial_traction + k.cwiseProduct(jump - committed.plastic_jump);
  if (trial(normal) > parameters.tension) return open(parameters, committed, jump);

  const double size = trial.template head<dim - 1>().norm();
  const double excess = size + trial(normal) * parameters.tan_friction - parameters.cohesion;
  InterfaceAnswer<dim> answer{trial, k.asDiagonal(), Contact::sticks, committed};
  if (excess <= 0.0) return answer;

  const double kt = parameters.shear_stiffness;
  const double kn = parameters.normal_stiffness;
  const double tan_delta = parameters.tan_friction;
  const double tan_psi = parameters.tan_dilation;
  const double denominator = kt + kn * tan_delta * tan_psi;
  const double slip = excess / denominator;
  const Shear direction = trial.template head<dim - 1>() / size;
  answer.traction(normal) -= kn * tan_psi * slip;
  // Beyond the vertex of the cone too: there the shear would have to change its sign.
  if (answer.traction(normal) > parameters.tension) return open(parameters, committed, jump);
  answer.traction.template head<dim - 1>() -= kt * slip * direction;
  answer.contact = Contact::slips;
  answer.state.plastic_jump.template head<dim - 1>() += slip * direction;
  answer.state.plastic_jump(normal) += slip * tan_psi;
  answer.state.slip += slip;

  const double left = 1.0 - kt * slip / size;  // share of the trial shear that is left
  const Eigen::Matrix<double, dim - 1, dim - 1> along = direction * direction.transpose();
  answer.tangent.template topLeftCorner<dim - 1, dim - 1>() =
      kt * left * (Eigen::Matrix<double, dim - 1, dim - 1>::Identity() - along) +
      (kt - kt * kt / denominator) * along;
  answer.tangent.template topRightCorner<dim - 1, 1>() = -kt * kn * tan_delta / denominator * direction;
  answer.tangent.template bottomLeftCorner<1, dim - 1>() =
      -kn * kt * tan_psi / denominator * direction.transpose();
  answer.tangent(normal, normal) = kn - kn * kn * tan_delta * tan_psi / denominator;
  return answer;
}

template <int dim>
double gap(const InterfaceParameters& parameters, const InterfaceAnswer<dim>& answer,
           const FaceVector<dim>& jump) {
  if (answer.contact != Contact::open) return 0.0;
  return jump(dim - 1) - answer.state.plastic_jump(dim - 1) +
         answer.state.initial_traction(dim - 1) / parameters.normal_stiffness;
}

template <int dim>
double mobilised_share(const InterfaceParameters& given, const InterfaceAnswer<dim>& answer) {
  if (answer.contact == Contact::open) return 0.0;
  if (answer.contact == Contact::slips) return 1.0;
  const InterfaceParameters parameters = remaining(given, answer.state);
  const double strength = parameters.cohesion - answer.traction(dim - 1) * parameters.tan_friction;
  const double shear = answer.traction.template head<dim - 1>().norm();
  return shear > 0.0 ? std::min(1.0, shear / strength) : 0.0;
}

template InterfaceAnswer<2> respond<2>(const InterfaceParameters&, const InterfaceState<2>&,
                                       const FaceVector<2>&);
template InterfaceAnswer<3> respond<3>(const InterfaceParameters&, const InterfaceState<3>&,
                                       const FaceVector<3>&);
template double gap<2>(const InterfaceParameters&, const InterfaceAnswer<2>&, const FaceVector<2>&);
template double gap<3>(const InterfaceParameters&, const InterfaceAnswer<3>&, const FaceVector<3>&);
template double mobilised_share<2>(const InterfaceParameters&, const InterfaceAnswer<2>&);
template double mobilised_share<3>(const InterfaceParameters&, const InterfaceAnswer<3>&);

}  // namespace polargrain::fem
