// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>

#include "dem/engine/engine_part.hpp"

namespace polargrain::dem {

/// The loading of contacts by their cell beyond the motion of the grains; zero outside a cell.
class CellLoading {
 public:
  /// Every contact between grains is to see their spins turned by the share of a rate of curvature from the middle of the
  /// branch to either centre (docs/theory/grains.md, C.6, C.8). Laws that take spins past the contact (stock rolling
  /// models) do not feel it.
  /// @param rate (k,j) = d(micro-rotation k)/dx_j in a unit of time, in the frame of the box, rad/(m s): about e_1 to e_3, or
  /// of discs about e_3 alone
  template <int turns, int dim>
  void bend(const Eigen::Matrix<double, turns, dim>& rate) {
    rate_ = {};
    for (int k = 0; k < turns; ++k)
      for (int j = 0; j < dim; ++j) rate_[static_cast<std::size_t>(3 * (3 - turns + k) + j)] = rate(k, j);
    bends_ = !rate.isZero(0.0);
  }

  [[nodiscard]] bool bends() const { return bends_; }
  /// Row after row, rad/(m s).
  [[nodiscard]] const std::array<double, 9>& rate() const { return rate_; }
  /// By how much the micro-rotation about an axis grows along a vector of three components, rad/s.
  [[nodiscard]] double spin_along(const double* vector, int axis) const {
    const double* const row = &rate_[static_cast<std::size_t>(3 * axis)];
    return row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2];
  }

 private:
  std::array<double, 9> rate_{};
  bool bends_ = false;
};

/// The loading of the cell of this engine.
inline CellLoading& cell_loading(LAMMPS_NS::LAMMPS& lammps) {
  return part_of<CellLoading>(lammps);
}

}  // namespace polargrain::dem
