// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/automatic_cells.hpp"

#include <cstdint>
#include <utility>

#include "common/error.hpp"

namespace polargrain::coupler {

AutomaticCells::AutomaticCells(std::unique_ptr<CellMaterial> cells,
                               std::unique_ptr<ResidentMaterial> residents)
    : cells_(std::move(cells)), residents_(std::move(residents)) {}

void AutomaticCells::allocate(std::size_t points) {
  points_ = points;
  cells_->allocate(points);
  has_residents_ = is_explicit_ = false;
}

void AutomaticCells::allocate_residents() {
  if (!has_residents_) residents_->allocate(points_);
  has_residents_ = true;
}

void AutomaticCells::expect(const fem::Asking& asking) {
  if (asking.once != is_explicit_) asking.once ? pass_to_residents() : pass_to_cells();
  is_explicit_ = asking.once;
  active().expect(asking);
}

void AutomaticCells::pass_to_residents() {
  allocate_residents();
  std::vector<ResidentMaterial::PointState> points;
  for (const CellMaterial::PointState& point : cells_->committed())
    points.push_back(
        {point.cell.response.stress, point.cell.diagnostics, point.cell.state, {}, point.cosserat});
  residents_->take_over(std::move(points), cells_->points_at_limits());
}

void AutomaticCells::pass_to_cells() {
  std::vector<CellMaterial::PointState> points;
  for (const ResidentMaterial::PointState& point : residents_->settled()) {
    CellMaterial::PointState& cell = points.emplace_back();
    // The tangent of the packing is all that is known until iterations ask.
    cell.cell = residents_->at_rest();
    cell.cell.response.stress = point.stress;
    cell.cell.diagnostics = point.diagnostics;
    cell.cell.state = point.state;
    cell.cosserat = point.cosserat;
  }
  cells_->take_over(std::move(points), residents_->points_at_limits());
}

fem::Material<2>& AutomaticCells::active() {
  if (is_explicit_) return *residents_;
  return *cells_;
}
const fem::Material<2>& AutomaticCells::active() const {
  return const_cast<AutomaticCells&>(*this).active();
}

std::string AutomaticCells::at_limits() const {
  return is_explicit_ ? residents_->at_limits() : cells_->at_limits();
}

StatePointer AutomaticCells::grains_of(std::size_t point) const {
  return is_explicit_ ? residents_->grains_of(point) : cells_->grains_of(point);
}

void AutomaticCells::save(ArchiveWriter& archive) const {
  const std::array<std::int64_t, 1> method{is_explicit_ ? 1 : 0};
  archive.write("explicit", std::span<const std::int64_t>(method));
  active().save(archive);
}

void AutomaticCells::restore(ArchiveReader& archive) {
  const std::vector<std::int64_t> method = archive.integers("explicit");
  if (method.size() != 1) throw RunError("'explicit' says nothing about the method of the cells");
  is_explicit_ = method[0] != 0;
  if (is_explicit_) allocate_residents();
  active().restore(archive);
}

}  // namespace polargrain::coupler
