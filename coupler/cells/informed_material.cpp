// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/informed_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.hpp"
#include "common/record_table.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cell_limits.hpp"
#include "coupler/cells/cell_noise.hpp"
#include "coupler/cells/lent_stress.hpp"
#include "coupler/cells/successive.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// A cell follows a step in at most so many parts.
constexpr int kMostParts = 16;

/// @param part 0 to parts - 1
template <int dim>
Increment<dim> part_of(Increment<dim> increment, int part, int parts) {
  if (increment.configuration != Configuration::fixed && parts > 1)
    return offset_between(share_of(increment, static_cast<double>(part) / parts),
                          share_of(increment, static_cast<double>(part + 1) / parts));
  increment.displacement_gradient /= parts;
  micro_rotation(increment) /= parts;
  increment.curvature /= parts;
  return increment;
}

/// The same return with friction as a straight line through its values at both ends of the step: stress and
/// state stay, the tangent sees the hardening. A frozen cone alone would let Newton's method overshoot.
template <int dim>
void add_hardening(const fem::ElastoplasticFrame<dim>& frame, const fem::FrozenCone& before,
                   const fem::FrozenCone& after, const fem::ElastoplasticState<dim>& start,
                   const Increment<dim>& increment, const fem::ElastoplasticState<dim>& end,
                   Response<dim>& response) {
  const double step = end.gamma_p - start.gamma_p;
  if (end.regime != fem::Regime::smooth || !(step > 1e-12 * (1.0 + end.gamma_p)) ||
      before.friction == after.friction)
    return;
  using fem::PiecewiseLinear;
  const fem::HardeningCone cone{
      PiecewiseLinear({{start.gamma_p, before.friction},
                       {start.gamma_p + 2.0 * step, 2.0 * after.friction - before.friction}}),
      PiecewiseLinear(after.dilatancy), PiecewiseLinear(after.cohesion)};
  fem::ElastoplasticState<dim> same;
  const Response<dim> hardening = fem::integrate_elastoplastic(frame, cone, start, increment, same);
  if (hardening.quality == Quality::good && same.regime == fem::Regime::smooth) {
    response.tangent = hardening.tangent;
  }
}

/// Mean of the three normal stresses.
double mean_stress(const Vector7& stress) {
  return stress.head<3>().sum() / 3.0;
}
double mean_stress(const Vector18& stress) {
  return -pressure_of<3>(stress);
}

/// Square of the symmetric stress, in the plane without s33.
double symmetric_square(const Vector7& s) {
  const double shear = 0.5 * (s(k12) + s(k21)) * (s(k12) + s(k21));
  return s(k11) * s(k11) + s(k22) * s(k22) + shear;
}
double symmetric_square(const Vector18& s) {
  return symmetric_part<3>(s).squaredNorm();
}

/// The limits of skew and couple stress are those of the plane, of spheres too.
CellLimits limits_in_plane(const CellCalls<2>& calls, const PlaneReply& packing, double mean_diameter) {
  return limits_of(calls, packing, mean_diameter);
}
CellLimits limits_in_plane(const CellCalls<3>& calls, const PointReply<3>& packing, double mean_diameter) {
  return limits_of(in_plane(calls), in_plane(packing), mean_diameter);
}

/// The angle of a turn, rad, not negative.
double size_of_turn(const Increment<2>&, double turn) {
  return std::abs(turn);
}
double size_of_turn(const Increment<3>& increment, const Eigen::Matrix3d&) {
  return increment.configuration == Configuration::fixed ? 0.0 : turn_of(increment);
}

/// A step may turn a point by so much, rad: a law far from its skew strain has other balances than the one meant.
constexpr double kLargestTurn = 0.5;

template <int dim>
Response<dim> turned_too_far(double angle) {
  Response<dim> response;
  response.quality = Quality::failed;
  response.step_factor = 0.5;
  response.message = fmt::format("the step turns the point by {:.2g} rad at once; at most {} is taken",
                                 std::abs(angle), kLargestTurn);
  return response;
}

/// The answer of a law, and where the law is, turned to the axes of the end of a step.
template <int dim>
Response<dim> turned(const Response<dim>& response, fem::ElastoplasticState<dim>& end,
                     const fem::Turn<dim>& turn) {
  end.scaled_stress = fem::rotated(end.scaled_stress, turn);
  return fem::rotated<dim>(response, turn);
}

}  // namespace

