// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/informed_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.hpp"
#include "common/packed_values.hpp"
#include "common/record_archive.hpp"
#include "common/record_table.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cell_limits.hpp"
#include "coupler/cells/cell_noise.hpp"
#include "coupler/cells/successive.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// A cell follows a step in at most so many parts.
constexpr int kMostParts = 16;

/// @param part 0 to parts - 1
Increment<2> part_of(Increment<2> increment, int part, int parts) {
  if (increment.configuration != Configuration::fixed && parts > 1)
    return offset_between(share_of(increment, static_cast<double>(part) / parts),
                          share_of(increment, static_cast<double>(part + 1) / parts));
  increment.displacement_gradient /= parts;
  increment.micro_rotation /= parts;
  increment.curvature /= parts;
  return increment;
}

/// The same return with friction as a straight line through its values at both ends of the step: stress and
/// state stay, the tangent sees the hardening. A frozen cone alone would let Newton's method overshoot.
void add_hardening(const fem::ElastoplasticFrame<2>& frame, const fem::FrozenCone& before,
                   const fem::FrozenCone& after, const fem::ElastoplasticState<2>& start,
                   const Increment<2>& increment, const fem::ElastoplasticState<2>& end,
                   Response<2>& response) {
  const double step = end.gamma_p - start.gamma_p;
  if (end.regime != fem::Regime::smooth || !(step > 1e-12 * (1.0 + end.gamma_p)) ||
      before.friction == after.friction)
    return;
  using fem::PiecewiseLinear;
  const fem::HardeningCone cone{
      PiecewiseLinear({{start.gamma_p, before.friction},
                       {start.gamma_p + 2.0 * step, 2.0 * after.friction - before.friction}}),
      PiecewiseLinear(after.dilatancy), PiecewiseLinear(after.cohesion)};
  fem::ElastoplasticState<2> same;
  const Response<2> hardening = fem::integrate_elastoplastic(frame, cone, start, increment, same);
  if (hardening.quality == Quality::good && same.regime == fem::Regime::smooth) {
    response.tangent = hardening.tangent;
  }
}

/// A step may turn a point by so much, rad: a law far from its skew strain has other balances than the one meant.
constexpr double kLargestTurn = 0.5;

Response<2> turned_too_far(double angle) {
  Response<2> response;
  response.quality = Quality::failed;
  response.step_factor = 0.5;
  response.message = fmt::format("the step turns the point by {:.2g} rad at once; at most {} is taken",
                                 std::abs(angle), kLargestTurn);
  return response;
}

/// The answer of a law, and where the law is, turned to the axes of the end of a step.
Response<2> turned(const Response<2>& response, fem::ElastoplasticState<2>& end, double angle) {
  end.scaled_stress = fem::rotated(end.scaled_stress, angle);
  return fem::rotated(response, angle);
}

/// Walks over the numbers of a point, writing or reading them.
struct Packer {
  std::vector<double>& values;
  void operator()(double& value) const { values.push_back(value); }
};
struct Unpacker {
  std::span<const double> values;
  std::size_t next = 0;
  void operator()(double& value) { value = values[next++]; }
};

/// Through a double: exact for flags, and for counts below 2^53.
template <class Visitor, class Whole>
void visit_whole(Visitor& visit, Whole& whole) {
  auto value = static_cast<double>(whole);
  visit(value);
  whole = static_cast<Whole>(value);
}

template <class Visitor, class Vector>
void visit_vector(Visitor& visit, Vector& vector) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) visit(vector(i));
}

template <class Visitor>
void visit_samples(Visitor& visit, std::vector<fem::Mobilisation::Sample>& samples, int window) {
  std::size_t count = samples.size();
  visit_whole(visit, count);
  samples.resize(static_cast<std::size_t>(window) + 1);  // always as many values a point
  for (fem::Mobilisation::Sample& sample : samples) {
    visit(sample.deformation);
    visit_vector(visit, sample.plastic_strain);
  }
  samples.resize(count);
}

}  // namespace

