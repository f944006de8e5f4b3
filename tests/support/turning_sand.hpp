// SPDX-License-Identifier: GPL-2.0-or-later
// Cells whose grains obey a plastic law and turn with their box, for tests of large deformation. Their polar
// decomposition is their own.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <cstring>

#include "coupler/cells/cell_calls.hpp"
#include "tests/support/synthetic_sand.hpp"

namespace polargrain::testing {

/// s' = R s R^T, written out.
inline Vector7 turned_by(const Eigen::Matrix2d& r, const Vector7& stress) {
  Eigen::Matrix2d s;
  s << stress(k11), stress(k12), stress(k21), stress(k22);
  s = r * s * r.transpose();
  Vector7 turned;
  turned << s(0, 0), s(1, 1), stress(k33), s(0, 1), s(1, 0), r * stress.tail<2>();
  return turned;
}

/// The same of a tangent, column by column.
inline Matrix7 tangent_turned_by(const Eigen::Matrix2d& r, const Matrix7& tangent) {
  Matrix7 half, whole;
  for (int j = 0; j < 7; ++j) half.col(j) = turned_by(r, tangent.col(j));
  const Matrix7 across = half.transpose();
  for (int j = 0; j < 7; ++j) whole.col(j) = turned_by(r, across.col(j));
  return whole.transpose();
}

struct TurningSand {
  fem::ElastoplasticLaw<2> law{{elasticity(), {}, micro_strength()}};

  coupler::PlaneReply reply(const fem::ElastoplasticState<2>& state, const Response<2>& response) const {
    coupler::PlaneReply reply;
    reply.response = response;
    reply.response.noise = {};
    reply.knows_s33 = true;
    const auto bytes = std::as_bytes(std::span(&state, 1));
    reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
    return reply;
  }

  coupler::PlaneReply at_rest() const {
    fem::ElastoplasticState<2> state = law.initial_state();
    fem::ElastoplasticState<2> end;
    return reply(state, law.integrate(state, Increment<2>{}, end));
  }

  /// Stretched in small steps, then turned.
  coupler::PlaneReply follow(const coupler::PlaneRequest& request) const {
    fem::ElastoplasticState<2> state;
    std::memcpy(static_cast<void*>(&state), request.state->bytes().data(), sizeof state);
    const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d f = one + request.increment.displacement_gradient;
    const Eigen::JacobiSVD<Eigen::Matrix2d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix2d turn = svd.matrixU() * svd.matrixV().transpose();
    const Eigen::Matrix2d strain = turn.transpose() * f - one;
    Increment<2> part;
    part.displacement_gradient = 0.5 / kSubSteps * (strain + strain.transpose());
    Response<2> response;
    for (int i = 0; i < kSubSteps; ++i) {
      const fem::ElastoplasticState<2> before = state;
      response = law.integrate(before, part, state);
    }
    state.scaled_stress = turned_by(turn, state.scaled_stress);
    response.stress = turned_by(turn, response.stress);
    response.tangent = tangent_turned_by(turn, response.tangent);
    return reply(state, response);
  }

  coupler::CellCalls<2> calls() const {
    return {[this] { return at_rest(); },
            [this](std::span<const coupler::PlaneRequest> requests, std::span<const std::size_t>) {
              std::vector<coupler::PlaneReply> replies;
              for (const coupler::PlaneRequest& request : requests) replies.push_back(follow(request));
              return replies;
            }};
  }
};

}  // namespace polargrain::testing