template <int dim>
void InformedParameters<dim>::set_moduli(const CosseratParameters& cosserat) {
  elastic.young_modulus = 2.0 * cosserat.shear_modulus * (1.0 + elastic.poisson_ratio);
  elastic.cosserat_shear_modulus = cosserat.cosserat_shear_modulus;
  elastic.internal_length = cosserat.internal_length;
  plastic_length = cosserat.plastic_length;
  skew_limit = cosserat.skew_limit;
}

template <int dim>
InformedMaterial<dim>::InformedMaterial(CellCalls<dim> calls, const InformedParameters<dim>& parameters,
                                        const std::string& note, CellCalls<dim> with_tangent)
    : calls_(std::move(calls)),
      with_tangent_(std::move(with_tangent)),
      at_limits_(parameters.mean_diameter == 0.0),
      parameters_(parameters),
      frame_{fem::SubspaceModuli(parameters.elastic, parameters.weights.value_or(fem::InvariantWeights{})),
             parameters.elastic.internal_length, 1e-3} {
  if (!note.empty()) notes_.push_back(note);
  const fem::ElasticParameters<dim>& elastic = parameters.elastic;
  own_rules_ = {
      {elastic.young_modulus / (2.0 * (1.0 + elastic.poisson_ratio)), elastic.cosserat_shear_modulus,
       elastic.internal_length, parameters.plastic_length, parameters.skew_limit},
      controlled(),
      elastic.internal_length,
      parameters.mobilisation.drift_shear};
}

template <int dim>
void InformedMaterial<dim>::allocate(std::size_t points) {
  const PointReply<dim> packing = packing_at_rest(calls_, notes_);
  if (controlled() && !parameters_.weights) {
    const CellLimits limits = limits_in_plane(calls_, packing, parameters_.mean_diameter);
    const fem::InvariantWeights weights = limits.weights(parameters_.elastic.internal_length);
    frame_.moduli = fem::SubspaceModuli(parameters_.elastic, weights);
    notes_.push_back(fmt::format("limits of the packing: {}; invariants [{:.4g}, {:.4g}, {:.4g}]",
                                 limits.text(), weights.a1, weights.a2, weights.a3));
  }
  own_rules_.packing = PackingAtStart<dim>(packing);
  PointState start;
  start.cell = packing;
  Vector stress = packing.response.stress;
  if constexpr (dim == 2) {
    if (!packing.knows_s33) stress(k33) = 0.5 * (stress(k11) + stress(k22));
  }
  start.law.scaled_stress = complete_cell_stress(stress, stress);
  start.mobilisation = fem::initial_mobilisation<dim>(parameters_.mobilisation);
  // A packing at rest under unequal stresses has mobilised that friction already. The margin is for rounding: at rest it is
  // elastic.
  fem::FrozenCone& cone = start.mobilisation.cone;
  if (const auto at_rest = fem::cone_friction<dim>(frame_.moduli, start.law.scaled_stress, cone.cohesion))
    cone.friction = std::max(cone.friction, *at_rest * (1.0 + 1e-9));
  start.held_friction = start.mobilisation.cone.friction;
  committed_.assign(points, start);
  trial_ = committed_;
  increments_.assign(points, Increment<dim>{});
}

template <int dim>
Increment<dim> InformedMaterial<dim>::felt(const Increment<dim>& increment) const {
  return controlled() ? increment_for_cell(increment) : increment_for_free_cell(increment);
}

template <int dim>
void InformedMaterial<dim>::evaluate(std::span<const Increment<dim>> increments,
                                     std::span<Response<dim>> responses) {
  increments_.assign(increments.begin(), increments.end());
  if (parameters_.update == InformedUpdate::frozen) {
    evaluate_frozen(increments, responses);
  } else {
    evaluate_fixed_point(increments, responses);
  }
  limit_skew_of_laws(responses);
  if (may_change()) evaluate_own(increments, responses);
}

template <int dim>
void InformedMaterial<dim>::limit_skew_of_laws(std::span<Response<dim>> responses) {
  if (controlled() || !parameters_.skew_limit) return;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    Response<dim>& response = responses[point];
    if (committed_[point].own.active || response.quality == Quality::failed) continue;
    if (limit_skew<dim>(response, *parameters_.skew_limit, parameters_.elastic.cosserat_shear_modulus))
      trial_[point].law.scaled_stress = scaled_stress(response.stress);
  }
}

