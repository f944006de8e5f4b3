// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>

#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/plane_cell.hpp"

namespace polargrain::coupler {

/// The measure of the cells of a material: the packing that all of them start from.
struct PackingAtStart {
  /// Share of the pressure of the packing below which the grains of a point count as parted.
  static constexpr double kParted = 1e-3;

  double contacts = 0.0;
  double pressure = 0.0;  ///< in the plane, Pa

  PackingAtStart() = default;
  explicit PackingAtStart(const PlaneReply& packing)
      : contacts(static_cast<double>(packing.diagnostics.contacts)),
        pressure(pressure_in_plane(packing.response.stress)) {}

  /// Contacts of a cell over those of the packing; 1 where the packing has no contacts.
  [[nodiscard]] double kept(const CellDiagnostics& cell) const {
    return contacts > 0.0 ? static_cast<double>(cell.contacts) / contacts : 1.0;
  }
  /// Below it grains have parted, Pa.
  [[nodiscard]] double least_pressure() const { return kParted * std::max(0.0, pressure); }
  /// The Cosserat part of a point at the start.
  [[nodiscard]] CosseratPart part() const {
    CosseratPart part;
    part.pressure = pressure;
    return part;
  }
};

}  // namespace polargrain::coupler
