// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "fem/material/stress_subspaces.hpp"

namespace polargrain::fem {

/// How a micro scale answers while the macro law does not flow, in unloading and on the way back
/// (docs/theory/plasticity.md, B.9): grains slide there too, so they are softer than at rest, lag behind, and contract.
struct UnloadingMode {
  double stiffness = 1.0;    ///< share of the elastic moduli of everything but the mean stress
  double contraction = 0.0;  ///< volume strain that makes no stress, over the norm of the other strain

  /// The strain whose elastic stress is that of the micro scale, and its derivative by the strain itself.
  template <int dim>
  struct Felt {
    ScaledVector<double, dim> strain;
    ScaledMatrix<double, dim> slope;
  };
  /// @param strain scaled @param parts which of the subspaces (stress_subspaces.hpp) the micro scale feels beside the
  ///   volume: 1, the symmetric deviator, or 3, all; the others stay elastic
  template <int dim = 2>
  [[nodiscard]] Felt<dim> felt(const ScaledVector<double, dim>& strain, std::size_t parts) const;
};

/// The unloading stiffness seen in one increment of a micro scale; empty where only the volume was strained. It is kept
/// between 0.02 and 2: an elastic law takes no more, and no softening.
template <int dim = 2>
std::optional<UnloadingMode> unloading_mode(const SubspaceModuli& moduli,
                                            const ScaledVector<double, dim>& strain,
                                            const ScaledVector<double, dim>& stress_increment);

}  // namespace polargrain::fem