template <int dim>
void InformedMaterial<dim>::evaluate_own(std::span<const Increment<dim>> increments,
                                         std::span<Response<dim>> responses) {
  std::vector<PointRequest<dim>> requests;
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    if (!committed_[point].own.active || is_zero(increments[point])) continue;
    requests.push_back({committed_[point].cell.state, felt(increments[point])});
    points.push_back(point);
  }
  if (!points.empty()) {
    std::vector<PointReply<dim>> replies = with_tangent_.evaluate(requests, points);
    for (std::size_t r = 0; r < replies.size(); ++r) trial_[points[r]].cell = std::move(replies[r]);
  }
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    const OwnAnswer<dim>& before = committed_[point].own;
    if (!before.active) continue;
    PointState& trial = trial_[point];
    responses[point] = own_answer(own_rules_, before, increments[point], trial.cell, trial.own);
    responses[point].noise = noise_of(trial.cell, 0.5 * parameters_.mean_diameter);
    trial.law.scaled_stress = scaled_stress(responses[point].stress);
  }
}

template <int dim>
fem::ElastoplasticFrame<dim> InformedMaterial<dim>::frame_of(std::size_t point) const {
  fem::ElastoplasticFrame<dim> frame = frame_;
  if (parameters_.plastic_length) {
    // The friction at the start of the step: within it the weight stands still, and the tangent is exact.
    frame.moduli.weight[2] = couple_weight(committed_[point].mobilisation.cone.friction, frame_.length,
                                           *parameters_.plastic_length);
  }
  return frame;
}

template <int dim>
Response<dim> InformedMaterial<dim>::integrate_unloading(const fem::ElastoplasticFrame<dim>& frame,
                                                         const fem::Mobilisation<dim>& mobilisation,
                                                         const fem::ElastoplasticState<dim>& start,
                                                         const Increment<dim>& increment,
                                                         fem::ElastoplasticState<dim>& end) const {
  Vector scale = Vector::Ones();
  scale.template tail<Cosserat<dim>::couples>().setConstant(frame.length);
  Vector unscale = Vector::Ones();
  unscale.template tail<Cosserat<dim>::couples>().setConstant(frame.length > 0.0 ? 1.0 / frame.length : 0.0);
  const fem::UnloadingMode::Felt<dim> felt = mobilisation.unloading->template felt<dim>(
      increment.strain().cwiseProduct(scale), controlled() ? 3 : 1);
  const fem::FrozenCone& cone = mobilisation.cone;
  Response<dim> response =
      fem::integrate_elastoplastic(frame,
                                   {fem::PiecewiseLinear(cone.friction), fem::PiecewiseLinear(cone.dilatancy),
                                    fem::PiecewiseLinear(cone.cohesion)},
                                   start, Vector(felt.strain.cwiseProduct(unscale)), end);
  response.tangent *= unscale.asDiagonal() * felt.slope * scale.asDiagonal();
  return response;
}

template <int dim>
Response<dim> InformedMaterial<dim>::integrate(std::size_t point, const Increment<dim>& increment) {
  const fem::StretchAndTurn<dim> step = fem::stretch_and_turn(increment);
  if (const double angle = size_of_turn(increment, step.turn); angle > kLargestTurn)
    return turned_too_far<dim>(angle);
  fem::ElastoplasticState<dim>& end = trial_[point].law;
  const Response<dim> response = integrate_stretch(point, step.stretch, end);
  return increment.configuration == Configuration::fixed ? response : turned<dim>(response, end, step.turn);
}

template <int dim>
Response<dim> InformedMaterial<dim>::integrate_stretch(std::size_t point, const Increment<dim>& increment,
                                                       fem::ElastoplasticState<dim>& end) const {
  const PointState& before = committed_[point];
  const fem::FrozenCone& cone = before.mobilisation.cone;
  const fem::ElastoplasticState<dim>& start = before.law;
  const fem::ElastoplasticFrame<dim> frame = frame_of(point);
  if (before.mobilisation.unloading)
    return integrate_unloading(frame, before.mobilisation, start, increment, end);
  if (before.held_friction != cone.friction && before.take_up > 1e-12 * (1.0 + start.gamma_p)) {
    using fem::PiecewiseLinear;
    const fem::HardeningCone taken_up{PiecewiseLinear({{start.gamma_p, before.held_friction},
                                                       {start.gamma_p + before.take_up, cone.friction}}),
                                      PiecewiseLinear(cone.dilatancy), PiecewiseLinear(cone.cohesion)};
    Response<dim> response = fem::integrate_elastoplastic(frame, taken_up, start, increment, end);
    if (response.quality == Quality::good) return response;
  }
  // Nothing to take up, or softening too steep to have one answer: at once.
  return fem::integrate_elastoplastic(frame, cone, start, increment, end);
}