/// All numbers of law and mobilisation, always in the same order and as many.
template <class Visitor>
void InformedMaterial::visit_numbers(Visitor& visit, PointState& point, int window) {
  visit_vector(visit, point.law.scaled_stress);
  visit(point.law.gamma_p);
  visit(point.held_friction);
  visit(point.take_up);
  visit_whole(visit, point.law.regime);
  fem::Mobilisation& m = point.mobilisation;
  for (double* value : {&m.cone.friction, &m.cone.dilatancy, &m.cone.cohesion, &m.micro_friction})
    visit(*value);
  visit_whole(visit, m.limited);
  visit_samples(visit, m.samples, window);
  bool unloaded = m.unloading.has_value();
  fem::UnloadingMode unloading = m.unloading.value_or(fem::UnloadingMode{});
  visit_whole(visit, unloaded);
  visit(unloading.stiffness);
  visit(unloading.contraction);
  m.unloading = unloaded ? std::optional(unloading) : std::nullopt;
}

void InformedParameters::set_moduli(const CosseratParameters& cosserat) {
  elastic.young_modulus = 2.0 * cosserat.shear_modulus * (1.0 + elastic.poisson_ratio);
  elastic.cosserat_shear_modulus = cosserat.cosserat_shear_modulus;
  elastic.internal_length = cosserat.internal_length;
  plastic_length = cosserat.plastic_length;
  skew_limit = cosserat.skew_limit;
}

InformedMaterial::InformedMaterial(CellCalls calls, const InformedParameters& parameters,
                                   const std::string& note, CellCalls with_tangent)
    : calls_(std::move(calls)),
      with_tangent_(std::move(with_tangent)),
      at_limits_(parameters.mean_diameter == 0.0),
      parameters_(parameters),
      frame_{fem::SubspaceModuli(parameters.elastic, parameters.weights.value_or(fem::InvariantWeights{})),
             parameters.elastic.internal_length, 1e-3} {
  if (!note.empty()) notes_.push_back(note);
  const fem::ElasticParameters<2>& elastic = parameters.elastic;
  own_rules_ = {
      {elastic.young_modulus / (2.0 * (1.0 + elastic.poisson_ratio)), elastic.cosserat_shear_modulus,
       elastic.internal_length, parameters.plastic_length, parameters.skew_limit},
      controlled(),
      elastic.internal_length,
      parameters.mobilisation.drift_shear};
}

void InformedMaterial::allocate(std::size_t points) {
  const PlaneReply packing = packing_at_rest(calls_, notes_);
  if (controlled() && !parameters_.weights) {
    const CellLimits limits = limits_of(calls_, packing, parameters_.mean_diameter);
    const fem::InvariantWeights weights = limits.weights(parameters_.elastic.internal_length);
    frame_.moduli = fem::SubspaceModuli(parameters_.elastic, weights);
    notes_.push_back(fmt::format("limits of the packing: {}; invariants [{:.4g}, {:.4g}, {:.4g}]",
                                 limits.text(), weights.a1, weights.a2, weights.a3));
  }
  own_rules_.packing = PackingAtStart(packing);
  PointState start;
  start.cell = packing;
  Vector7 stress = packing.response.stress;
  if (!packing.knows_s33) stress(k33) = 0.5 * (stress(k11) + stress(k22));
  start.law.scaled_stress = complete_cell_stress(stress, stress);
  start.mobilisation = fem::initial_mobilisation(parameters_.mobilisation);
  start.held_friction = start.mobilisation.cone.friction;
  committed_.assign(points, start);
  trial_ = committed_;
  increments_.assign(points, Increment<2>{});
}

Increment<2> InformedMaterial::felt(const Increment<2>& increment) const {
  return controlled() ? increment_for_cell(increment) : increment_for_free_cell(increment);
}

void InformedMaterial::evaluate(std::span<const Increment<2>> increments, std::span<Response<2>> responses) {
  increments_.assign(increments.begin(), increments.end());
  if (parameters_.update == InformedUpdate::frozen) {
    evaluate_frozen(increments, responses);
  } else {
    evaluate_fixed_point(increments, responses);
  }
  limit_skew_of_laws(responses);
  if (may_change()) evaluate_own(increments, responses);
}

void InformedMaterial::limit_skew_of_laws(std::span<Response<2>> responses) {
  if (controlled() || !parameters_.skew_limit) return;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    Response<2>& response = responses[point];
    if (committed_[point].own.active || response.quality == Quality::failed) continue;
    if (limit_skew(response, *parameters_.skew_limit, parameters_.elastic.cosserat_shear_modulus))
      trial_[point].law.scaled_stress = scaled_stress(response.stress);
  }
}

