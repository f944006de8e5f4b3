// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/resident_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/error.hpp"
#include "common/record_archive.hpp"
#include "coupler/cells/cell_fields.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cell_noise.hpp"

namespace polargrain::coupler {
namespace {

/// Of the mean contact force. Boxes at an even slow rate have 0.2 to 1 %, in a shear band some per cent; boxes whose grains
/// fly about have tens of per cent, and press by their agitation (docs/theory/explicit.md).
constexpr double kHot = 0.1;

}  // namespace

template <int dim>
ResidentMaterial<dim>::ResidentMaterial(Pool& pool, std::uint32_t definition,
                                        const std::optional<CosseratParameters>& cosserat, int dem_steps,
                                        const std::string& note)
    : calls_(calls_of<dim>(pool, definition)),
      cells_(pool, definition),
      dem_steps_(dem_steps),
      grains_(static_cast<double>(pool.definition(definition).packing.grains.size())),
      cosserat_(cosserat),
      at_limits_(cosserat.has_value()) {
  if (dem_steps < 1) throw RunError(fmt::format("dem_steps must be at least 1, found {}", dem_steps));
  if (!note.empty()) notes_.push_back(note);
  const CellDefinition& cell = pool.definition(definition);
  if (cell.control.rotations == CellRotations::controlled) mean_radius_ = cell.packing.mean_radius();
}

template <int dim>
void ResidentMaterial<dim>::allocate(std::size_t points) {
  at_rest_ = packing_at_rest(calls_, notes_);
  packing_ = PackingAtStart<dim>(at_rest_);
  points_.assign(points,
                 {at_rest_.response.stress, at_rest_.diagnostics, at_rest_.state, {}, packing_.part()});
  start();
}

template <int dim>
void ResidentMaterial<dim>::begin_in_ground() {
  if (!ground_.is_due()) return;
  ground_.lead(calls_);
  std::vector<std::size_t> points(points_.size());
  std::iota(points.begin(), points.end(), std::size_t{0});
  const std::vector<CellReply> boxes = ground_.boxes(calls_, points);
  std::vector<StatePointer*> states;
  for (std::size_t point = 0; point < boxes.size(); ++point) {
    const PointReply<dim> box = of_dimension<dim>(boxes[point]);
    points_[point] = {box.response.stress, box.diagnostics, box.state, {}, packing_.part_of(box)};
    states.push_back(&points_[point].state);
    ground_.judge(point, box.response.stress);
  }
  collect(calls_, states);
  for (std::string& note : ground_.notes()) notes_.push_back(std::move(note));
  start();
}

template <int dim>
std::vector<fem::Figure> ResidentMaterial<dim>::figures() const {
  std::vector<fem::Figure> figures = at_limits_.figures();
  ground_.add_figures(figures);
  return figures;
}

template <int dim>
void ResidentMaterial<dim>::expect(const fem::Asking& asking) {
  if (asking.seconds <= 0.0) return;
  if (!is_settled_) throw RunError("resident boxes change their DEM steps where they are read out (settle)");
  if (dem_seconds_ == 0.0) {
    // Of the packing, not of the present: so a run that was broken off takes the same steps.
    dem_seconds_ = cells_.time_step();
    if (!(dem_seconds_ > 0.0)) throw RunError("the workers do not tell how long a DEM step is");
  }
  constexpr int kLeast = 2;  // one is unstable (docs/theory/explicit.md)
  dem_steps_ = std::max(kLeast, static_cast<int>(std::lround(asking.seconds / dem_seconds_)));
}

template <int dim>
void ResidentMaterial<dim>::start() {
  std::vector<ResidentStart> starts;
  for (const PointState& point : points_) {
    const bool at_rest = point.state->name() == at_rest_.state->name();  // its bytes need not travel
    starts.push_back({at_rest ? nullptr : point.state, point.motion});
  }
  cells_.start(starts);
  forget_unrest();
  has_moved_ = false;
  is_settled_ = true;
}

template <int dim>
const std::vector<typename ResidentMaterial<dim>::PointState>& ResidentMaterial<dim>::settled() const {
  if (!is_settled_) throw RunError("resident boxes must be read out (settle) before they are handed on");
  return points_;
}

template <int dim>
void ResidentMaterial<dim>::take_over(std::vector<PointState> points, const PointsAtLimits& at_limits) {
  points_ = std::move(points);
  at_limits_ = at_limits;
  start();
}

template <int dim>
void ResidentMaterial<dim>::evaluate(std::span<const Increment<dim>> increments,
                                     std::span<Response<dim>> responses) {
  if (has_moved_) throw RunError("an explicit step is evaluated twice: resident boxes cannot go back");
  const bool rest =
      std::ranges::all_of(increments, [](const Increment<dim>& increment) { return is_zero(increment); });
  if (!rest) {
    std::vector<CellIncrement> of_boxes;
    for (const Increment<dim>& increment : increments)
      of_boxes.push_back(
          increment_in_space(cosserat_ ? increment_for_free_cell(increment) : increment_for_cell(increment)));
    has_moved_ = true;
    is_settled_ = false;
    const std::vector<ResidentAnswer> answers = cells_.go_on(dem_steps_, of_boxes);
    for (std::size_t p = 0; p < answers.size(); ++p) {
      take(points_[p], answers[p]);
      unrest_[p] += answers[p].unbalanced_force_ratio;
    }
    ++unrest_steps_;
  }
  for (std::size_t p = 0; p < points_.size(); ++p) {
    PointState& point = points_[p];
    Response<dim>& response = responses[p];
    response = at_rest_.response;
    response.stress = point.stress;
    if (cosserat_) {
      response =
          rest ? point.cosserat.joined_to(response, *cosserat_)
               : point.cosserat.follow(increments[p], response, *cosserat_, packing_.kept(point.diagnostics));
    }
    response.noise = noise_of<dim>(point.stress, point.diagnostics, mean_radius_);
  }
}

template <int dim>
void ResidentMaterial<dim>::take(PointState& point, const ResidentAnswer& answer) const {
  CellResponse response;
  response.stress = answer.stress;
  response.couple_stress = answer.couple_stress;
  response.known = at_rest_.knows_s33 ? KnownComponents::all : KnownComponents::plane;
  point.stress = of_dimension<dim>(response).stress;
  point.diagnostics.unbalanced_force_ratio = answer.unbalanced_force_ratio;
  point.diagnostics.coordination_number = answer.coordination_number;
  point.diagnostics.contacts = std::llround(0.5 * answer.coordination_number * grains_);
}

template <int dim>
void ResidentMaterial<dim>::commit() {
  has_moved_ = false;
  std::vector<LimitsReached> reached_limits;
  for (const PointState& point : points_) reached_limits.push_back(reached(point));
  at_limits_.count(reached_limits);
}

template <int dim>
void ResidentMaterial<dim>::revert() {
  if (has_moved_) throw RunError("an explicit step cannot be reverted: resident boxes cannot go back");
}

template <int dim>
void ResidentMaterial<dim>::settle() {
  if (has_moved_) throw RunError("resident boxes cannot be read out between evaluate and commit");
  if (is_settled_) return;
  std::vector<ResidentReadOut> boxes = cells_.read_out();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    points_[p].diagnostics = boxes[p].reply.diagnostics;
    points_[p].state = std::move(boxes[p].reply.state);
    points_[p].motion = boxes[p].motion;
  }
  forget_unrest();
  is_settled_ = true;
}

