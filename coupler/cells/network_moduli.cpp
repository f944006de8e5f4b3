// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/network_moduli.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
  return network_moduli(
      packing_at_rest(calls_of<2>(pool, pool.define(definition)), remarks).response.tangent);
}

namespace {

/// Damping of the copy that is turned. Where all contacts slide, grains that ring let go in turns: at half of this and
/// less the skew stress is 0.5 to 0.97 of what contacts bear (dem_limits_test). The sheared copy keeps the damping of the run.
constexpr double kDampingToTurn = 0.5;

/// The packing is sheared and turned and never bent: any rolling model will do, which a cell with this tangent allows.
CellLimits limits_of_free(Pool& pool, CellDefinition definition) {
  definition.control.rotations = CellRotations::controlled;
  definition.control.tangent = CellTangent::cosserat;
  const CellCalls<2> to_shear = calls_of<2>(pool, pool.define(definition));
  definition.control.damping = std::max(definition.control.damping, kDampingToTurn);
  const CellCalls<2> to_turn = calls_of<2>(pool, pool.define(std::move(definition)));
  std::vector<std::string> remarks;  // the material's own cell makes them too
  return limits_without_bending(to_shear, packing_at_rest(to_shear, remarks), to_turn,
                                packing_at_rest(to_turn, remarks));
}

/// Fills in the limits of skew stress and couple stress. @returns a line that says what was found, or nothing
std::string resolve_limits(const CosseratChoice& choice, Pool& pool, const CellDefinition& definition,
                           CosseratParameters& parameters) {
  parameters.skew_limit = choice.skew_limit.value;
  parameters.plastic_length = choice.plastic_length.value;
  if (definition.control.rotations != CellRotations::free) return {};
  if (!choice.skew_limit.is_open() && !choice.plastic_length.is_open()) return {};
  const CellLimits limits = limits_of_free(pool, definition);
  std::vector<std::string> found;
  if (choice.skew_limit.is_open()) {
    if (limits.not_turned.empty()) {
      parameters.skew_limit = limits.skew;
      found.push_back(fmt::format("skew stress {:.4g} times the pressure{}", limits.skew,
                                  limits.skew > 0.0 ? "" : " (the micro-rotation is held numerically)"));
    } else {
      found.push_back(fmt::format("skew stress without a limit, as the packing cannot be turned ({})",
                                  limits.not_turned));
    }
  }
  if (choice.plastic_length.is_open()) {
    if (limits.not_sheared.empty()) {
      parameters.plastic_length = std::sqrt(2.0 / 3.0) * limits.friction * parameters.internal_length;
      found.push_back(
          fmt::format("couple stress {:.4g} mm times the pressure (lp = sqrt(2/3) M lc, M {:.4g})",
                      1e3 * *parameters.plastic_length, limits.friction));
    } else {
      found.push_back(fmt::format("couple stress without a limit, as the packing cannot be sheared ({})",
                                  limits.not_sheared));
    }
  }
  return fmt::format("limits of the packing: {}", fmt::join(found, ", "));
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
    check("lc", choice.has_rotations && !choice.internal_length, packing.couple);
  }
  CosseratParameters parameters;
  parameters.shear_modulus = choice.shear_modulus.value_or(packing.shear);
  parameters.cosserat_shear_modulus = choice.cosserat_shear_modulus.value_or(packing.cosserat_shear);
  parameters.internal_length = choice.internal_length.value_or(packing.length());
  parameters.has_rotations = choice.has_rotations;
  if (const std::string limits = resolve_limits(choice, pool, definition, parameters); !limits.empty())
    note += (note.empty() ? "" : "; ") + limits;
  return parameters;
}

}  // namespace polargrain::coupler
