// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/cell_increment.hpp"
#include "common/cell_response.hpp"

namespace polargrain::element {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Order of the components of symmetric stress, and of the strains that work on them, in tests of one point. x2 is the
/// axis of a specimen, x1 and x3 lie across it.
enum Place : int { k11, k22, k33, k12, k13, k23 };

inline constexpr std::array<const char*, 6> kPlaceNames{"11", "22", "33", "12", "13", "23"};
/// First and second index of each.
inline constexpr std::array<std::array<int, 2>, 6> kIndices{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// In which directions a material can be strained, and which stresses it tells.
enum class Room {
  discs,         ///< strains and stresses of the plane (11, 22, 12)
  plane_strain,  ///< the same strains; stresses of the plane and 33
  axes,          ///< strains and stresses of the plane and 33
  space          ///< all six
};

/// Whether a material can be strained in a component.
constexpr bool can_strain(Room room, int place) {
  return place == k11 || place == k22 || place == k12 || room == Room::space ||
         (room == Room::axes && place == k33);
}

/// Whether it tells a component of the stress.
constexpr bool tells_stress(Room room, int place) {
  return place == k11 || place == k22 || place == k12 || room == Room::space ||
         (room != Room::discs && place == k33);
}

/// One material point, as a test of one element drives it. It keeps a committed state; evaluate answers from there and
/// leaves a trial one, commit takes that.
class MaterialPoint {
 public:
  virtual ~MaterialPoint() = default;
  [[nodiscard]] virtual Room room() const = 0;
  /// Whether increments are about the start of each step and multiply (grains), or about the start of the test and add
  /// up (laws in small deformation).
  [[nodiscard]] virtual bool is_large() const = 0;
  /// Stress and tangent before anything has moved.
  virtual CellResponse initial() = 0;
  /// The answer to an increment from the committed state; Quality::failed where it cannot answer.
  virtual CellResponse evaluate(const CellIncrement& increment) = 0;
  virtual void commit() = 0;
  /// Names of further fields of the committed state of the material, and the values.
  [[nodiscard]] virtual std::vector<std::string> field_names() const { return {}; }
  [[nodiscard]] virtual std::vector<double> fields() const { return {}; }
};

/// The symmetric part of a stress, in the order of Place.
inline Vector6 six(const Eigen::Matrix3d& stress) {
  Vector6 values;
  for (int place = 0; place < 6; ++place) {
    const auto [i, j] = kIndices[place];
    values(place) = 0.5 * (stress(i, j) + stress(j, i));
  }
  return values;
}

}  // namespace polargrain::element