template <int dim>
Response<dim> InformedMaterial<dim>::integrate_updated(std::size_t point, const Increment<dim>& stretch,
                                                       const fem::Mobilisation<dim>& mobilisation,
                                                       fem::ElastoplasticState<dim>& end) const {
  const fem::ElastoplasticState<dim>& start = committed_[point].law;
  const fem::ElastoplasticFrame<dim> frame = frame_of(point);
  if (mobilisation.unloading) return integrate_unloading(frame, mobilisation, start, stretch, end);
  Response<dim> response = fem::integrate_elastoplastic(frame, mobilisation.cone, start, stretch, end);
  add_hardening(frame, committed_[point].mobilisation.cone, mobilisation.cone, start, stretch, end, response);
  return response;
}

template <int dim>
void InformedMaterial<dim>::evaluate_frozen(std::span<const Increment<dim>> increments,
                                            std::span<Response<dim>> responses) {
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    trial_[point] = committed_[point];
    if (!committed_[point].own.active) responses[point] = integrate(point, increments[point]);
  }
}

template <int dim>
void InformedMaterial<dim>::evaluate_fixed_point(std::span<const Increment<dim>> increments,
                                                 std::span<Response<dim>> responses) {
  // With the cone of the last step it shows which points yield at all.
  evaluate_frozen(increments, responses);
  std::vector<PointRequest<dim>> requests;
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    if (committed_[point].own.active || is_zero(increments[point]) ||
        responses[point].quality == Quality::failed)
      continue;
    requests.push_back({committed_[point].cell.state, felt(increments[point])});
    points.push_back(point);
  }
  if (points.empty()) return;
  const std::vector<PointReply<dim>> replies = calls_.evaluate(requests, points);
  for (std::size_t r = 0; r < replies.size(); ++r) {
    const std::size_t point = points[r];
    const Response<dim>& cell = replies[r].response;
    if (cell.quality != Quality::failed) {
      take(replies[r], increments[point], point);
      const fem::StretchAndTurn<dim> step = fem::stretch_and_turn(increments[point]);
      Response<dim>& response = responses[point];
      fem::ElastoplasticState<dim>& end = trial_[point].law;
      // The mobilisation has turned already; nothing that the law takes of it has a direction.
      response = integrate_updated(point, step.stretch, trial_[point].mobilisation, end);
      if (increments[point].configuration != Configuration::fixed)
        response = turned<dim>(response, end, step.turn);
      // Where the point yields its stress goes with the friction read from the cell, and scatters with it.
      if (end.regime != fem::Regime::elastic)
        response.noise = noise_of(trial_[point].cell, 0.5 * parameters_.mean_diameter);
    }
    if (cell.quality < responses[point].quality) {
      responses[point].quality = cell.quality;
      responses[point].message = cell.message;
      responses[point].step_factor = cell.step_factor;
    }
  }
}

template <int dim>
void InformedMaterial<dim>::commit() {
  if (parameters_.update == InformedUpdate::frozen) {
    std::vector<std::size_t> points;
    for (std::size_t point = 0; point < committed_.size(); ++point) {
      if (!committed_[point].own.active && !is_zero(increments_[point])) points.push_back(point);
    }
    follow(calls_, points);
  }
  watch_mismatch();
  std::vector<StatePointer*> states;
  for (PointState& point : trial_) states.push_back(&point.cell.state);
  collect(calls_, states);
  committed_ = trial_;
  count_limits();
}

template <int dim>
CosseratPart<dim> InformedMaterial<dim>::cosserat_part_of(const PointState& point) const {
  if (point.own.active) return point.own.cosserat;
  const Vector stress = frame_.unscaled_stress(point.law.scaled_stress);
  CosseratPart<dim> part;
  part.skew_stress = skew_stress_of<dim>(stress);
  part.couple_stress = stress.template tail<Cosserat<dim>::couples>();
  part.pressures = pressures_of<dim>(stress);
  return part;
}

template <int dim>
LimitsReached InformedMaterial<dim>::reached(const PointState& point) const {
  const double least = own_rules_.packing.least_pressure();
  LimitsReached reached;
  if (!controlled()) reached = cosserat_part_of(point).reached(own_rules_.cosserat, least);
  reached.parted = pressure_of<dim>(point.cell.response.stress) <= least;
  return reached;
}

