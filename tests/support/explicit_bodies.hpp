// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

/// Bodies between rough plates, for explicit steps.
namespace polargrain::testing::explicit_bodies {

using namespace polargrain::fem;

inline constexpr double kPressure = 100e3;

inline ElasticParameters<2> sand_of_explicit() {
  ElasticParameters<2> parameters{40e6, 0.3, 10e6, 3e-3, Vector7::Zero()};
  for (const int i : {k11, k22, k33}) parameters.initial_stress(i) = -kPressure;
  return parameters;
}

inline std::shared_ptr<Material<2>> elastic() {
  return std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(sand_of_explicit()));
}

/// Compression between rough plates, so that the stress is not uniform.
inline Problem<2> biaxial(Deformation deformation = Deformation::small, double shortening = 0.0008) {
  Problem<2> problem;
  problem.mesh = rectangle({{0.04, 0.08}, {2, 4}});
  problem.deformation = deformation;
  problem.materials["all"] = elastic();
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{"bottom", Dof::u1, zero, {}},
                        {"bottom", Dof::u2, zero, {}},
                        {"top", Dof::u1, zero, {}},
                        {"top", Dof::u2, TimeTable::ramp(-shortening), {}}};
  problem.boundary_loads = {{.on = "left", .pressure = TimeTable::constant(kPressure)},
                            {.on = "right", .pressure = TimeTable::constant(kPressure)}};
  return problem;
}

inline double force_on_top(const Solver<2>& solver) {
  return solver.reaction("top")(1);
}

}  // namespace polargrain::testing::explicit_bodies
