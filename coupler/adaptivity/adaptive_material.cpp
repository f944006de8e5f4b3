// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/adaptive_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.hpp"
#include "common/seconds.hpp"
#include "coupler/adaptivity/leaders.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/linearised.hpp"
#include "coupler/cells/successive.hpp"
#include "coupler/cells/turned_in_parts.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// Of a cell with free rotations only the symmetric part of stress and tangent is meant.
template <int dim>
void keep_symmetric(Response<dim>& response) {
  response.stress = symmetric_part<dim>(response.stress);
  response.tangent = symmetric_tangent<dim>(response.tangent);
}

/// Norm of the stiffness of normal strains, Pa.
double normal_stiffness(const Matrix7& tangent) {
  return tangent.topLeftCorner<2, 2>().norm();
}
double normal_stiffness(const Matrix18& tangent) {
  constexpr std::array<int, 3> kNormal{0, 4, 8};
  return tangent(kNormal, kNormal).norm();
}

/// At the start the estimate of a point may exceed the tolerance by this: points are estimated by what is the worst of them,
/// and the tolerance is one of their mean error, which audits watch from the first step on.
constexpr double kLooseAtFirst = 1.4142135623730951;
/// By what the working tolerance is divided where the bound of a step exceeds the tolerance.
constexpr double kTighter = 1.4142135623730951;
/// Of the points, that have cells of their own when sharing is given up.
constexpr double kNothingToShare = 0.9;
/// An error that a run leaves in the history of a cell stays. It weighs so many times one that a later run still mends.
constexpr double kStays = 2.0;
constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
/// By what it is divided at most at once.
constexpr double kMostTightening = 4.0;
/// A smaller tolerance helps when the bound falls below this share of what it was.
constexpr double kHelps = 0.9;
/// The error grows when its bound is above that of the step before by more than this.
constexpr double kGrows = 1.1;

}  // namespace

template <int dim>
AdaptiveMaterial<dim>::AdaptiveMaterial(CellCalls<dim> calls,
                                        const std::optional<CosseratParameters>& cosserat,
                                        const AdaptivityOptions& options, const std::string& note)
    : calls_(std::move(calls)),
      cosserat_(cosserat),
      at_limits_(cosserat.has_value()),
      options_(options),
      measure_(options.mean_diameter) {
  if (cosserat_.has_value() == measure_.controlled())
    throw RunError("an adaptive material takes either a Cosserat part or the diameter of controlled grains");
  if (!note.empty()) notes_.push_back(note);
}

template <int dim>
void AdaptiveMaterial<dim>::allocate(std::size_t points) {
  Cell packing{packing_at_rest(calls_, notes_), {}};
  if (!measure_.controlled()) keep_symmetric(packing.answer.response);
  packing_ = PackingAtStart<dim>(packing.answer);
  reference_ = options_.reference_pressure.value_or(packing_.pressure());
  if (!(reference_ > 0.0)) {
    throw RunError(
        "an adaptive material needs a packing under pressure, which its tolerance is a share of, or another "
        "pressure to measure by (reference_pressure)");
  }
  const typename Cosserat<dim>::Matrix& elastic = packing.answer.response.tangent;
  // Strain whose elastic stress is the tolerance.
  noise_strain_ = options_.tolerance * reference_ / normal_stiffness(elastic);
  estimate_ = ErrorEstimate<dim>(measure_, elastic, noise_strain_);
  cells_.assign(1, packing);
  points_.assign(points, Point{});
  for (Point& point : points_) point.cosserat = packing_.part();
  // With nothing to measure it by, an estimate is held to what was asked for.
  tightening_ = audits() ? 1.0 / kLooseAtFirst : 1.0;
  choose_followed();
}

template <int dim>
void AdaptiveMaterial<dim>::begin_in_ground() {
  if (!ground_.is_due()) return;
  ground_.lead(calls_);
  cells_.clear();
  for (const CellReply& box : ground_.levels().boxes) {
    cells_.push_back({of_dimension<dim>(box), {}});
    if (!measure_.controlled()) keep_symmetric(cells_.back().answer.response);
  }
  for (std::size_t point = 0; point < points_.size(); ++point) {
    points_[point].cell = static_cast<std::uint32_t>(ground_.level_of(point));
    points_[point].offset = ground_.offset_of(point);
    points_[point].cosserat = packing_.part_of(cells_[points_[point].cell].answer);
  }
  std::vector<std::size_t> alone;
  for (const Followed& followed : followed_) alone.push_back(followed.point);
  const std::vector<CellReply> boxes = ground_.boxes(calls_, alone);
  for (std::size_t k = 0; k < boxes.size(); ++k) followed_[k].state = boxes[k].state;
  take_stress_of_ground();
  for (std::string& note : ground_.notes()) notes_.push_back(std::move(note));
}

