// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>

#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/point_cell.hpp"

namespace polargrain::coupler {

/// The measure of the cells of a material: the packing that all of them start from.
template <int dim>
struct PackingAtStart {
  /// Share of the pressure of the packing below which the grains of a point count as parted.
  static constexpr double kParted = 1e-3;

  double contacts = 0.0;
  Pressures<dim> pressures = Pressures<dim>::Zero();  ///< Pa

  PackingAtStart() = default;
  explicit PackingAtStart(const PointReply<dim>& packing)
      : contacts(static_cast<double>(packing.diagnostics.contacts)),
        pressures(pressures_of<dim>(packing.response.stress)) {}

  /// Contacts of a cell over those of the packing; 1 where the packing has no contacts.
  [[nodiscard]] double kept(const CellDiagnostics& cell) const {
    return contacts > 0.0 ? static_cast<double>(cell.contacts) / contacts : 1.0;
  }
  /// The pressure of the dimension, Pa.
  [[nodiscard]] double pressure() const { return part().pressure(); }
  /// Below it grains have parted, Pa.
  [[nodiscard]] double least_pressure() const { return kParted * std::max(0.0, pressure()); }
  /// The Cosserat part of a point at the start.
  [[nodiscard]] CosseratPart<dim> part() const {
    CosseratPart<dim> part;
    part.pressures = pressures;
    return part;
  }
  /// The same of a point whose cell begins elsewhere.
  [[nodiscard]] CosseratPart<dim> part_of(const PointReply<dim>& cell) const {
    CosseratPart<dim> part;
    part.pressures = pressures_of<dim>(cell.response.stress);
    part.contacts_kept = kept(cell.diagnostics);
    return part;
  }
};

}  // namespace polargrain::coupler
