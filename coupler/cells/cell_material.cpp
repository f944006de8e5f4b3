// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_material.hpp"

#include <numeric>

#include "common/record_archive.hpp"
#include "coupler/cells/cell_fields.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cell_noise.hpp"
#include "coupler/cells/secant_tangent.hpp"

namespace polargrain::coupler {
namespace {

/// Evaluations of a step that secant tangents do with. An iteration that needs more does not converge by them.
constexpr int kStressAlone = 3;

}  // namespace

template <int dim>
CellMaterial<dim>::CellMaterial(Pool& pool, std::uint32_t definition,
                                const std::optional<CosseratParameters>& cosserat, const std::string& note)
    : calls_(calls_of<dim>(pool, definition)), cosserat_(cosserat), at_limits_(cosserat.has_value()) {
  if (!note.empty()) notes_.push_back(note);
  const CellDefinition& cell = pool.definition(definition);
  if (cell.control.rotations == CellRotations::controlled) mean_radius_ = cell.packing.mean_radius();
  if (cell.control.tangent != CellTangent::secant) return;
  calls_ = secant_calls_of<dim>(pool, definition);
  stress_alone_ = kStressAlone;
}

template <int dim>
void CellMaterial<dim>::allocate(std::size_t points) {
  PointState start;
  start.cell = packing_at_rest(calls_, notes_);
  packing_ = PackingAtStart<dim>(start.cell);
  start.cosserat = packing_.part();
  committed_.assign(points, start);
  trial_ = committed_;
}

template <int dim>
void CellMaterial<dim>::begin_in_ground() {
  if (!ground_.is_due()) return;
  ground_.lead(calls_);
  std::vector<std::size_t> points(committed_.size());
  std::iota(points.begin(), points.end(), std::size_t{0});
  std::vector<CellReply> boxes = ground_.boxes(calls_, points);
  for (std::size_t point = 0; point < boxes.size(); ++point) {
    committed_[point].cell = of_dimension<dim>(std::move(boxes[point]));
    committed_[point].cosserat = packing_.part_of(committed_[point].cell);
    ground_.judge(point, committed_[point].cell.response.stress);
  }
  std::vector<StatePointer*> states;
  for (PointState& point : committed_) states.push_back(&point.cell.state);
  collect(calls_, states);
  trial_ = committed_;
  for (std::string& note : ground_.notes()) notes_.push_back(std::move(note));
}

template <int dim>
std::vector<fem::Figure> CellMaterial<dim>::figures() const {
  std::vector<fem::Figure> figures = at_limits_.figures();
  ground_.add_figures(figures);
  return figures;
}

template <int dim>
void CellMaterial<dim>::evaluate(std::span<const Increment<dim>> increments,
                                 std::span<Response<dim>> responses) {
  std::vector<PointRequest<dim>> requests;
  std::vector<std::size_t> points;
  const bool asks_for_tangents = evaluations_++ >= stress_alone_;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    trial_[point] = committed_[point];
    if (is_zero(increments[point])) continue;
    requests.push_back(
        {committed_[point].cell.state,
         cosserat_ ? increment_for_free_cell(increments[point]) : increment_for_cell(increments[point]),
         asks_for_tangents ? nullptr : &committed_[point].cell.response});
    points.push_back(point);
  }
  std::vector<PointReply<dim>> replies = calls_.evaluate(requests, points);
  for (std::size_t r = 0; r < replies.size(); ++r) {
    PointState& point = trial_[points[r]];
    point.cell = std::move(replies[r]);
  }
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    PointState& state = trial_[point];
    if (!cosserat_) {
      responses[point] = state.cell.response;
    } else if (is_zero(increments[point])) {
      responses[point] = state.cosserat.joined_to(state.cell.response, *cosserat_);
    } else {
      responses[point] = state.cosserat.follow(increments[point], state.cell.response, *cosserat_,
                                               packing_.kept(state.cell.diagnostics));
    }
    responses[point].noise = noise_of(state.cell, mean_radius_);
  }
}

template <int dim>
void CellMaterial<dim>::commit() {
  std::vector<StatePointer*> states;
  for (PointState& point : trial_) states.push_back(&point.cell.state);
  collect(calls_, states);
  committed_ = trial_;
  evaluations_ = 0;
  std::vector<LimitsReached> reached_limits;
  for (const PointState& point : committed_) reached_limits.push_back(reached(point));
  at_limits_.count(reached_limits);
}

template <int dim>
void CellMaterial<dim>::take_over(std::vector<PointState> points, const PointsAtLimits& at_limits) {
  committed_ = std::move(points);
  trial_ = committed_;
  at_limits_ = at_limits;
}

template <int dim>
LimitsReached CellMaterial<dim>::reached(const PointState& point) const {
  return limits_reached<dim>(point.cell.response.stress, cosserat_, point.cosserat, packing_);
}

template <int dim>
void CellMaterial<dim>::save(ArchiveWriter& archive) const {
  write_records(archive, "points", std::span<const PointState>(committed_));
  at_limits_.save(archive);
  ground_.save(archive);
}

template <int dim>
void CellMaterial<dim>::restore(ArchiveReader& archive) {
  committed_ = read_records<PointState>(archive, "points", committed_.size());
  trial_ = committed_;
  at_limits_.restore(archive);
  ground_.restore(archive);
}

template <int dim>
fem::TakenOver CellMaterial<dim>::take_over(ArchiveReader& archive, std::size_t count,
                                            std::span<const fem::PointMean> means) {
  const std::vector<PointState> theirs = read_records<PointState>(archive, "points", count);
  for (std::size_t point = 0; point < committed_.size(); ++point)
    committed_[point] = theirs[means[point].nearest];
  trial_ = committed_;
  return {.from_nearest = committed_.size()};
}

template <int dim>
std::vector<std::string> CellMaterial<dim>::field_names() const {
  return names_of_cell_fields(cosserat_.has_value());
}

template <int dim>
void CellMaterial<dim>::fields(std::size_t point, std::span<double> values) const {
  const PointState& state = committed_[point];
  write_cell_fields(state.cell.diagnostics, reached(state), cosserat_, state.cosserat, values);
}

template class CellMaterial<2>;
template class CellMaterial<3>;

}  // namespace polargrain::coupler
