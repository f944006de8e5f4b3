// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/interface/interface_law.hpp"

#include <algorithm>
#include <optional>

namespace polargrain::fem {
namespace {

template <int dim>
FaceVector<dim> stiffness(const InterfaceParameters& parameters) {
  FaceVector<dim> k = FaceVector<dim>::Constant(parameters.shear_stiffness);
  k(dim - 1) = parameters.normal_stiffness;
  return k;
}

/// The strength that is left.
struct Remaining {
  double cohesion;
  double tension;
};

/// Tension and cohesion are lost where the interface has been open.
template <int dim>
Remaining remaining(const InterfaceParameters& parameters, const InterfaceState<dim>& state) {
  if (!state.has_opened) return {parameters.cohesion, parameters.tension};
  return {parameters.cohesion_lasts ? parameters.cohesion : 0.0, 0.0};
}

/// The law of a stretch of slip: a straight piece of the curve, or constants.
FrictionCurve::Piece piece_of(const InterfaceParameters& parameters, double slip) {
  if (parameters.over_slip) return parameters.over_slip->pieces()[parameters.over_slip->piece_at(slip)];
  return {slip, HUGE_VAL, parameters.tan_friction, 0.0,
          slip >= parameters.dilation_until ? 0.0 : parameters.tan_dilation};
}

/// A return to the friction.
struct Return {
  double slip = 0.0;      ///< more than before, m
  double opening = 0.0;   ///< that comes with it, m
  double friction = 0.0;  ///< tan(delta) at its end
  double tan_dilation = 0.0;
  double denominator = 0.0;  ///< fall of the excess over slip at its end, Pa/m
};

/// The least x > 0 of a + b x + c x^2 = 0, of which a > 0, up to `length`; nothing where the excess lasts.
std::optional<double> least_root(double a, double b, double c, double length) {
  if (c == 0.0) {
    if (!(b < 0.0)) return {};
    const double x = -a / b;
    return x <= length ? std::optional(x) : std::nullopt;
  }
  const double under = b * b - 4.0 * a * c;
  if (under < 0.0) return {};
  // Both roots without a difference of nearly equal numbers.
  const double q = -0.5 * (b + std::copysign(std::sqrt(under), b));
  double best = HUGE_VAL;
  for (const double x : {q / c, q != 0.0 ? a / q : HUGE_VAL})
    if (x > 0.0) best = std::min(best, x);
  return best <= length ? std::optional(best) : std::nullopt;
}

/// Walks along the pieces until the friction carries the shear. @param shear trial size @param normal trial stress
Return return_to_friction(const InterfaceParameters& parameters, double slip_before, double shear,
                          double normal, double cohesion) {
  const double kt = parameters.shear_stiffness;
  const double kn = parameters.normal_stiffness;
  Return made;
  double at = slip_before;
  for (;;) {
    const FrictionCurve::Piece piece = piece_of(parameters, at);
    const double friction = piece.friction + piece.friction_slope * (at - piece.from);
    const double pressing = normal - kn * made.opening;
    // The excess over the slip x in this piece: (shear - kt x) + (pressing - kn psi x)(friction + slope x) - cohesion.
    const double a = shear - kt * made.slip + pressing * friction - cohesion;
    const double b = -kt - kn * friction * piece.tan_dilation + pressing * piece.friction_slope;
    const double c = -kn * piece.tan_dilation * piece.friction_slope;
    const double length = piece.to - at;
    const std::optional<double> end = a <= 0.0 ? std::optional(0.0) : least_root(a, b, c, length);
    // Behind the last point the friction always ends it, unless a value is no number.
    const bool is_last = std::isinf(piece.to);
    const double x = end.value_or(is_last ? 0.0 : length);
    made.slip += x;
    made.opening += piece.tan_dilation * x;
    if (end || is_last) {
      made.friction = friction + piece.friction_slope * x;
      made.tan_dilation = piece.tan_dilation;
      made.denominator =
          kt + kn * made.friction * piece.tan_dilation - (normal - kn * made.opening) * piece.friction_slope;
      return made;
    }
    at = piece.to;
  }
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

double tan_friction_at(const InterfaceParameters& parameters, double slip) {
  return parameters.over_slip ? parameters.over_slip->friction(slip) : parameters.tan_friction;
}

template <int dim>
InterfaceAnswer<dim> respond(const InterfaceParameters& parameters, const InterfaceState<dim>& committed,
                             const FaceVector<dim>& jump) {
  using Shear = Eigen::Matrix<double, dim - 1, 1>;
  constexpr int normal = dim - 1;
  const Remaining strength = remaining(parameters, committed);
  const FaceVector<dim> k = stiffness<dim>(parameters);
  const FaceVector<dim> trial = committed.initial_traction + k.cwiseProduct(jump - committed.plastic_jump);
  if (trial(normal) > strength.tension) return open(parameters, committed, jump);

  const double size = trial.template head<dim - 1>().norm();
  const double excess =
      size + trial(normal) * tan_friction_at(parameters, committed.slip) - strength.cohesion;
  InterfaceAnswer<dim> answer{trial, k.asDiagonal(), Contact::sticks, committed};
  if (excess <= 0.0) return answer;

  const double kt = parameters.shear_stiffness;
  const double kn = parameters.normal_stiffness;
  const Return made = return_to_friction(parameters, committed.slip, size, trial(normal), strength.cohesion);
  const Shear direction = trial.template head<dim - 1>() / size;
  answer.traction(normal) -= kn * made.opening;
  // Beyond the vertex of the cone too: there the shear would have to change its sign.
  if (answer.traction(normal) > strength.tension) return open(parameters, committed, jump);
  answer.traction.template head<dim - 1>() -= kt * made.slip * direction;
  answer.contact = Contact::slips;
  answer.state.plastic_jump.template head<dim - 1>() += made.slip * direction;
  answer.state.plastic_jump(normal) += made.opening;
  answer.state.slip += made.slip;

  const double left = 1.0 - kt * made.slip / size;  // share of the trial shear that is left
  const double denominator = made.denominator;
  const Eigen::Matrix<double, dim - 1, dim - 1> along = direction * direction.transpose();
  answer.tangent.template topLeftCorner<dim - 1, dim - 1>() =
      kt * left * (Eigen::Matrix<double, dim - 1, dim - 1>::Identity() - along) +
      (kt - kt * kt / denominator) * along;
  answer.tangent.template topRightCorner<dim - 1, 1>() = -kt * kn * made.friction / denominator * direction;
  answer.tangent.template bottomLeftCorner<1, dim - 1>() =
      -kn * kt * made.tan_dilation / denominator * direction.transpose();
  answer.tangent(normal, normal) = kn - kn * kn * made.friction * made.tan_dilation / denominator;
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
double mobilised_share(const InterfaceParameters& parameters, const InterfaceAnswer<dim>& answer) {
  if (answer.contact == Contact::open) return 0.0;
  if (answer.contact == Contact::slips) return 1.0;
  const double strength = remaining(parameters, answer.state).cohesion -
                          answer.traction(dim - 1) * tan_friction_at(parameters, answer.state.slip);
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
