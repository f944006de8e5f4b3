// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/own_answer.hpp"

#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// The share of a carried stress that is left.
template <int dim>
double share_left(const OwnAnswerRules<dim>& rules, double strained) {
  return strained < rules.work_off_strain ? 1.0 - strained / rules.work_off_strain : 0.0;
}

}  // namespace

template <int dim>
OwnAnswer<dim> left_law(const OwnAnswerRules<dim>& rules,
                        const std::type_identity_t<typename Cosserat<dim>::Vector>& law,
                        const PointReply<dim>& reply) {
  const Response<dim>& cell = reply.response;
  OwnAnswer<dim> own;
  own.active = true;
  if (!rules.controlled) {
    own.cosserat.skew_stress = skew_stress_of<dim>(law);
    own.cosserat.couple_stress = law.template tail<Cosserat<dim>::couples>();
    own.cosserat.contacts_kept = rules.packing.kept(reply.diagnostics);
    own.cosserat.keep_within(rules.cosserat, pressures_of<dim>(cell.stress));
  }
  own.carried = law - (rules.controlled ? cell : own.cosserat.joined_to(cell, rules.cosserat)).stress;
  return own;
}

template <int dim>
Response<dim> own_answer(const OwnAnswerRules<dim>& rules, const OwnAnswer<dim>& start,
                         const Increment<dim>& increment, const PointReply<dim>& reply, OwnAnswer<dim>& end) {
  using Vector = typename Cosserat<dim>::Vector;
  const Response<dim>& cell = reply.response;
  end = start;
  const fem::StretchAndTurn<dim> step = fem::stretch_and_turn(increment);
  Vector strain = step.stretch.strain();
  if (increment.configuration != Configuration::fixed) {
    end.carried = fem::rotated(end.carried, step.turn);
    strain = fem::rotated(strain, step.turn);
  }
  Vector scale = Vector::Ones();
  scale.template tail<Cosserat<dim>::couples>().setConstant(rules.length);
  strain = rules.controlled ? Vector(strain.cwiseProduct(scale)) : symmetric_part<dim>(strain);
  const double size = strain.norm();
  end.strained += size;

  Response<dim> response = rules.controlled ? cell
                                            : end.cosserat.follow(increment, cell, rules.cosserat,
                                                                  rules.packing.kept(reply.diagnostics));
  if (response.quality == Quality::failed) return response;
  const double left = share_left(rules, end.strained);
  if (!(left > 0.0)) {
    end.carried.setZero();
    return response;
  }
  response.stress += left * end.carried;
  if (size > 0.0) {
    // d strained / d strain is the direction of the increment.
    const Vector direction = strain.cwiseProduct(scale) / size;
    response.tangent -= end.carried * direction.transpose() / rules.work_off_strain;
  }
  return response;
}

template OwnAnswer<2> left_law(const OwnAnswerRules<2>&, const Cosserat<2>::Vector&, const PointReply<2>&);
template Response<2> own_answer(const OwnAnswerRules<2>&, const OwnAnswer<2>&, const Increment<2>&,
                                const PointReply<2>&, OwnAnswer<2>&);
template OwnAnswer<3> left_law(const OwnAnswerRules<3>&, const Cosserat<3>::Vector&, const PointReply<3>&);
template Response<3> own_answer(const OwnAnswerRules<3>&, const OwnAnswer<3>&, const Increment<3>&,
                                const PointReply<3>&, OwnAnswer<3>&);

}  // namespace polargrain::coupler