template <int dim>
void InformedMaterial<dim>::count_limits() {
  std::vector<LimitsReached> points;
  for (const PointState& point : committed_) points.push_back(reached(point));
  at_limits_.count(points);
}

template <int dim>
void InformedMaterial<dim>::leave_laws() {
  std::vector<std::size_t> leaving;
  for (std::size_t point = 0; point < trial_.size(); ++point) {
    if (has_left_cell(trial_[point]) && !is_zero(increments_[point])) leaving.push_back(point);
  }
  // Once more, for the tangent: from now on Newton's method needs it.
  follow(with_tangent_, leaving);
  for (const std::size_t point : leaving) {
    PointState& trial = trial_[point];
    trial.own = left_law(own_rules_, frame_.unscaled_stress(trial.law.scaled_stress), trial.cell);
  }
}

template <int dim>
void InformedMaterial<dim>::watch_mismatch() {
  if (told_of_mismatch_ && !may_change()) return;
  std::string left = left_cells(trial_);
  if (left.empty()) return;
  if (may_change()) left += "; such points go by the stress of their cells from the next step on";
  if (!told_of_mismatch_) notes_.push_back(left);
  told_of_mismatch_ = true;
  if (may_change()) leave_laws();
}

template <int dim>
bool InformedMaterial<dim>::has_left_cell(const PointState& point) const {
  return !point.own.active && mismatch(point) > parameters_.mismatch_limit;
}

template <int dim>
std::string InformedMaterial<dim>::doubt() const {
  return left_cells(committed_);
}

template <int dim>
std::string InformedMaterial<dim>::left_cells(const std::vector<PointState>& points) const {
  std::size_t left = 0;
  std::size_t worst = 0;
  double largest = 0.0;
  for (std::size_t point = 0; point < points.size(); ++point) {
    if (!has_left_cell(points[point])) continue;
    const double found = mismatch(points[point]);
    ++left;
    if (found > largest) worst = point, largest = found;
  }
  if (left == 0) return {};
  return fmt::format(
      "the law has left its cell at {} of {} points: their stresses differ by more than {:.0f} % (mismatch_limit), by {:.0f} % "
      "at point {} of the region",
      left, points.size(), 100.0 * parameters_.mismatch_limit, 100.0 * largest, worst);
}

template <int dim>
void InformedMaterial<dim>::follow(const CellCalls<dim>& calls, std::span<const std::size_t> points) {
  std::vector<std::size_t> pending(points.begin(), points.end());
  std::vector<PointReply<dim>> last(committed_.size());
  for (int parts = 1; !pending.empty(); parts *= 2) {
    if (parts > kMostParts) {
      throw RunError(
          fmt::format("the cell of point {} cannot follow a step of its material, even in {} parts: {}; take "
                      "smaller steps, or update: fixed_point, which cuts steps for its cells",
                      pending.front(), kMostParts, last[pending.front()].response.message));
    }
    for (const std::size_t point : pending)
      last[point] = PointReply<dim>{{}, true, {}, committed_[point].cell.state};
    std::vector<std::size_t> following = pending;
    for (int part = 0; part < parts && !following.empty(); ++part) {
      std::vector<PointRequest<dim>> requests;
      for (const std::size_t point : following) {
        requests.push_back({last[point].state, part_of(felt(increments_[point]), part, parts)});
      }
      std::vector<PointReply<dim>> replies = calls.evaluate(requests, following);
      for (std::size_t r = 0; r < replies.size(); ++r) {
        replies[r].diagnostics.dem_steps += last[following[r]].diagnostics.dem_steps;
        last[following[r]] = std::move(replies[r]);
      }
      const auto gone = [&](std::size_t point) { return last[point].response.quality != Quality::good; };
      std::erase_if(following, gone);
    }
    for (const std::size_t point : following) take(last[point], increments_[point], point);
    std::erase_if(pending, [&](std::size_t point) { return last[point].response.quality == Quality::good; });
  }
}

