// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/slip_driven_cone.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "common/error.hpp"
#include "common/packed_values.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::fem {
namespace {

/// Numbers that a checkpoint keeps of a point: stress, slip, drive, scale, two vectors, one derivative.
template <int dim>
constexpr std::size_t kKept = 3 * Cosserat<dim>::components + 4;

}  // namespace

template <int dim>
std::vector<std::string> slip_faults(const ElastoplasticParameters<dim>& parameters) {
  const InvariantWeights& own = parameters.weights;
  const InvariantWeights known;
  if (own.a1 == known.a1 && own.a2 == known.a2 && own.a3 == known.a3) return {};
  return {fmt::format("slips are spread with the invariants {}, {}, {} alone; leave 'invariants' out",
                      known.a1, known.a2, known.a3)};
}

template <int dim>
SlipDrivenCone<dim>::SlipDrivenCone(const ElastoplasticParameters<dim>& parameters)
    : frame_{SubspaceModuli(parameters.elastic, parameters.weights), parameters.elastic.internal_length,
             parameters.apex_stiffness_share},
      cone_(parameters.cone),
      scale_(Vector::Ones()),
      initial_stress_(parameters.elastic.initial_stress) {
  std::vector<std::string> found = faults(parameters);
  std::ranges::copy(slip_faults(parameters), std::back_inserter(found));
  if (!found.empty()) throw RunError(fmt::format("elastoplastic material: {}", fmt::join(found, "; ")));
  scale_.template tail<Cosserat<dim>::couples>().setConstant(frame_.length);
}

template <int dim>
typename SlipDrivenCone<dim>::State SlipDrivenCone<dim>::state_of(const Vector& stress) const {
  State state{stress, 0.0};
  if (frame_.length > 0.0) state.stress.template tail<Cosserat<dim>::couples>() /= frame_.length;
  return state;
}

template <int dim>
void SlipDrivenCone<dim>::allocate(std::size_t points) {
  committed_.assign(points, state_of(initial_stress_));
  trial_ = committed_;
  answers_.assign(points, {});
  trial_answers_ = answers_;
  slips_.assign(points, 0.0);
}

template <int dim>
void SlipDrivenCone<dim>::set_initial_stress(std::size_t point, const Vector& stress) {
  committed_[point] = trial_[point] = state_of(stress);
}

template <int dim>
void SlipDrivenCone<dim>::set_slips(std::span<const double> increments) {
  std::ranges::copy(increments, slips_.begin());
}

template <int dim>
void SlipDrivenCone<dim>::answer(const State& start, const Vector& strain, double slip, State& end,
                                 Response<dim>& response, SlipAnswer<dim>& answer) const {
  const SubspaceModuli& moduli = frame_.moduli;
  const ScaledVector<double, dim> trial =
      start.stress + elastic_stress(moduli, ScaledVector<double, dim>(strain.cwiseProduct(scale_)));
  const Split<double, dim> split(trial);
  const double q_trial = deviatoric_stress(split, moduli);
  // A slip that neighbours bring may be more than the deviator; it is then used up.
  const bool used_up = slip > 0.0 && slip_stiffness() * slip >= q_trial;
  const bool follows = !used_up && q_trial > 0.0;  // the deviator has a direction, which slip goes along
  const double q = follows ? q_trial - slip_stiffness() * slip : 0.0;
  end = {trial, start.slip + slip};
  if (!std::isfinite(q_trial) || !std::isfinite(slip)) {
    end = start;
    response.stress = frame_.unscaled_stress(start.stress);
    response.quality = Quality::failed;
    response.message =
        "the trial stress is not a finite number; the increment of strain is broken or far too large";
    response.step_factor = 0.5;
    return;
  }
  const ScaledVector<double, dim> one = volumetric_vector<double, dim>();
  const Cone<double> cone = cone_(end.slip);
  const double swelling = moduli.bulk * (cone.dilatancy + slip * cone.dilatancy_slope);
  const double mean = split.mean - moduli.bulk * cone.dilatancy * slip;
  // The parts that the invariant feels shrink by one factor with the default weights; the skew one stays.
  const double retained = used_up ? 0.0 : follows ? q / q_trial : 1.0;
  std::array<double, 3> stiffness{};
  ScaledVector<double, dim> felt = ScaledVector<double, dim>::Zero();
  ScaledVector<double, dim> q_by_strain = ScaledVector<double, dim>::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const bool feels = moduli.return_stiffness(k) > 0.0;
    stiffness[k] = moduli.stiffness[k] * (feels ? std::max(retained, frame_.apex_stiffness_share) : 1.0);
    if (!feels) continue;
    felt += split.part[k];
    if (follows) q_by_strain += (1.5 / q_trial * moduli.weight[k] * moduli.stiffness[k]) * split.part[k];
  }
  end.stress += (retained - 1.0) * felt + (mean - split.mean) * one;

  ScaledMatrix<double, dim> tangent = subspace_matrix<double, dim>(stiffness, moduli.couples);
  add_volumetric(tangent, moduli.bulk);
  if (follows) tangent += ((1.0 - retained) / q_trial) * felt * q_by_strain.transpose();
  response.stress = frame_.unscaled_stress(end.stress);
  response.tangent = scale_.asDiagonal() * tangent * scale_.asDiagonal();

  answer.drive = cone.yield_function(q, mean);
  answer.scale = q + std::abs(cone.friction * mean) + cone.cohesion;
  answer.stress_by_slip =
      scale_.cwiseProduct((follows ? -slip_stiffness() / q_trial : 0.0) * felt - swelling * one);
  answer.drive_by_strain = scale_.cwiseProduct(q_by_strain + (cone.friction * moduli.bulk) * one);
  answer.drive_by_slip = (follows ? -slip_stiffness() : 0.0) - cone.friction * swelling +
                         cone.friction_slope * mean - cone.cohesion_slope;
}