template <int dim>
void AdaptiveMaterial<dim>::take_stress_of_ground() {
  const std::vector<Increment<dim>> none(points_.size());
  std::vector<Response<dim>> responses(points_.size());
  do {
    evaluate(none, responses);
    for (const Response<dim>& response : responses)
      if (response.quality == Quality::failed)
        throw RunError(
            fmt::format("a box cannot begin under the weight of the ground: {}", response.message));
  } while (!confirm());
  for (std::size_t point = 0; point < points_.size(); ++point)
    ground_.judge(point, symmetric_part<dim>(responses[point].stress));
  commit();
}

template <int dim>
void AdaptiveMaterial<dim>::begin_step() {
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    Branch unmoved{cell};
    unmoved.answer = cells_[cell].answer;
    unmoved.departure = cells_[cell].departure;
    branches_.push_back(unmoved);
    branches_of_cell_.push_back({cell});
  }
  for (const Point& point : points_) branch_of_point_.push_back(point.cell);
  target_.resize(points_.size());
  excursions_.resize(points_.size());
}

template <int dim>
void AdaptiveMaterial<dim>::evaluate(std::span<const Increment<dim>> increments,
                                     std::span<Response<dim>> responses) {
  const Clock::time_point start = Clock::now();
  const double cells_before = seconds_of_cells_;
  if (branches_.empty()) begin_step();
  increments_.assign(increments.begin(), increments.end());
  for (std::size_t point = 0; point < points_.size(); ++point) {
    target_[point] = followed_by(points_[point].offset, increment_of_step(point));
    const Departure<dim>& departure = branches_[points_[point].cell].departure;
    const double depth = estimate_.onward(departure, farthest(point));
    const double now = estimate_.onward(departure, target_[point]);
    excursions_[point] = {std::max(depth, now), std::max(depth - now, 0.0)};
  }
  settle(tolerance());
  for (std::size_t point = 0; point < points_.size(); ++point) {
    CosseratPart<dim> part = points_[point].cosserat;
    responses[point] = answer_to(point, part);
  }
  seconds_ += seconds_since(start) - (seconds_of_cells_ - cells_before);
}

template <int dim>
Increment<dim> AdaptiveMaterial<dim>::increment_of_step(std::size_t point) const {
  const Increment<dim> whole = increment_for_cell(increments_[point]);
  // Grains whose rotations are free feel no micro-rotation and no curvature.
  if (measure_.controlled()) return whole;
  Increment<dim> of_box = increment_of<dim>(whole.displacement_gradient);
  of_box.configuration = whole.configuration;
  return of_box;
}

template <int dim>
Increment<dim> AdaptiveMaterial<dim>::farthest(std::size_t point) const {
  Increment<dim> place = points_[point].farthest;
  place.configuration = target_[point].configuration;  // no checkpoint keeps it
  return place;
}

template <int dim>
double AdaptiveMaterial<dim>::estimate(std::size_t point, const Branch& branch) const {
  const double of_offset =
      estimate_.of(branch.answer.response, branch.departure, offset_between(branch.place, target_[point]));
  const Branch& cell = branches_[branch.cell];
  const double of_history =
      estimate_.of_history(cell.answer.response, cell.departure, excursions_[point], branch.excursion);
  return of_offset + (branch.was_run ? kStays : 1.0) * of_history;
}

template <int dim>
Excursion AdaptiveMaterial<dim>::excursion_of_run(std::size_t leader) const {
  const Branch& cell = branches_[points_[leader].cell];
  const Excursion& own = excursions_[leader];
  const Excursion straight{own.depth - own.back, 0.0};
  const double left_out = estimate_.of_history(cell.answer.response, cell.departure, own, straight);
  return kStays * left_out > tolerance() ? own : straight;
}