template <int dim>
void InformedMaterial<dim>::take(const PointReply<dim>& reply, const Increment<dim>& increment,
                                 std::size_t point) {
  PointState& trial = trial_[point];
  const PointState& before = committed_[point];
  const bool turns = increment.configuration != Configuration::fixed;
  const fem::StretchAndTurn<dim> motion = fem::stretch_and_turn(increment);
  // All in the axes of the start of the step. The pressures of the law, which are all that is lent, are in any.
  const Vector& answer = reply.response.stress;
  const Vector after = turns ? Vector(fem::rotated(answer, fem::inverse(motion.turn))) : answer;
  const fem::ScaledVector<double, dim>& law = trial.law.scaled_stress;
  const fem::MicroStep<dim> step{scaled_strain(motion.stretch),
                                 complete_cell_stress(before.cell.response.stress, before.law.scaled_stress),
                                 complete_cell_stress(after, law), mean_stress(law),
                                 trial.law.regime == fem::Regime::smooth};
  trial.mobilisation = fem::advance(before.mobilisation, step, frame_.moduli, parameters_.mobilisation);
  if (turns) trial.mobilisation = fem::rotated<dim>(std::move(trial.mobilisation), motion.turn);
  const bool frozen = parameters_.update == InformedUpdate::frozen;
  trial.held_friction = (frozen ? committed_[point] : trial).mobilisation.cone.friction;
  trial.take_up = trial.law.gamma_p - committed_[point].law.gamma_p;
  trial.cell = reply;
}

template <int dim>
fem::ScaledVector<double, dim> InformedMaterial<dim>::scaled_strain(const Increment<dim>& stretch) const {
  if (!controlled()) return symmetric_part<dim>(stretch.strain());
  Vector strain = stretch.strain();
  strain.template tail<Cosserat<dim>::couples>() *= frame_.length;
  return strain;
}

template <int dim>
fem::ScaledVector<double, dim> InformedMaterial<dim>::complete_cell_stress(
    const Vector& cell, const fem::ScaledVector<double, dim>& law) const {
  fem::ScaledVector<double, dim> scaled = controlled() ? cell : symmetric_part<dim>(cell);
  if (controlled()) scaled.template tail<Cosserat<dim>::couples>() /= frame_.length;
  return with_lent_stress<dim>(scaled, law);
}

template <int dim>
fem::ScaledVector<double, dim> InformedMaterial<dim>::scaled_stress(const Vector& stress) const {
  fem::ScaledVector<double, dim> scaled = stress;
  if (frame_.length > 0.0) scaled.template tail<Cosserat<dim>::couples>() /= frame_.length;
  return scaled;
}

template <int dim>
double InformedMaterial<dim>::mismatch(const PointState& point) const {
  const auto norm = [this](const fem::ScaledVector<double, dim>& s) {
    const double skew =
        0.5 * skew_stress_of<dim>(s).squaredNorm() + s.template tail<Cosserat<dim>::couples>().squaredNorm();
    return std::sqrt(symmetric_square(s) + (controlled() ? skew : 0.0));
  };
  const double size = norm(point.law.scaled_stress);
  const double difference = norm(point.law.scaled_stress -
                                 complete_cell_stress(point.cell.response.stress, point.law.scaled_stress));
  return size > 0.0 ? difference / size : difference;
}

template <int dim>
std::vector<std::string> InformedMaterial<dim>::field_names() const {
  std::vector<std::string> own{"friction",      "dilatancy", "dilatancy_limited",
                               "plastic_shear", "regime",    "stress_mismatch"};
  if (may_change()) own.emplace_back("stress_of_cell");
  return joined_names(joined_names(own, names_of_columns<CellDiagnostics>()),
                      names_of_limit_fields(!controlled()));
}

template <int dim>
void InformedMaterial<dim>::fields(std::size_t point, std::span<double> values) const {
  const PointState& p = committed_[point];
  std::vector<double> own{p.mobilisation.cone.friction,       p.mobilisation.cone.dilatancy,
                          p.mobilisation.limited ? 1.0 : 0.0, p.law.gamma_p,
                          static_cast<double>(p.law.regime),  mismatch(p)};
  if (may_change()) own.push_back(p.own.active ? 1.0 : 0.0);
  auto rest = std::ranges::copy(own, values.begin()).out;
  rest = std::ranges::copy(values_of(p.cell.diagnostics), rest).out;
  if (controlled()) {
    write_limit_fields(reached(p), std::nullopt, CosseratPart<dim>{}, rest);
  } else {
    write_limit_fields(reached(p), own_rules_.cosserat, cosserat_part_of(p), rest);
  }
}

template struct InformedParameters<2>;
template struct InformedParameters<3>;
template class InformedMaterial<2>;
template class InformedMaterial<3>;

}  // namespace polargrain::coupler