template <int dim>
void ResidentMaterial<dim>::forget_unrest() {
  unrest_.assign(points_.size(), 0.0);
  unrest_steps_ = 0;
}

template <int dim>
fem::Unrest ResidentMaterial<dim>::unrest() const {
  fem::Unrest all;
  if (unrest_steps_ == 0) return all;
  all.points = points_.size();
  for (const double sum : unrest_) {
    const double mean = sum / unrest_steps_;
    all.sum += mean;
    if (mean > kHot) ++all.hot;
  }
  return all;
}

template <int dim>
void ResidentMaterial<dim>::save(ArchiveWriter& archive) const {
  if (!is_settled_) throw RunError("resident boxes must be read out (settle) before they are saved");
  write_records(archive, "points", std::span<const PointState>(points_));
  at_limits_.save(archive);
  ground_.save(archive);
}

template <int dim>
void ResidentMaterial<dim>::restore(ArchiveReader& archive) {
  points_ = read_records<PointState>(archive, "points", points_.size());
  for (const PointState& point : points_)
    if (!point.state) throw RunError("'points' lacks the state of a resident box");
  at_limits_.restore(archive);
  ground_.restore(archive);
  start();
}

template <int dim>
LimitsReached ResidentMaterial<dim>::reached(const PointState& point) const {
  return limits_reached<dim>(point.stress, cosserat_, point.cosserat, packing_);
}

template <int dim>
std::vector<std::string> ResidentMaterial<dim>::field_names() const {
  return names_of_cell_fields(cosserat_.has_value());
}

template <int dim>
void ResidentMaterial<dim>::fields(std::size_t point, std::span<double> values) const {
  const PointState& state = points_[point];
  write_cell_fields(state.diagnostics, reached(state), cosserat_, state.cosserat, values);
}

template class ResidentMaterial<2>;
template class ResidentMaterial<3>;

}  // namespace polargrain::coupler
