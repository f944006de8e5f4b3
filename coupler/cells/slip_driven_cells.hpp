// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <string>
#include <utility>

#include "coupler/cells/grains_of_points.hpp"
#include "fem/material/slip_driven_material.hpp"

namespace polargrain::coupler {

/// A material with grains whose slips are spread; the grains can be looked at as before.
template <int dim>
class SlipDrivenCells final : public fem::SlipDrivenMaterial<dim>, public GrainsOfPoints {
 public:
  /// @param material not null; a fem::Material<dim> that shows grains
  template <class Cells>
  explicit SlipDrivenCells(const std::shared_ptr<Cells>& material)
      : fem::SlipDrivenMaterial<dim>(material), grains_(material) {}

  [[nodiscard]] StatePointer grains_of(std::size_t point) const override { return grains_->grains_of(point); }
  [[nodiscard]] std::string at_limits() const override { return grains_->at_limits(); }

 private:
  std::shared_ptr<const GrainsOfPoints> grains_;
};

/// A material with grains, its slips its own or those of the nodes. @param cells not null
template <int dim, class Cells>
std::shared_ptr<fem::Material<dim>> with_slips(const std::shared_ptr<Cells>& cells, bool spread) {
  if (spread) return std::make_shared<SlipDrivenCells<dim>>(cells);
  return cells;
}

}  // namespace polargrain::coupler