template <int dim>
std::size_t AdaptiveMaterial<dim>::best_branch(std::size_t point) const {
  std::size_t best = branch_of_point_[point];
  double least = estimate(point, branches_[best]);
  for (const std::size_t branch : branches_of_cell_[points_[point].cell]) {
    const double error = estimate(point, branches_[branch]);
    if (error < least) {
      least = error;
      best = branch;
    }
  }
  return best;
}

template <int dim>
bool AdaptiveMaterial<dim>::settle(double allowed) {
  for (;;) {
    std::vector<std::vector<std::size_t>> unserved(cells_.size());
    bool served = true;
    for (std::size_t point = 0; point < points_.size(); ++point) {
      std::size_t& branch = branch_of_point_[point];
      if (estimate(point, branches_[branch]) <= allowed) continue;
      branch = best_branch(point);
      if (estimate(point, branches_[branch]) <= allowed) continue;
      unserved[points_[point].cell].push_back(point);
      served = false;
    }
    if (served) return true;
    std::vector<std::size_t> leaders;
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      if (unserved[cell].empty()) continue;
      const std::vector<std::size_t> chosen = leaders_for(cell, unserved[cell]);
      leaders.insert(leaders.end(), chosen.begin(), chosen.end());
    }
    if (!run_branches(leaders)) return false;
  }
}

template <int dim>
std::vector<std::size_t> AdaptiveMaterial<dim>::leaders_for(std::size_t cell,
                                                            const std::vector<std::size_t>& points) const {
  const Branch& unmoved = branches_[cell];
  if (!shares_) return points;
  if (!unmoved.departure.known()) {
    // Nothing can be said before runs have shown how the response departs from its tangent, in the directions that
    // occur.
    return span_directions<dim>(
        points, [&](std::size_t point) { return measure_.strain(target_[point]); }, noise_strain_);
  }
  return choose_leaders(points, [&](std::size_t leader, std::size_t other) {
    Departure<dim> expected = unmoved.departure;
    const bool turns = target_[leader].configuration != Configuration::fixed;
    const Excursion excursion = excursion_of_run(leader);
    Vector own = measure_.strain(target_[leader]);
    if (excursion.back > 0.0) own -= measure_.strain(farthest(leader));
    const Vector strain = turns ? fem::rotated(own, rotation_of(target_[leader])) : own;
    if (strain.norm() > 0.0) expected.direction = strain / strain.norm();
    const double of_offset = estimate_.of(with_tangent_turned(unmoved.answer.response, target_[leader]),
                                          expected, offset_between(target_[leader], target_[other]));
    const double of_history =
        estimate_.of_history(unmoved.answer.response, unmoved.departure, excursions_[other], excursion);
    return of_offset + kStays * of_history <= tolerance();
  });
}

template <int dim>
std::size_t AdaptiveMaterial<dim>::enter(Branch moved, std::size_t start, const Increment<dim>& increment) {
  const std::size_t number = branches_.size();
  if (moved.answer.response.quality != Quality::failed) {
    Branch& from = branches_[start];
    moved.departure = estimate_.learn(from.answer.response, moved.answer.response, increment, from.departure);
    branches_of_cell_[moved.cell].push_back(number);
  }
  moved.start = start;
  moved.was_run = true;
  branches_.push_back(std::move(moved));
  return number;
}

template <int dim>
std::vector<std::size_t> AdaptiveMaterial<dim>::run_turns(const std::vector<std::size_t>& leaders) {
  std::vector<PointRequest<dim>> requests;
  std::vector<std::size_t> turning;
  for (const std::size_t leader : leaders) {
    if (excursion_of_run(leader).back == 0.0 || turns_.contains(leader)) continue;
    requests.push_back({branches_[points_[leader].cell].answer.state, farthest(leader)});
    turning.push_back(leader);
  }
  if (!turning.empty()) {
    std::vector<PointReply<dim>> replies = run(requests, turning, costs_.steps);
    costs_.runs += static_cast<std::int64_t>(requests.size());
    for (std::size_t k = 0; k < turning.size(); ++k) {
      const std::size_t cell = points_[turning[k]].cell;
      Branch turn{cell};
      turn.place = requests[k].increment;
      turn.leader = kNobody;  // who follows it shares it
      turn.answer = std::move(replies[k]);
      turn.excursion = {excursions_[turning[k]].depth, 0.0};
      turns_[turning[k]] = enter(std::move(turn), cell, requests[k].increment);
    }
  }
  std::vector<std::size_t> starts;
  for (const std::size_t leader : leaders) {
    starts.push_back(points_[leader].cell);
    if (excursion_of_run(leader).back == 0.0) continue;
    const std::size_t turn = turns_.at(leader);
    // A cell that cannot go there goes straight.
    if (branches_[turn].answer.response.quality != Quality::failed) starts.back() = turn;
  }
  return starts;
}

