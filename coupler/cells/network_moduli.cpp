// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/network_moduli.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "common/error.hpp"
#include "coupler/cells/cell_calls.hpp"
#include "coupler/cells/cell_limits.hpp"
#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

double NetworkModuli::length() const {
  return couple > 0.0 && shear > 0.0 ? std::sqrt(couple / (2.0 * shear)) : 0.0;
}

std::string NetworkModuli::text() const {
  return fmt::format("G {:.4g} MPa, Gc {:.4g} MPa, nu {:.3g}, couple modulus {:.4g} N (length {:.3g} mm)",
                     1e-6 * shear, 1e-6 * cosserat_shear, poisson, couple, 1e3 * length());
}

NetworkModuli network_moduli(const Matrix7& c) {
  NetworkModuli moduli;
  const double axial = 0.25 * (c(k11, k11) + c(k22, k22));
  const double across = 0.25 * (c(k11, k22) + c(k22, k11));
  const double same = 0.25 * (c(k12, k12) + c(k21, k21));
  const double other = 0.25 * (c(k12, k21) + c(k21, k12));
  moduli.shear = 0.5 * (axial - across + same + other);
  moduli.cosserat_shear = same - other;
  moduli.couple = 0.5 * (c(kCurvature1, kCurvature1) + c(kCurvature2, kCurvature2));
  const double bulk = axial + across;  // lambda + G
  moduli.poisson = (bulk - moduli.shear) / (2.0 * bulk);
  return moduli;
}

NetworkModuli network_moduli(Pool& pool, CellDefinition definition) {
  definition.control.tangent = CellTangent::cosserat;
  std::vector<std::string> remarks;  // the material's own cell makes them too
  return network_moduli(packing_at_rest(calls_of(pool, pool.define(definition)), remarks).response.tangent);
}

namespace {

/// The packing is sheared and turned and never bent: any rolling model will do, which a cell with this tangent allows.
CellLimits limits_of_free(Pool& pool, CellDefinition definition) {
  definition.control.rotations = CellRotations::controlled;
  definition.control.tangent = CellTangent::cosserat;
  const CellCalls calls = calls_of(pool, pool.define(std::move(definition)));
  std::vector<std::string> remarks;  // the material's own cell makes them too
  return limits_without_bending(calls, packing_at_rest(calls, remarks));
}

/// Fills in the limits of skew stress and couple stress. @returns a line that says what was found, or nothing
std::string resolve_limits(const CosseratChoice& choice, Pool& pool, const CellDefinition& definition,
                           CosseratParameters& parameters) {
  parameters.skew_limit = choice.skew_limit.value;
  parameters.plastic_length = choice.plastic_length.value;
  if (definition.control.rotations != CellRotations::free) return {};
  if (!choice.skew_limit.is_open() && !choice.plastic_length.is_open()) return {};
  const CellLimits limits = limits_of_free(pool, definition);
  std::string note = "limits of the packing:";
  if (choice.skew_limit.is_open()) {
    parameters.skew_limit = limits.skew;
    note += fmt::format(" skew stress {:.4g} times the pressure", limits.skew);
    if (!(limits.skew > 0.0))
      note += " (its grains bear no skew stress: the micro-rotation is held numerically)";
  }
  if (choice.plastic_length.is_open()) {
    parameters.plastic_length = std::sqrt(2.0 / 3.0) * limits.friction * parameters.internal_length;
    note += fmt::format("{} couple stress {:.4g} mm times the pressure (lp = sqrt(2/3) M lc, M {:.4g})",
                        choice.skew_limit.is_open() ? "," : "", 1e3 * *parameters.plastic_length,
                        limits.friction);
  }
  return note;
}

}  // namespace

CosseratParameters resolved(const CosseratChoice& choice, Pool& pool, const CellDefinition& definition,
                            std::string& note) {
  NetworkModuli packing;
  if (!choice.shear_modulus || !choice.cosserat_shear_modulus || !choice.internal_length) {
    packing = network_moduli(pool, definition);
    note = "moduli of the packing at rest: " + packing.text();
    const auto check = [&](const char* key, bool asked, double modulus) {
      if (!asked || modulus > 0.0) return;
      const std::string remedy = definition.control.rotations == CellRotations::controlled
                                     ? "'model: informed' with 'rotations: controlled' needs grains with "
                                       "rolling resistance or of unequal radii"
                                     : fmt::format("give {} a value", key);
      throw RunError(fmt::format("material '{}': {} cannot come from the packing, whose network has {}; {}",
                                 definition.name, key, packing.text(), remedy));
    };
    check("G", !choice.shear_modulus, packing.shear);
    check("Gc", !choice.cosserat_shear_modulus, packing.cosserat_shear);
    check("lc", !choice.internal_length, packing.couple);
  }
  CosseratParameters parameters;
  parameters.shear_modulus = choice.shear_modulus.value_or(packing.shear);
  parameters.cosserat_shear_modulus = choice.cosserat_shear_modulus.value_or(packing.cosserat_shear);
  parameters.internal_length = choice.internal_length.value_or(packing.length());
  if (const std::string limits = resolve_limits(choice, pool, definition, parameters); !limits.empty())
    note += (note.empty() ? "" : "; ") + limits;
  return parameters;
}

}  // namespace polargrain::coupler
