// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include "coupler/case/cell_script.hpp"
#include "coupler/case/section.hpp"
#include "fem/material/elastic.hpp"

namespace polargrain::coupler {

/// Reads Gc and lc of a law, in space alpha and beta too; a classical continuum has no use for them, and does not ask.
template <int dim>
void read_cosserat_moduli(Section& section, const CaseFiles& files, fem::ElasticParameters<dim>& parameters) {
  const auto value = [&](const char* key, Dimension dimension) {
    return files.cosserat ? section.quantity(key, dimension, Limit::not_negative)
                          : section.quantity_if(key, dimension, Limit::not_negative).value_or(0.0);
  };
  parameters.cosserat_shear_modulus = value("Gc", Dimension::pressure);
  parameters.internal_length = value("lc", Dimension::length);
  if (!files.cosserat) return;
  if ((dim == 3 || files.one_point) && section.find("lc") != nullptr && parameters.internal_length == 0.0)
    section.fault(
        "lc",
        fmt::format(
            "lc: must be above zero {}: without couple stiffness elements with fewer points than their nodes "
            "have motions that cost no energy; give lc, or set 'continuum: cauchy'",
            dim == 3 ? "in space" : "with Q4R"));
  if (dim == 2) return;
  parameters.couple_trace_ratio = section.quantity_or("alpha", Dimension::number, Limit::any, 0.0);
  parameters.couple_transpose_ratio = section.quantity_or("beta", Dimension::number, Limit::any, 0.0);
}

/// Reads E, nu, Gc, lc and the isotropic initial stress `confining`.
template <int dim>
void read_elastic_parameters(Section& section, const CaseFiles& files,
                             fem::ElasticParameters<dim>& parameters) {
  parameters.young_modulus = section.quantity("E", Dimension::pressure, Limit::positive);
  parameters.poisson_ratio = section.quantity("nu", Dimension::number, Limit::any);
  read_cosserat_moduli(section, files, parameters);
  const double confining = section.quantity_or("confining", Dimension::pressure, Limit::any, 0.0);
  for (int i = 0; i < dim; ++i) parameters.initial_stress(Cosserat<dim>::stress_place(i, i)) = -confining;
  if constexpr (dim == 2) parameters.initial_stress(k33) = -confining;
}

}  // namespace polargrain::coupler
