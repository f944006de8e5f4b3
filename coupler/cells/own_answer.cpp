// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/own_answer.hpp"

#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// The share of a carried stress that is left.
double share_left(const OwnAnswerRules& rules, double strained) {
  return strained < rules.work_off_strain ? 1.0 - strained / rules.work_off_strain : 0.0;
}

}  // namespace

OwnAnswer left_law(const OwnAnswerRules& rules, const Vector7& law, const PlaneReply& reply) {
  const Response<2>& cell = reply.response;
  OwnAnswer own;
  own.active = true;
  if (!rules.controlled) {
    own.cosserat.skew_stress = law(k21) - law(k12);
    own.cosserat.couple_stress = law.tail<2>();
    own.cosserat.contacts_kept = rules.packing.kept(reply.diagnostics);
    own.cosserat.keep_within(rules.cosserat, pressure_in_plane(cell.stress));
  }
  own.carried = law - (rules.controlled ? cell : own.cosserat.joined_to(cell, rules.cosserat)).stress;
  return own;
}

Response<2> own_answer(const OwnAnswerRules& rules, const OwnAnswer& start, const Increment<2>& increment,
                       const PlaneReply& reply, OwnAnswer& end) {
  const Response<2>& cell = reply.response;
  end = start;
  const fem::StretchAndTurn<2> step = fem::stretch_and_turn(increment);
  Vector7 strain = step.stretch.strain();
  if (increment.configuration != Configuration::fixed) {
    end.carried = fem::rotated(end.carried, step.turn);
    strain = fem::rotated(strain, step.turn);
  }
  Vector7 scale = Vector7::Ones();
  scale.tail<2>().setConstant(rules.length);
  strain = rules.controlled ? Vector7(strain.cwiseProduct(scale)) : symmetric_part(strain);
  const double size = strain.norm();
  end.strained += size;

  Response<2> response = rules.controlled ? cell
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
    const Vector7 direction = strain.cwiseProduct(scale) / size;
    response.tangent -= end.carried * direction.transpose() / rules.work_off_strain;
  }
  return response;
}

}  // namespace polargrain::coupler
