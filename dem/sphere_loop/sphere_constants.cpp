// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/sphere_loop/sphere_constants.hpp"

#include "dem/laws/contact_constants.hpp"

namespace polargrain::dem {

namespace {

using Constants = std::array<double, kSphereConstants>;

/// Hertz's for an overlap of one.
template <NormalLaw Normal>
Stiffnesses<double> unit_stiffnesses(const LawSettings& on, const PairParameters& p,
                                     const GrainPair<double>& grains) {
  Stiffnesses<double> made;
  stiffnesses_of<Normal>(p, on.damped, on.absolute_damping, grains, 1.0, made);
  return made;
}

Stiffnesses<double> unit_stiffnesses(const LawCombination& laws, const PairParameters& p,
                                     const GrainPair<double>& grains) {
  switch (laws.normal) {
    case NormalLaw::hooke_radii:
      return unit_stiffnesses<NormalLaw::hooke_radii>(laws.settings, p, grains);
    case NormalLaw::hooke_stiffness:
      return unit_stiffnesses<NormalLaw::hooke_stiffness>(laws.settings, p, grains);
    case NormalLaw::hertz:
      return unit_stiffnesses<NormalLaw::hertz>(laws.settings, p, grains);
  }
  return {};
}

struct Rolling {
  double stiffness, reach;  ///< N m, m
};
template <RollingLaw Law>
Rolling rolling_of(const LawSettings& on, const PairParameters& p, double kt,
                   const GrainPair<double>& grains) {
  const double radius = rolling_radius<Law>(on, grains);
  return {rolling_stiffness_of<Law>(p, kt, radius), p.rolling_friction * radius};
}

GrainPair<double> pair_of(const Spheres& spheres, std::size_t i, std::size_t j) {
  const double a = spheres.radii[i];
  const double b = spheres.radii[j];
  return {a,
          b,
          a * b / (a + b),
          1.0 / spheres.masses[i],
          1.0 / spheres.masses[j],
          1.0 / spheres.inertias[i],
          1.0 / spheres.inertias[j]};
}

Constants constants_of(const Spheres& spheres, int first, int second) {
  const LawCombination& laws = spheres.combination;
  const auto i = static_cast<std::size_t>(first);
  const auto j = static_cast<std::size_t>(second);
  const PairParameters& p =
      laws.pairs[static_cast<std::size_t>(spheres.types[i]) * laws.types + spheres.types[j]];
  const GrainPair<double> grains = pair_of(spheres, i, j);
  const Stiffnesses<double> stiff = unit_stiffnesses(laws, p, grains);
  const double kt = stiff.tangential;
  Constants made{};
  made[kNormalStiffness] = stiff.normal;
  made[kTangentialStiffness] = kt;
  made[kNormalDashpot] = stiff.normal_dashpot;
  made[kTangentialDashpot] = stiff.tangential_dashpot;
  made[kFriction] = p.friction;
  const Rolling rolling = laws.rolling == RollingLaw::li_chu
                              ? rolling_of<RollingLaw::li_chu>(laws.settings, p, kt, grains)
                              : rolling_of<RollingLaw::epsd2>(laws.settings, p, kt, grains);
  made[kRollingStiffness] = rolling.stiffness;
  made[kRollingReach] = rolling.reach;
  made[kRollingDashpot] = rolling_dashpot_of(p, made[kRollingStiffness], grains);
  made[kForceStiffness] = p.rolling_force_stiffness * kt;
  made[kForceFriction] = p.rolling_force_friction;
  made[kForceDashpot] = force_dashpot_of(p, made[kForceStiffness], grains);
  made[kHarmonicRadius] = grains.harmonic;
  return made;
}

/// Which constants the kernels of a combination read.
std::array<bool, kSphereConstants> constants_read(const LawCombination& laws) {
  const LawSettings& on = laws.settings;
  const bool rolls = laws.rolling != RollingLaw::off;
  std::array<bool, kSphereConstants> read{};
  read[kNormalStiffness] = read[kTangentialStiffness] = read[kFriction] = true;
  read[kNormalDashpot] = read[kTangentialDashpot] = on.damped;
  read[kRollingStiffness] = read[kRollingReach] = rolls;
  read[kForceStiffness] = read[kHarmonicRadius] = on.rolling_force;
  read[kForceDashpot] = on.rolling_force_damped;
  read[kRollingDashpot] = on.rolling_damped;
  read[kForceFriction] = on.rolling_force && !on.symmetric;
  return read;
}

}  // namespace

int sphere_spring_count(const LawCombination& combination) {
  const LawSettings& on = combination.settings;
  if (on.rolling_force && !on.symmetric) return kSphereSprings;
  if (combination.rolling == RollingLaw::off) return kBending;
  return combination.rolling == RollingLaw::li_chu && on.torsion ? kTorsion + 1 : kTorsion;
}

int springs_in_pass(const LawCombination& combination) {
  return combination.is_bare() ? sphere_spring_count(combination) : kSphereSprings;
}

SphereKernels::Pass kernel_of(const SphereKernels& kernels, const LawCombination& combination) {
  int rolling = static_cast<int>(combination.rolling);
  if (combination.rolling == RollingLaw::li_chu && combination.settings.torsion) ++rolling;
  return kernels.pass[combination.normal == NormalLaw::hertz ? 1 : 0]
                     [static_cast<int>(combination.tangential)][rolling][combination.is_bare() ? 1 : 0];
}

SpherePass pass_over(SphereList& list, const LawCombination& combination) {
  SpherePass pass{};
  pass.first = list.first_row.data();
  pass.second = list.second_row.data();
  pass.image = list.image_row.data();
  pass.radius_first = list.radius_first.data();
  pass.radius_second = list.radius_second.data();
  for (int k = 0; k < kSphereConstants; ++k) pass.constants[k] = list.constants[k].data();
  for (int k = 0; k < kSphereSprings; ++k) pass.springs[k] = list.springs[k].data();
  pass.touching = list.touching;
  pass.interior = list.interior;
  pass.touching_across = list.touching_across;
  pass.count = list.count;
  pass.gaps = list.gaps.data();
  pass.active = list.active.data();
  pass.settings = combination.settings;
  return pass;
}

void fill_constants(const Spheres& spheres, SphereList& list) {
  const std::array<bool, kSphereConstants> read = constants_read(spheres.combination);
  for (int k = 0; k < kSphereConstants; ++k)
    if (read[k]) list.constants[k].assign(static_cast<std::size_t>(list.count), 0.0);
  for (int c = 0; c < list.count; ++c) {
    if (list.first[c] >= list.grains) continue;
    const Constants made = constants_of(spheres, list.first[c], list.second[c]);
    for (int k = 0; k < kSphereConstants; ++k)
      if (read[k]) list.constants[k][c] = made[k];
  }
}

}  // namespace polargrain::dem