template <int dim>
void SlipDrivenCone<dim>::evaluate(std::span<const Increment<dim>> increments,
                                   std::span<Response<dim>> responses) {
  for (std::size_t i = 0; i < committed_.size(); ++i) {
    const StretchAndTurn<dim> step = stretch_and_turn(increments[i]);
    SlipAnswer<dim>& own = trial_answers_[i];
    responses[i] = Response<dim>{};
    answer(committed_[i], step.stretch.strain(), slips_[i], trial_[i], responses[i], own);
    if (is_explicit_)
      responses[i].stress +=
          kDampingOfSteps * frame_.unscaled_stress(trial_[i].stress - committed_[i].stress);
    if (increments[i].configuration == Configuration::fixed) continue;
    trial_[i].stress = rotated(trial_[i].stress, step.turn);
    responses[i] = rotated(responses[i], step.turn);
    own.stress_by_slip = rotated(own.stress_by_slip, step.turn);
    own.drive_by_strain = rotated(own.drive_by_strain, step.turn);
  }
}

template <int dim>
void SlipDrivenCone<dim>::commit() {
  committed_ = trial_;
  answers_ = trial_answers_;
  std::ranges::fill(slips_, 0.0);
}

template <int dim>
void SlipDrivenCone<dim>::revert() {
  trial_ = committed_;
  trial_answers_ = answers_;
  std::ranges::fill(slips_, 0.0);
}

template <int dim>
void SlipDrivenCone<dim>::save(ArchiveWriter& archive) const {
  std::vector<double> values;
  values.reserve(committed_.size() * kKept<dim>);
  const auto add = [&](const auto& vector) { values.insert(values.end(), vector.begin(), vector.end()); };
  for (std::size_t i = 0; i < committed_.size(); ++i) {
    const SlipAnswer<dim>& answer = answers_[i];
    add(committed_[i].stress);
    add(answer.stress_by_slip);
    add(answer.drive_by_strain);
    add(std::array{committed_[i].slip, answer.drive, answer.scale, answer.drive_by_slip});
  }
  archive.write("states", std::span<const double>(values));
}

template <int dim>
void SlipDrivenCone<dim>::restore(ArchiveReader& archive) {
  const std::vector<double> values = read_lists(archive, "states", committed_.size(), kKept<dim>);
  auto next = values.begin();
  const auto take = [&](auto& vector) {
    for (double& value : vector) value = *next++;
  };
  for (std::size_t i = 0; i < committed_.size(); ++i) {
    SlipAnswer<dim>& answer = answers_[i];
    take(committed_[i].stress);
    take(answer.stress_by_slip);
    take(answer.drive_by_strain);
    for (double* value : {&committed_[i].slip, &answer.drive, &answer.scale, &answer.drive_by_slip})
      *value = *next++;
  }
  revert();
}

template <int dim>
void SlipDrivenCone<dim>::fields(std::size_t point, std::span<double> values) const {
  const SlipAnswer<dim>& answer = answers_[point];
  values[0] = committed_[point].slip;
  values[1] = answer.scale > 0.0 ? answer.drive / answer.scale : 0.0;
}

template std::vector<std::string> slip_faults<2>(const ElastoplasticParameters<2>&);
template std::vector<std::string> slip_faults<3>(const ElastoplasticParameters<3>&);
template class SlipDrivenCone<2>;
template class SlipDrivenCone<3>;

}  // namespace polargrain::fem
