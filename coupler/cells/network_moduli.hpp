// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>

#include "common/cell.hpp"
#include "coupler/cells/cosserat_part.hpp"

namespace polargrain::coupler {

class Pool;

/// Isotropic Cosserat moduli of a packing at rest: of its contact network, condensed onto its own equilibrium
/// with no contact sliding (docs/theory/grains.md, C.7).
struct NetworkModuli {
  double shear = 0.0;           ///< G, Pa: mean over all directions in the plane
  double cosserat_shear = 0.0;  ///< Gc, Pa
  double couple = 0.0;          ///< B = dm / d kappa, N
  double poisson = 0.0;         ///< nu of plane strain: lambda / (2 (lambda + G))

  [[nodiscard]] double length() const;  ///< sqrt(B / 2G), m; 0 without couple stresses
  [[nodiscard]] std::string text() const;
};

/// @param tangent d stress / d strain with the mean rotation prescribed (CellTangent::cosserat)
NetworkModuli network_moduli(const Matrix7& tangent);

/// The same of a packing under its script, as a worker finds it. @throws RunError when it cannot be brought to rest
NetworkModuli network_moduli(Pool& pool, CellDefinition definition);

/// The choice of a limit in a case: a value, no limit, or not given.
struct LimitChoice {
  std::optional<double> value = {};
  bool none = false;
  [[nodiscard]] bool is_open() const { return !value && !none; }
};

/// The choice of the Cosserat part in a case; empty where the packing is to tell.
struct CosseratChoice {
  std::optional<double> shear_modulus;           ///< Pa
  std::optional<double> cosserat_shear_modulus;  ///< Pa
  std::optional<double> internal_length;         ///< m
  LimitChoice skew_limit;                        ///< of the pressure
  LimitChoice plastic_length;                    ///< m
  bool has_rotations = true;  ///< of the continuum: a classical one has no use for a length or limits
};

/// Fills in the values left to the packing by asking a worker for its network, and by taking two copies of it to their limits
/// where rotations are free. A plastic length that is left open becomes sqrt(2/3) M lc, with M of the packing: the limit that
/// the law of `informed` has (docs/theory/plasticity.md, B.9).
/// @param note gets a line for each value found @throws RunError where a modulus of the packing is not positive
CosseratParameters resolved(const CosseratChoice& choice, Pool& pool, const CellDefinition& definition,
                            std::string& note);

}  // namespace polargrain::coupler
