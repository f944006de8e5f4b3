// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <span>
#include <utility>

#include "coupler/cells/point_cell.hpp"
#include "dem/cell/cell_service.hpp"

namespace polargrain::dem {

using coupler::PlaneReply;
using coupler::PlaneRequest;

/// One engine, asked in the plane.
class PlaneCell {
 public:
  explicit PlaneCell(std::unique_ptr<CellService> cell) : cell_(std::move(cell)) {}
  [[nodiscard]] PlaneReply initial() const { return coupler::in_plane(cell_->initial()); }
  PlaneReply evaluate(const PlaneRequest& request) const {
    return coupler::in_plane(cell_->evaluate(coupler::in_space(request)));
  }

 private:
  std::unique_ptr<CellService> cell_;
};

/// A cell of discs, asked in their plane.
class PlaneDiscs : public PlaneCell {
 public:
  // Braces: the first is taken before the second is moved.
  explicit PlaneDiscs(std::unique_ptr<CellOfGrains> cell) : PlaneDiscs{*cell, std::move(cell)} {}
  [[nodiscard]] std::span<const Contact> contacts() const { return grains_.contacts(); }

 private:
  PlaneDiscs(const CellOfGrains& grains, std::unique_ptr<CellService> cell)
      : PlaneCell(std::move(cell)), grains_(grains) {}
  const CellOfGrains& grains_;
};

inline std::unique_ptr<PlaneDiscs> make_plane_cell(const CellDefinition& definition) {
  return std::make_unique<PlaneDiscs>(make_cell_service(definition));
}

}  // namespace polargrain::dem
