// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/space_cell_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/error.hpp"
#include "common/record_archive.hpp"
#include "common/record_table.hpp"
#include "coupler/cells/packing_at_start.hpp"
#include "fem/material/polar_decomposition.hpp"

namespace polargrain::coupler {
namespace {

bool is_zero(const Increment<3>& increment) {
  return increment.displacement_gradient.isZero(0.0) && increment.rotation.isZero(0.0) &&
         increment.curvature.isZero(0.0);
}

/// increment_for_cell (cell_increment.hpp) in space. @param free grains turn as they like: no rotation, no curvature
CellIncrement increment_for_cell(const Increment<3>& of_point, bool free) {
  CellIncrement felt = of_point;
  if (of_point.configuration == Configuration::fixed) {
    const Eigen::Matrix3d& h = of_point.displacement_gradient;
    felt.displacement_gradient = 0.5 * (h + h.transpose());
    felt.rotation -= fem::axial(h);
  }
  if (free) {
    felt.rotation.setZero();
    felt.curvature.setZero();
  }
  return felt;
}

/// noise_of (cell_noise.hpp) in space.
StressNoise noise_of(const Vector18& stress, const CellDiagnostics& cell, double mean_radius) {
  if (!(cell.coordination_number > 0.0) || cell.contacts == 0) return {};
  const double grains = 2.0 * static_cast<double>(cell.contacts) / cell.coordination_number;
  const double scale = std::abs(mean_pressure(stress)) / std::sqrt(grains);
  const double of_moments = cell.unbalanced_moment_ratio * scale;
  return {.symmetric = cell.unbalanced_force_ratio * scale,
          .skew = mean_radius > 0.0 ? of_moments : 0.0,
          .couple = of_moments * mean_radius};
}

}  // namespace

SpaceCellMaterial::SpaceCellMaterial(Pool& pool, std::uint32_t definition,
                                     const std::optional<CosseratParameters>& cosserat,
                                     const std::string& note)
    : pool_(pool), definition_(definition), cosserat_(cosserat), at_limits_(cosserat.has_value()) {
  if (!note.empty()) notes_.push_back(note);
  const CellDefinition& cell = pool.definition(definition);
  if (cell.packing.dimension != 3) throw RunError("elements in space need cells of spheres");
  if (cell.control.rotations == CellRotations::controlled) mean_radius_ = cell.packing.mean_radius();
}

SpaceCellMaterial::PointState SpaceCellMaterial::taken(CellReply reply) {
  PointState point;
  point.cell.stress = reply.response.components();
  point.cell.tangent = reply.response.tangent;
  static_cast<Trust&>(point.cell) = reply.response;
  point.diagnostics = reply.diagnostics;
  point.state = std::move(reply.state);
  return point;
}

void SpaceCellMaterial::allocate(std::size_t points) {
  PointState start = taken(pool_.initial(definition_));
  if (start.cell.quality == Quality::failed)
    throw RunError(fmt::format("the packing of a cell cannot be brought to rest: {}", start.cell.message));
  std::istringstream remarks(std::exchange(start.cell.message, {}));
  for (std::string remark; std::getline(remarks, remark);) notes_.push_back(remark);
  contacts_ = static_cast<double>(start.diagnostics.contacts);
  pressure_ = mean_pressure(start.cell.stress);
  start.cosserat.pressure = pressure_;
  committed_.assign(points, start);
  trial_ = committed_;
}

void SpaceCellMaterial::evaluate(std::span<const Increment<3>> increments, std::span<Response<3>> responses) {
  std::vector<PoolRequest> requests;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    trial_[point] = committed_[point];
    if (is_zero(increments[point])) continue;
    requests.push_back(
        {definition_,
         {committed_[point].state, increment_for_cell(increments[point], cosserat_.has_value())},
         point});
  }
  std::vector<CellReply> replies = pool_.evaluate(requests);
  for (std::size_t r = 0; r < replies.size(); ++r) {
    PointState& point = trial_[*requests[r].point];
    const SpaceCosseratPart part = point.cosserat;
    point = taken(std::move(replies[r]));
    point.cosserat = part;
  }
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    PointState& state = trial_[point];
    if (!cosserat_) {
      responses[point] = state.cell;
    } else if (is_zero(increments[point])) {
      responses[point] = state.cosserat.joined_to(state.cell, *cosserat_);
    } else {
      const double kept = contacts_ > 0.0 ? static_cast<double>(state.diagnostics.contacts) / contacts_ : 1.0;
      responses[point] = state.cosserat.follow(increments[point], state.cell, *cosserat_, kept);
    }
    responses[point].noise = noise_of(state.cell.stress, state.diagnostics, mean_radius_);
  }
}

void SpaceCellMaterial::commit() {
  std::vector<StatePointer> states;
  for (const PointState& point : trial_) states.push_back(point.state);
  const std::vector<StatePointer> here = pool_.collect(states);
  std::vector<LimitsReached> limits;
  for (std::size_t point = 0; point < trial_.size(); ++point) {
    trial_[point].state = here[point];
    limits.push_back(reached(trial_[point]));
  }
  committed_ = trial_;
  at_limits_.count(limits);
}

double SpaceCellMaterial::least_pressure() const {
  return PackingAtStart::kParted * std::max(0.0, pressure_);
}

LimitsReached SpaceCellMaterial::reached(const PointState& point) const {
  if (cosserat_) return point.cosserat.reached(*cosserat_, least_pressure());
  return {.parted = mean_pressure(point.cell.stress) <= least_pressure()};
}

void SpaceCellMaterial::save(ArchiveWriter& archive) const {
  write_records(archive, "points", std::span<const PointState>(committed_));
  at_limits_.save(archive);
}

void SpaceCellMaterial::restore(ArchiveReader& archive) {
  committed_ = read_records<PointState>(archive, "points", committed_.size());
  trial_ = committed_;
  at_limits_.restore(archive);
}

std::vector<std::string> SpaceCellMaterial::field_names() const {
  return joined_names(names_of_columns<CellDiagnostics>(), names_of_limit_fields(cosserat_.has_value()));
}

void SpaceCellMaterial::fields(std::size_t point, std::span<double> values) const {
  const PointState& state = committed_[point];
  const auto rest = std::ranges::copy(values_of(state.diagnostics), values.begin()).out;
  const LimitsReached limits = reached(state);
  auto to = rest;
  *to++ = limits.parted ? 1.0 : 0.0;
  if (!cosserat_) return;
  *to++ = state.cosserat.skew_mobilisation(*cosserat_);
  *to++ = state.cosserat.couple_mobilisation(*cosserat_);
}

}  // namespace polargrain::coupler
