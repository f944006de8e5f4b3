// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "common/cell.hpp"
#include "dem/cell/cell_service.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain {

/// A cell led by Newton's method with its own tangent, without finite elements. Stresses and strains in a
/// plane are (11, 22, 12), Pa, tension positive; the shear strain is h12 = h21.
class DrivenCell {
 public:
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;

  struct Limits {
    double tolerance = 0.0;  ///< of each given stress, Pa
    int iterations = 20;
    double largest_strain = 1e-3;  ///< of a correction
  };

  explicit DrivenCell(const CellDefinition& definition)
      : cell_(dem::make_cell_service(definition)), at_(cell_.initial()) {}
  DrivenCell(const CellDefinition& definition, coupler::PlaneReply at)
      : cell_(dem::make_cell_service(definition)), at_(std::move(at)) {}

  static Vector stress(const Response<2>& response) {
    return {response.stress(k11), response.stress(k22), 0.5 * (response.stress(k12) + response.stress(k21))};
  }
  static Matrix tangent(const Response<2>& response) {
    constexpr std::array<int, 3> kRows{k11, k22, k12};
    Matrix made;
    for (int i = 0; i < 3; ++i) {
      const auto row = response.tangent.row(kRows[static_cast<std::size_t>(i)]);
      made.row(i) << row(k11), row(k22), row(k12) + row(k21);
    }
    return made;
  }
  static Eigen::Matrix2d gradient(const Vector& strain) {
    return (Eigen::Matrix2d() << strain(0), strain(2), strain(2), strain(1)).finished();
  }

  /// The answer of the cell to a strain from where it is; it stays there.
  coupler::PlaneReply answer(const Vector& strain) {
    coupler::PlaneRequest request;
    request.state = at_.state;
    request.increment.displacement_gradient = gradient(strain);
    coupler::PlaneReply reply = cell_.evaluate(request);
    ++evaluations_;
    dem_steps_ += reply.diagnostics.dem_steps;
    return reply;
  }

  /// Goes to where each component is the stress or the strain that is given. @returns whether it got there
  bool go(const Vector& given, const std::array<bool, 3>& is_stress, const Limits& limits) {
    Vector strain = Vector::Zero();
    coupler::PlaneReply trial = at_;
    for (int iteration = 0; iteration <= limits.iterations; ++iteration) {
      Matrix matrix = tangent(trial.response);
      Vector residual = given - stress(trial.response);
      bool there = iteration > 0 && trial.response.quality == Quality::good;
      for (int i = 0; i < 3; ++i) {
        if (is_stress[static_cast<std::size_t>(i)]) {
          there = there && std::abs(residual(i)) <= limits.tolerance;
        } else {
          matrix.row(i) = Vector::Unit(i).transpose();
          residual(i) = given(i) - strain(i);
        }
      }
      if (there) {
        at_ = std::move(trial);
        return true;
      }
      Vector correction = matrix.partialPivLu().solve(residual);
      if (!correction.allFinite()) return false;
      const double size = correction.norm();
      if (size > limits.largest_strain) correction *= limits.largest_strain / size;
      strain += correction;
      trial = answer(strain);
      if (trial.response.quality == Quality::failed) return false;
    }
    return false;
  }

  [[nodiscard]] const coupler::PlaneReply& at() const { return at_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }
  [[nodiscard]] std::int64_t dem_steps() const { return dem_steps_; }

 private:
  dem::PlaneCell cell_;
  coupler::PlaneReply at_;
  int evaluations_ = 0;
  std::int64_t dem_steps_ = 0;
};

}  // namespace polargrain
