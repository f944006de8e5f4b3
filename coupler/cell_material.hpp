// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "coupler/pool/pool.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

/// The part of a point's answer that its cell does not give (docs/theory.md, C.6 mode 1 and A.4).
struct CosseratParameters {
  double shear_modulus = 0.0;           ///< G, Pa
  double cosserat_shear_modulus = 0.0;  ///< Gc, Pa
  double internal_length = 0.0;         ///< lc, m; the couple modulus is 2 G lc^2
};

/// A material whose symmetric stress comes from boxes of grains, one a point, evaluated by the workers of a
/// pool. The skew stress and the couple stresses accumulate from the increments with the Cosserat moduli:
///
///     s21 - s12  +=  2 Gc (eps21 - eps12)        m_i  +=  2 G lc^2 kappa_i
///
/// They are not turned with the material: both are zero unless the micro-rotation differs from the rotation
/// of the continuum or varies in space, and stay small beside the stress of the grains.
class CellMaterial : public fem::Material {
 public:
  /// @param pool must outlive the material @param definition from Pool::define
  CellMaterial(Pool& pool, std::uint32_t definition, const CosseratParameters& cosserat);

  /// Asks for the packing at rest, once; every point starts from it.
  void allocate(std::size_t points) override;
  /// Sends the increments of all points to the pool at once. A point whose increment is zero keeps its
  /// committed answer: nothing has happened to its grains.
  void evaluate(std::span<const Increment> increments, std::span<Response> responses) override;
  void commit() override { committed_ = trial_; }
  void revert() override { trial_ = committed_; }

  /// void_ratio, coordination_number, unbalanced_force_ratio, sliding_fraction, dem_steps
  [[nodiscard]] std::vector<std::string> field_names() const override;
  void fields(std::size_t point, std::span<double> values) const override;

 private:
  struct PointState {
    CellReply cell;                                           ///< the cell's own last answer, with its state
    double skew_stress = 0.0;                                 ///< s21 - s12, Pa
    Eigen::Vector2d couple_stress = Eigen::Vector2d::Zero();  ///< N/m
  };

  void accumulate(const Increment& increment, PointState& point) const;
  [[nodiscard]] Response combined(const PointState& point) const;

  Pool& pool_;
  std::uint32_t definition_;
  CosseratParameters cosserat_;
  std::vector<PointState> committed_;
  std::vector<PointState> trial_;
};

}  // namespace polargrain::coupler