template <int dim>
bool AdaptiveMaterial<dim>::run_branches(const std::vector<std::size_t>& leaders) {
  const std::vector<std::size_t> starts = run_turns(leaders);
  std::vector<PointRequest<dim>> requests;
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    const Branch& start = branches_[starts[k]];
    const Increment<dim>& target = target_[leaders[k]];
    requests.push_back({start.answer.state, start.was_run ? offset_between(start.place, target) : target});
  }
  std::vector<PointReply<dim>> replies = run(requests, leaders, costs_.steps);
  costs_.runs += static_cast<std::int64_t>(requests.size());
  bool all_good = true;
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    const std::size_t leader = leaders[k];
    Branch moved{points_[leader].cell};
    moved.place = target_[leader];
    moved.leader = leader;
    moved.answer = std::move(replies[k]);
    // Of a cell that could not go by the farthest place too: no further run would mend that.
    moved.excursion = excursion_of_run(leader);
    all_good = all_good && moved.answer.response.quality != Quality::failed;
    branch_of_point_[leader] = enter(std::move(moved), starts[k], requests[k].increment);
  }
  // Points that an old answer would still serve go along where a new one serves them better, so that a field
  // of nearly equal strains stays one cell.
  for (std::size_t point = 0; point < points_.size() && all_good; ++point) {
    branch_of_point_[point] = best_branch(point);
  }
  return all_good;
}

template <int dim>
std::vector<PointReply<dim>> AdaptiveMaterial<dim>::run(std::span<const PointRequest<dim>> requests,
                                                        std::span<const std::size_t> points,
                                                        std::int64_t& steps) {
  const Clock::time_point start = Clock::now();
  std::vector<PointReply<dim>> replies = evaluate_in_parts<dim>(calls_, requests, points);
  seconds_of_cells_ += seconds_since(start);
  for (PointReply<dim>& reply : replies) {
    steps += static_cast<std::int64_t>(reply.diagnostics.dem_steps);
    if (!measure_.controlled()) keep_symmetric(reply.response);
  }
  return replies;
}

template <int dim>
typename Cosserat<dim>::Vector AdaptiveMaterial<dim>::stress_of_cells(std::size_t point) const {
  const Branch& branch = branches_[branch_of_point_[point]];
  return linearised_stress(branch.answer.response, offset_between(branch.place, target_[point]));
}

template <int dim>
Response<dim> AdaptiveMaterial<dim>::answer_to(std::size_t point, CosseratPart<dim>& part) const {
  const Branch& branch = branches_[branch_of_point_[point]];
  const PointReply<dim>& answer = branch.answer;
  if (answer.response.quality == Quality::failed) return answer.response;
  Response<dim> response = with_tangent_turned(answer.response, offset_between(branch.place, target_[point]));
  response.stress = stress_of_cells(point);
  if (cosserat_)
    return part.follow(increments_[point], response, *cosserat_, packing_.kept(answer.diagnostics));
  part.pressures = pressures_of<dim>(response.stress);
  return response;
}

template <int dim>
bool AdaptiveMaterial<dim>::confirm() {
  if (branches_.empty()) return true;
  const std::vector<std::size_t> before = branch_of_point_;
  if (!settle(tolerance())) return false;
  if (audits()) {
    run_followed();
    for (double bound = bound_of(measured_errors()); bound > options_.tolerance && tightening_helps_;) {
      const double bound_before = bound;
      const double tightening_before = tightening_;
      tightening_ = tightening_to_next_run();
      if (!settle(tolerance())) return false;
      bound = bound_of(measured_errors());
      note_tightening(bound_before, bound);
      tightening_helps_ = bound < kHelps * bound_before;
      // The rest has entered the histories and no answer of this step mends it. Where it does not grow, a smaller
      // tolerance would be paid for nothing.
      if (!tightening_helps_ && bound < kGrows * bounds_.last) tightening_ = tightening_before;
    }
  }
  const bool stands = branch_of_point_ == before;
  costs_.redone += stands ? 0 : 1;
  return stands;
}