void InformedMaterial::evaluate_own(std::span<const Increment<2>> increments,
                                    std::span<Response<2>> responses) {
  std::vector<PlaneRequest> requests;
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    if (!committed_[point].own.active || is_zero(increments[point])) continue;
    requests.push_back({committed_[point].cell.state, felt(increments[point])});
    points.push_back(point);
  }
  if (!points.empty()) {
    std::vector<PlaneReply> replies = with_tangent_.evaluate(requests, points);
    for (std::size_t r = 0; r < replies.size(); ++r) trial_[points[r]].cell = std::move(replies[r]);
  }
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    const OwnAnswer& before = committed_[point].own;
    if (!before.active) continue;
    PointState& trial = trial_[point];
    responses[point] = own_answer(own_rules_, before, increments[point], trial.cell, trial.own);
    responses[point].noise = noise_of(trial.cell, 0.5 * parameters_.mean_diameter);
    trial.law.scaled_stress = scaled_stress(responses[point].stress);
  }
}

fem::ElastoplasticFrame<2> InformedMaterial::frame_of(std::size_t point) const {
  fem::ElastoplasticFrame<2> frame = frame_;
  if (parameters_.plastic_length) {
    // The friction at the start of the step: within it the weight stands still, and the tangent is exact.
    frame.moduli.weight[2] = couple_weight(committed_[point].mobilisation.cone.friction, frame_.length,
                                           *parameters_.plastic_length);
  }
  return frame;
}

Response<2> InformedMaterial::integrate_unloading(const fem::ElastoplasticFrame<2>& frame,
                                                  const fem::Mobilisation& mobilisation,
                                                  const fem::ElastoplasticState<2>& start,
                                                  const Increment<2>& increment,
                                                  fem::ElastoplasticState<2>& end) const {
  Vector7 scale = Vector7::Ones();
  scale.tail<2>().setConstant(frame.length);
  Vector7 unscale = Vector7::Ones();
  unscale.tail<2>().setConstant(frame.length > 0.0 ? 1.0 / frame.length : 0.0);
  const fem::UnloadingMode::Felt felt =
      mobilisation.unloading->felt(increment.strain().cwiseProduct(scale), controlled() ? 3 : 1);
  const fem::FrozenCone& cone = mobilisation.cone;
  Response<2> response =
      fem::integrate_elastoplastic(frame,
                                   {fem::PiecewiseLinear(cone.friction), fem::PiecewiseLinear(cone.dilatancy),
                                    fem::PiecewiseLinear(cone.cohesion)},
                                   start, Vector7(felt.strain.cwiseProduct(unscale)), end);
  response.tangent *= unscale.asDiagonal() * felt.slope * scale.asDiagonal();
  return response;
}

Response<2> InformedMaterial::integrate(std::size_t point, const Increment<2>& increment) {
  const fem::StretchAndTurn<2> step = fem::stretch_and_turn(increment);
  if (std::abs(step.turn) > kLargestTurn) return turned_too_far(step.turn);
  fem::ElastoplasticState<2>& end = trial_[point].law;
  const Response<2> response = integrate_stretch(point, step.stretch, end);
  return increment.configuration == Configuration::fixed ? response : turned(response, end, step.turn);
}

Response<2> InformedMaterial::integrate_stretch(std::size_t point, const Increment<2>& increment,
                                                fem::ElastoplasticState<2>& end) const {
  const PointState& before = committed_[point];
  const fem::FrozenCone& cone = before.mobilisation.cone;
  const fem::ElastoplasticState<2>& start = before.law;
  const fem::ElastoplasticFrame<2> frame = frame_of(point);
  if (before.mobilisation.unloading)
    return integrate_unloading(frame, before.mobilisation, start, increment, end);
  if (before.held_friction != cone.friction && before.take_up > 1e-12 * (1.0 + start.gamma_p)) {
    using fem::PiecewiseLinear;
    const fem::HardeningCone taken_up{PiecewiseLinear({{start.gamma_p, before.held_friction},
                                                       {start.gamma_p + before.take_up, cone.friction}}),
                                      PiecewiseLinear(cone.dilatancy), PiecewiseLinear(cone.cohesion)};
    Response<2> response = fem::integrate_elastoplastic(frame, taken_up, start, increment, end);
    if (response.quality == Quality::good) return response;
  }
  // Nothing to take up, or softening too steep to have one answer: at once.
  return fem::integrate_elastoplastic(frame, cone, start, increment, end);
}

