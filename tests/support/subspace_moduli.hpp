// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/material/stress_subspaces.hpp"

namespace polargrain::fem::test {

/// Of a stiff sand with an internal length of 1 mm.
inline SubspaceModuli moduli() {
  ElasticParameters<2> elastic;
  elastic.young_modulus = 50e6;
  elastic.poisson_ratio = 0.2;
  elastic.cosserat_shear_modulus = 10e6;
  elastic.internal_length = 1e-3;
  return {elastic, {}};
}

}  // namespace polargrain::fem::test