template <int dim>
double AdaptiveMaterial<dim>::tightening_to_next_run() const {
  double largest = 0.0;
  for (std::size_t point = 0; point < points_.size(); ++point)
    largest = std::max(largest, estimate(point, branches_[branch_of_point_[point]]));
  double tightening = tightening_ * kTighter;
  // A tolerance that no estimate exceeds changes nothing, which says nothing of whether a smaller one helps.
  while (options_.tolerance / tightening * reference_ >= largest &&
         tightening < kMostTightening * tightening_)
    tightening *= kTighter;
  return tightening;
}

template <int dim>
void AdaptiveMaterial<dim>::commit() {
  if (branches_.empty()) return;
  ++step_;
  if (audits()) keep_audit();
  constexpr std::size_t kUnused = static_cast<std::size_t>(-1);
  std::vector<std::size_t> cell_of_branch(branches_.size(), kUnused);
  std::vector<Cell> kept;
  std::vector<char> in_use(branches_.size(), 0);
  for (const std::size_t b : branch_of_point_) in_use[b] = 1;
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    if (in_use[b] == 0) continue;
    cell_of_branch[b] = kept.size();
    kept.push_back({branches_[b].answer, branches_[b].departure});
  }
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::size_t b = branch_of_point_[p];
    const Branch& branch = branches_[b];
    Point& point = points_[p];
    point.estimate = estimate(p, branch);
    point.offset = offset_between(branch.place, target_[p]);
    if (branch.was_run || excursions_[p].back == 0.0) point.farthest = point.offset;
    point.source = !branch.was_run ? Source::tangent : branch.leader == p ? Source::own : Source::neighbour;
    ++sources_[static_cast<std::size_t>(point.source)];
    answer_to(p, point.cosserat);
    point.cell = static_cast<std::uint32_t>(cell_of_branch[b]);
  }
  std::vector<StatePointer*> states;
  for (Cell& cell : kept) states.push_back(&cell.answer.state);
  for (Followed& followed : followed_) states.push_back(&followed.state);
  collect(calls_, states);
  count_unused(in_use);
  notice_sharing(kept.size());
  std::vector<LimitsReached> reached_limits;
  for (const Point& point : points_) reached_limits.push_back(reached(point));
  at_limits_.count(reached_limits);
  cells_ = std::move(kept);
  forget_step();
}

template <int dim>
LimitsReached AdaptiveMaterial<dim>::reached(const Point& point) const {
  const double least = packing_.least_pressure();
  if (cosserat_) return point.cosserat.reached(*cosserat_, least);
  return {.parted = point.cosserat.pressure() <= least};
}

template <int dim>
void AdaptiveMaterial<dim>::count_unused(std::vector<char> in_use) {
  for (std::size_t b = branches_.size(); b-- > cells_.size();) {
    if (in_use[b] != 0) {
      in_use[branches_[b].start] = 1;
      continue;
    }
    ++costs_.unused_runs;
    costs_.unused_steps += static_cast<std::int64_t>(branches_[b].answer.diagnostics.dem_steps);
  }
}

template <int dim>
void AdaptiveMaterial<dim>::notice_sharing(std::size_t cells) {
  const auto count = static_cast<double>(points_.size());
  if (!shares_ || points_.size() < 2 || static_cast<double>(cells) < kNothingToShare * count) return;
  shares_ = false;
  if (options_.tolerance == 0.0) return;
  notes_.push_back(fmt::format(
      "{} of {} points have cells of their own: no cells are left to share, and from here on no point "
      "is sent ahead of others",
      cells, points_.size()));
}

template <int dim>
void AdaptiveMaterial<dim>::revert() {
  if (!branches_.empty()) count_unused(std::vector<char>(branches_.size(), 0));
  forget_step();
}

template <int dim>
void AdaptiveMaterial<dim>::forget_step() {
  tightening_helps_ = true;
  for (Followed& followed : followed_) followed.reply = {};
  branches_.clear();
  branches_of_cell_.clear();
  branch_of_point_.clear();
  turns_.clear();
  increments_.clear();
}

template class AdaptiveMaterial<2>;
template class AdaptiveMaterial<3>;

}  // namespace polargrain::coupler
