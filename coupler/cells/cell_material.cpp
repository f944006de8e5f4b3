// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/error.hpp"
#include "common/record_archive.hpp"
#include "common/record_table.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cell_noise.hpp"

namespace polargrain::coupler {

CellMaterial::CellMaterial(Pool& pool, std::uint32_t definition,
                           const std::optional<CosseratParameters>& cosserat, const std::string& note)
    : calls_(calls_of(pool, definition)), cosserat_(cosserat) {
  if (!note.empty()) notes_.push_back(note);
  const CellDefinition& cell = pool.definition(definition);
  if (cell.control.rotations == CellRotations::controlled) mean_radius_ = cell.packing.mean_radius();
}

void CellMaterial::allocate(std::size_t points) {
  PointState start;
  start.cell = packing_at_rest(calls_, notes_);
  committed_.assign(points, start);
  trial_ = committed_;
}

void CellMaterial::evaluate(std::span<const Increment> increments, std::span<Response> responses) {
  std::vector<PlaneRequest> requests;
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    trial_[point] = committed_[point];
    if (is_zero(increments[point])) continue;
    requests.push_back({committed_[point].cell.state, increment_for_cell(increments[point])});
    points.push_back(point);
  }
  std::vector<PlaneReply> replies = calls_.evaluate(requests, points);
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
      responses[point] = state.cosserat.follow(increments[point], state.cell.response, *cosserat_);
    }
    responses[point].noise = noise_of(state.cell, mean_radius_);
  }
}

void CellMaterial::commit() {
  std::vector<StatePointer*> states;
  for (PointState& point : trial_) states.push_back(&point.cell.state);
  collect(calls_, states);
  committed_ = trial_;
}

void CellMaterial::save(ArchiveWriter& archive) const {
  write_records(archive, "points", std::span<const PointState>(committed_));
}

void CellMaterial::restore(ArchiveReader& archive) {
  committed_ = read_records<PointState>(archive, "points", committed_.size());
  trial_ = committed_;
}

std::vector<std::string> CellMaterial::field_names() const {
  return names_of_columns<CellDiagnostics>();
}

void CellMaterial::fields(std::size_t point, std::span<double> values) const {
  std::ranges::copy(values_of(committed_[point].cell.diagnostics), values.begin());
}

}  // namespace polargrain::coupler