Response<2> InformedMaterial::integrate_updated(std::size_t point, const Increment<2>& stretch,
                                                const fem::Mobilisation& mobilisation,
                                                fem::ElastoplasticState<2>& end) const {
  const fem::ElastoplasticState<2>& start = committed_[point].law;
  const fem::ElastoplasticFrame<2> frame = frame_of(point);
  if (mobilisation.unloading) return integrate_unloading(frame, mobilisation, start, stretch, end);
  Response<2> response = fem::integrate_elastoplastic(frame, mobilisation.cone, start, stretch, end);
  add_hardening(frame, committed_[point].mobilisation.cone, mobilisation.cone, start, stretch, end, response);
  return response;
}

void InformedMaterial::evaluate_frozen(std::span<const Increment<2>> increments,
                                       std::span<Response<2>> responses) {
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    trial_[point] = committed_[point];
    if (!committed_[point].own.active) responses[point] = integrate(point, increments[point]);
  }
}

void InformedMaterial::evaluate_fixed_point(std::span<const Increment<2>> increments,
                                            std::span<Response<2>> responses) {
  // With the cone of the last step it shows which points yield at all.
  evaluate_frozen(increments, responses);
  std::vector<PlaneRequest> requests;
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    if (committed_[point].own.active || is_zero(increments[point]) ||
        responses[point].quality == Quality::failed)
      continue;
    requests.push_back({committed_[point].cell.state, felt(increments[point])});
    points.push_back(point);
  }
  if (points.empty()) return;
  const std::vector<PlaneReply> replies = calls_.evaluate(requests, points);
  for (std::size_t r = 0; r < replies.size(); ++r) {
    const std::size_t point = points[r];
    const Response<2>& cell = replies[r].response;
    if (cell.quality != Quality::failed) {
      take(replies[r], increments[point], point);
      const fem::StretchAndTurn<2> step = fem::stretch_and_turn(increments[point]);
      Response<2>& response = responses[point];
      fem::ElastoplasticState<2>& end = trial_[point].law;
      // The mobilisation has turned already; nothing that the law takes of it has a direction.
      response = integrate_updated(point, step.stretch, trial_[point].mobilisation, end);
      if (increments[point].configuration != Configuration::fixed)
        response = turned(response, end, step.turn);
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

void InformedMaterial::commit() {
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

CosseratPart InformedMaterial::cosserat_part_of(const PointState& point) const {
  if (point.own.active) return point.own.cosserat;
  const Vector7 stress = frame_.unscaled_stress(point.law.scaled_stress);
  CosseratPart part;
  part.skew_stress = stress[k21] - stress[k12];
  part.couple_stress = stress.tail<2>();
  part.pressure = pressure_in_plane(stress);
  return part;
}

LimitsReached InformedMaterial::reached(const PointState& point) const {
  const double least = own_rules_.packing.least_pressure();
  LimitsReached reached;
  if (!controlled()) reached = cosserat_part_of(point).reached(own_rules_.cosserat, least);
  reached.parted = pressure_in_plane(point.cell.response.stress) <= least;
  return reached;
}

void InformedMaterial::count_limits() {
  std::vector<LimitsReached> points;
  for (const PointState& point : committed_) points.push_back(reached(point));
  at_limits_.count(points);
}

void InformedMaterial::leave_laws() {
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

void InformedMaterial::watch_mismatch() {
  if (told_of_mismatch_ && !may_change()) return;
  std::string left = left_cells(trial_);
  if (left.empty()) return;
  if (parameters_.beyond_mismatch == BeyondMismatch::stop)
    throw RunError(
        left +
        "; 'beyond_mismatch: tell' goes on, 'beyond_mismatch: cell' takes the cell's stress there, smaller steps or "
        "'update: fixed_point' may bring them together");
  if (may_change()) left += "; such points go by the stress of their cells from the next step on";
  if (!told_of_mismatch_) notes_.push_back(left);
  told_of_mismatch_ = true;
  if (may_change()) leave_laws();
}

bool InformedMaterial::has_left_cell(const PointState& point) const {
  return !point.own.active && mismatch(point) > parameters_.mismatch_limit;
}

std::string InformedMaterial::doubt() const {
  return left_cells(committed_);
}

std::string InformedMaterial::left_cells(const std::vector<PointState>& points) const {
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

void InformedMaterial::follow(const CellCalls& calls, std::span<const std::size_t> points) {
  std::vector<std::size_t> pending(points.begin(), points.end());
  std::vector<PlaneReply> last(committed_.size());
  for (int parts = 1; !pending.empty(); parts *= 2) {
    if (parts > kMostParts) {
      throw RunError(
          fmt::format("the cell of point {} cannot follow a step of its material, even in {} parts: {}; take "
                      "smaller steps, or update: fixed_point, which cuts steps for its cells",
                      pending.front(), kMostParts, last[pending.front()].response.message));
    }
    for (const std::size_t point : pending)
      last[point] = PlaneReply{{}, true, {}, committed_[point].cell.state};
    std::vector<std::size_t> following = pending;
    for (int part = 0; part < parts && !following.empty(); ++part) {
      std::vector<PlaneRequest> requests;
      for (const std::size_t point : following) {
        requests.push_back({last[point].state, part_of(felt(increments_[point]), part, parts)});
      }
      std::vector<PlaneReply> replies = calls.evaluate(requests, following);
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

void InformedMaterial::take(const PlaneReply& reply, const Increment<2>& increment, std::size_t point) {
  PointState& trial = trial_[point];
  const PointState& before = committed_[point];
  const bool turns = increment.configuration != Configuration::fixed;
  const fem::StretchAndTurn<2> motion = fem::stretch_and_turn(increment);
  // All in the axes of the start of the step. The pressures of the law, which are all that is lent, are in any.
  const Vector7& answer = reply.response.stress;
  const Vector7 after = turns ? fem::rotated(answer, -motion.turn) : answer;
  const fem::ScaledVector<double>& law = trial.law.scaled_stress;
  const fem::MicroStep step{scaled_strain(motion.stretch),
                            complete_cell_stress(before.cell.response.stress, before.law.scaled_stress),
                            complete_cell_stress(after, law), law.head<3>().sum() / 3.0,
                            trial.law.regime == fem::Regime::smooth};
  trial.mobilisation = fem::advance(before.mobilisation, step, frame_.moduli, parameters_.mobilisation);
  if (turns) trial.mobilisation = fem::rotated(std::move(trial.mobilisation), motion.turn);
  const bool frozen = parameters_.update == InformedUpdate::frozen;
  trial.held_friction = (frozen ? committed_[point] : trial).mobilisation.cone.friction;
  trial.take_up = trial.law.gamma_p - committed_[point].law.gamma_p;
  trial.cell = reply;
}

fem::ScaledVector<double> InformedMaterial::scaled_strain(const Increment<2>& stretch) const {
  if (!controlled()) return symmetric_part(stretch.strain());
  Vector7 strain = stretch.strain();
  strain.tail<2>() *= frame_.length;
  return strain;
}

/// Cells are lent the out-of-plane stress of the law, in proportion to the pressures in the plane: discs have none, and
/// that of spheres would be matched at another angle in the plane, as the cone is a circle (B.9).
fem::ScaledVector<double> InformedMaterial::complete_cell_stress(const Vector7& cell,
                                                                 const fem::ScaledVector<double>& law) const {
  fem::ScaledVector<double> scaled = controlled() ? cell : symmetric_part(cell);
  if (controlled()) scaled.tail<2>() /= frame_.length;
  const double law_in_plane = law(k11) + law(k22);
  if (law_in_plane < 0.0) scaled(k33) = law(k33) / law_in_plane * (cell(k11) + cell(k22));
  return scaled;
}

fem::ScaledVector<double> InformedMaterial::scaled_stress(const Vector7& stress) const {
  fem::ScaledVector<double> scaled = stress;
  if (frame_.length > 0.0) scaled.tail<2>() /= frame_.length;
  return scaled;
}

double InformedMaterial::mismatch(const PointState& point) const {
  const auto in_plane = [this](const fem::ScaledVector<double>& s) {
    const double shear = 0.5 * (s(k12) + s(k21)) * (s(k12) + s(k21));
    const double skew = 0.5 * (s(k21) - s(k12)) * (s(k21) - s(k12)) + s.tail<2>().squaredNorm();
    return std::sqrt(s(k11) * s(k11) + s(k22) * s(k22) + shear + (controlled() ? skew : 0.0));
  };
  const double size = in_plane(point.law.scaled_stress);
  const double difference = in_plane(
      point.law.scaled_stress - complete_cell_stress(point.cell.response.stress, point.law.scaled_stress));
  return size > 0.0 ? difference / size : difference;
}

void InformedMaterial::save(ArchiveWriter& archive) const {
  std::vector<double> values;
  std::vector<PlaneReply> cells;
  std::vector<OwnAnswer> own;
  for (PointState point : committed_) {
    Packer pack{values};
    visit_numbers(pack, point, parameters_.mobilisation.window);
    cells.push_back(point.cell);
    own.push_back(point.own);
  }
  archive.write("laws", std::span<const double>(values));
  if (may_change()) write_records(archive, "own", std::span<const OwnAnswer>(own));
  write_records(archive, "cells", std::span<const PlaneReply>(cells));
  at_limits_.save(archive);
}

void InformedMaterial::restore(ArchiveReader& archive) {
  std::vector<double> one;
  Packer pack{one};
  PointState any;
  visit_numbers(pack, any, parameters_.mobilisation.window);
  const std::size_t length = one.size();
  const std::vector<double> values = read_lists(archive, "laws", committed_.size(), length);
  std::vector<PlaneReply> cells = read_records<PlaneReply>(archive, "cells", committed_.size());
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    Unpacker unpack{std::span(values).subspan(point * length, length)};
    visit_numbers(unpack, committed_[point], parameters_.mobilisation.window);
    committed_[point].cell = std::move(cells[point]);
  }
  if (may_change()) {
    const std::vector<OwnAnswer> own = read_records<OwnAnswer>(archive, "own", committed_.size());
    for (std::size_t point = 0; point < committed_.size(); ++point) committed_[point].own = own[point];
  }
  trial_ = committed_;
  at_limits_.restore(archive);
}

std::vector<std::string> InformedMaterial::field_names() const {
  std::vector<std::string> own{"friction",      "dilatancy", "dilatancy_limited",
                               "plastic_shear", "regime",    "stress_mismatch"};
  if (may_change()) own.emplace_back("stress_of_cell");
  return joined_names(joined_names(own, names_of_columns<CellDiagnostics>()),
                      names_of_limit_fields(!controlled()));
}

void InformedMaterial::fields(std::size_t point, std::span<double> values) const {
  const PointState& p = committed_[point];
  std::vector<double> own{p.mobilisation.cone.friction,       p.mobilisation.cone.dilatancy,
                          p.mobilisation.limited ? 1.0 : 0.0, p.law.gamma_p,
                          static_cast<double>(p.law.regime),  mismatch(p)};
  if (may_change()) own.push_back(p.own.active ? 1.0 : 0.0);
  auto rest = std::ranges::copy(own, values.begin()).out;
  rest = std::ranges::copy(values_of(p.cell.diagnostics), rest).out;
  if (controlled()) {
    write_limit_fields(reached(p), std::nullopt, {}, rest);
  } else {
    write_limit_fields(reached(p), own_rules_.cosserat, cosserat_part_of(p), rest);
  }
}

std::vector<fem::Figure> InformedMaterial::figures() const {
  if (committed_.empty()) return {};
  std::vector<double> mismatches;
  double sum = 0.0;
  double limited = 0.0;
  double by_cell = 0.0;
  for (const PointState& point : committed_) {
    mismatches.push_back(mismatch(point));
    sum += mismatches.back();
    if (point.mobilisation.limited) limited += 1.0;
    if (point.own.active) by_cell += 1.0;
  }
  std::sort(mismatches.begin(), mismatches.end());
  const auto count = static_cast<double>(mismatches.size());
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * count)) - 1;
  std::vector<fem::Figure> figures{{"stress_mismatch_mean", sum / count},
                                   {"stress_mismatch_percentile_95", mismatches[rank]},
                                   {"stress_mismatch_largest", mismatches.back()},
                                   {"dilatancy_limited", limited / count}};
  if (may_change()) figures.push_back({"stress_of_cell", by_cell / count});
  const std::vector<fem::Figure> at_limits = at_limits_.figures();
  figures.insert(figures.end(), at_limits.begin(), at_limits.end());
  return figures;
}

}  // namespace polargrain::coupler
