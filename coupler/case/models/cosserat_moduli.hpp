// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/cell_script.hpp"
#include "coupler/case/section.hpp"
#include "fem/material/elastic.hpp"

namespace polargrain::coupler {

/// Reads Gc and lc of a law; a classical continuum has no use for them, and does not ask.
inline void read_cosserat_moduli(Section& section, const CaseFiles& files,
                                 fem::ElasticParameters& parameters) {
  const auto value = [&](const char* key, Dimension dimension) {
    return files.cosserat ? section.quantity(key, dimension, Limit::not_negative)
                          : section.quantity_or(key, dimension, Limit::not_negative, 0.0);
  };
  parameters.cosserat_shear_modulus = value("Gc", Dimension::pressure);
  parameters.internal_length = value("lc", Dimension::length);
}

}  // namespace polargrain::coupler
