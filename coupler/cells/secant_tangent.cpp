// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/secant_tangent.hpp"

#include <utility>

#include "coupler/cells/linearised.hpp"
#include "coupler/pool/pool.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// Of the stiffness at the start along an increment, that is left at least.
constexpr double kLeastStiffness = 0.1;

/// Requests of one kind, with their places among all.
template <int dim>
struct Share {
  std::vector<PointRequest<dim>> requests;
  std::vector<std::size_t> points;
  std::vector<std::size_t> places;
};

template <int dim>
void answer(const CellCalls<dim>& calls, const Share<dim>& share, std::vector<PointReply<dim>>& replies) {
  if (share.requests.empty()) return;
  std::vector<PointReply<dim>> answers = calls.evaluate(share.requests, share.points);
  for (std::size_t k = 0; k < answers.size(); ++k) replies[share.places[k]] = std::move(answers[k]);
}

}  // namespace

template <int dim>
typename Cosserat<dim>::Matrix secant_tangent(const Response<dim>& start, const Response<dim>& end,
                                              const Increment<dim>& increment, double length) {
  using Vector = typename Cosserat<dim>::Vector;
  using Matrix = typename Cosserat<dim>::Matrix;
  Vector strain = increment.strain();
  if (increment.configuration != Configuration::fixed) {
    const fem::StretchAndTurn<dim> step = fem::stretch_and_turn(increment);
    strain = fem::rotated(Vector(step.stretch.strain()), step.turn);
  }
  Vector weighted = strain;
  weighted.template tail<Cosserat<dim>::couples>() *= length * length;
  const double square = weighted.dot(strain);
  const Matrix before = with_tangent_turned(start, increment).tangent;
  if (!(square > 0.0)) return before;
  const Vector missed = end.stress - linearised_stress(start, increment);
  const double stiffness = strain.dot(before * strain);
  const double change = strain.dot(missed);
  // The share of the change that leaves the least stiffness.
  const double least = (kLeastStiffness - 1.0) * stiffness;
  const double share = change < least ? least / change : 1.0;
  return before + share / square * missed * weighted.transpose();
}

template <int dim>
CellCalls<dim> with_secant_tangents(const CellCalls<dim>& exact, const CellCalls<dim>& stress_alone,
                                    double length) {
  CellCalls<dim> calls = exact;
  calls.evaluate = [exact, stress_alone, length](std::span<const PointRequest<dim>> requests,
                                                 std::span<const std::size_t> points) {
    Share<dim> with;
    Share<dim> without;
    for (std::size_t k = 0; k < requests.size(); ++k) {
      Share<dim>& share = requests[k].start == nullptr ? with : without;
      share.requests.push_back(requests[k]);
      share.points.push_back(points[k]);
      share.places.push_back(k);
    }
    std::vector<PointReply<dim>> replies(requests.size());
    answer(exact, with, replies);
    answer(stress_alone, without, replies);
    for (const std::size_t k : without.places) {
      Response<dim>& end = replies[k].response;
      if (end.quality != Quality::failed)
        end.tangent = secant_tangent(*requests[k].start, end, requests[k].increment, length);
    }
    return replies;
  };
  return calls;
}

template <int dim>
CellCalls<dim> secant_calls_of(Pool& pool, std::uint32_t definition) {
  CellDefinition stress_alone = pool.definition(definition);
  stress_alone.control.tangent = CellTangent::none;
  const double length = 2.0 * stress_alone.packing.mean_radius();
  return with_secant_tangents(calls_of<dim>(pool, definition),
                              calls_of<dim>(pool, pool.define(std::move(stress_alone))), length);
}

template Cosserat<2>::Matrix secant_tangent(const Response<2>&, const Response<2>&, const Increment<2>&,
                                            double);
template Cosserat<3>::Matrix secant_tangent(const Response<3>&, const Response<3>&, const Increment<3>&,
                                            double);
template CellCalls<2> with_secant_tangents(const CellCalls<2>&, const CellCalls<2>&, double);
template CellCalls<3> with_secant_tangents(const CellCalls<3>&, const CellCalls<3>&, double);
template CellCalls<2> secant_calls_of(Pool&, std::uint32_t);
template CellCalls<3> secant_calls_of(Pool&, std::uint32_t);

}  // namespace polargrain::coupler
