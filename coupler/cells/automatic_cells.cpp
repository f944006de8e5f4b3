// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/automatic_cells.hpp"

#include <cstdint>
#include <utility>

#include "common/error.hpp"

namespace polargrain::coupler {

template <int dim>
AutomaticCells<dim>::AutomaticCells(std::unique_ptr<CellMaterial<dim>> cells,
                                    std::unique_ptr<ResidentMaterial<dim>> residents)
    : cells_(std::move(cells)), residents_(std::move(residents)) {}

template <int dim>
void AutomaticCells<dim>::allocate(std::size_t points) {
  points_ = points;
  cells_->allocate(points);
  has_residents_ = is_explicit_ = false;
}

template <int dim>
void AutomaticCells<dim>::allocate_residents() {
  if (!has_residents_) residents_->allocate(points_);
  has_residents_ = true;
}

template <int dim>
void AutomaticCells<dim>::expect(const fem::Asking& asking) {
  if (asking.once != is_explicit_) asking.once ? pass_to_residents() : pass_to_cells();
  is_explicit_ = asking.once;
  active().expect(asking);
}

template <int dim>
void AutomaticCells<dim>::pass_to_residents() {
  allocate_residents();
  std::vector<typename ResidentMaterial<dim>::PointState> points;
  for (const typename CellMaterial<dim>::PointState& point : cells_->committed())
    points.push_back(
        {point.cell.response.stress, point.cell.diagnostics, point.cell.state, {}, point.cosserat});
  residents_->take_over(std::move(points), cells_->points_at_limits());
}

template <int dim>
void AutomaticCells<dim>::pass_to_cells() {
  std::vector<typename CellMaterial<dim>::PointState> points;
  for (const typename ResidentMaterial<dim>::PointState& point : residents_->settled()) {
    typename CellMaterial<dim>::PointState& cell = points.emplace_back();
    // The tangent of the packing is all that is known until iterations ask.
    cell.cell = residents_->at_rest();
    cell.cell.response.stress = point.stress;
    cell.cell.diagnostics = point.diagnostics;
    cell.cell.state = point.state;
    cell.cosserat = point.cosserat;
  }
  cells_->take_over(std::move(points), residents_->points_at_limits());
}

template <int dim>
fem::Material<dim>& AutomaticCells<dim>::active() {
  if (is_explicit_) return *residents_;
  return *cells_;
}
template <int dim>
const fem::Material<dim>& AutomaticCells<dim>::active() const {
  return const_cast<AutomaticCells<dim>&>(*this).active();
}

template <int dim>
std::string AutomaticCells<dim>::at_limits() const {
  return is_explicit_ ? residents_->at_limits() : cells_->at_limits();
}

template <int dim>
StatePointer AutomaticCells<dim>::grains_of(std::size_t point) const {
  return is_explicit_ ? residents_->grains_of(point) : cells_->grains_of(point);
}

template <int dim>
void AutomaticCells<dim>::save(ArchiveWriter& archive) const {
  const std::array<std::int64_t, 1> method{is_explicit_ ? 1 : 0};
  archive.write("explicit", std::span<const std::int64_t>(method));
  active().save(archive);
}

template <int dim>
void AutomaticCells<dim>::restore(ArchiveReader& archive) {
  const std::vector<std::int64_t> method = archive.integers("explicit");
  if (method.size() != 1) throw RunError("'explicit' says nothing about the method of the cells");
  is_explicit_ = method[0] != 0;
  if (is_explicit_) allocate_residents();
  active().restore(archive);
}

template class AutomaticCells<2>;
template class AutomaticCells<3>;

}  // namespace polargrain::coupler
