// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/sphere_loop/sphere_constants.hpp"

#include <cmath>

namespace polargrain::dem {

namespace {

double of_both(double first, double second) {
  return first * second / (first + second);
}

using Constants = std::array<double, kSphereConstants>;

/// Stiffnesses and dashpots of the normal law.
void add_normal(const DiscCombination& laws, const PairParameters& p, double harmonic, double mass,
                Constants& made) {
  double& kn = made[kNormalStiffness];
  double& kt = made[kTangentialStiffness];
  switch (laws.normal) {
    case NormalLaw::hooke_radii:
      kn = p.normal * harmonic;
      kt = p.tangential * kn;
      made[kNormalDashpot] = 2.0 * p.normal_damping * std::sqrt(kn * mass);
      made[kTangentialDashpot] = 2.0 * p.tangential_damping * std::sqrt(kt * mass);
      break;
    case NormalLaw::hooke_stiffness: {
      const double factor = laws.settings.absolute_damping ? 1.0 : mass;
      kn = p.normal;
      kt = p.tangential;
      made[kNormalDashpot] = factor * p.normal_damping;
      made[kTangentialDashpot] = factor * p.tangential_damping;
      break;
    }
    case NormalLaw::hertz: {
      const double root = std::sqrt(harmonic);
      kn = p.normal * root;
      kt = p.tangential * root;
      made[kNormalDashpot] = p.normal_damping * std::sqrt(root * mass);
      made[kTangentialDashpot] = p.tangential_damping * std::sqrt(root * mass);
      break;
    }
  }
}

Constants constants_of(const Spheres& spheres, int first, int second) {
  const DiscCombination& laws = spheres.combination;
  const auto i = static_cast<std::size_t>(first);
  const auto j = static_cast<std::size_t>(second);
  const PairParameters& p =
      laws.pairs[static_cast<std::size_t>(spheres.types[i]) * laws.types + spheres.types[j]];
  const double harmonic = of_both(spheres.radii[i], spheres.radii[j]);
  const double mass = of_both(spheres.masses[i], spheres.masses[j]);
  Constants made{};
  add_normal(laws, p, harmonic, mass, made);
  made[kFriction] = p.friction;
  const double kt = made[kTangentialStiffness];

  const bool is_li_chu = laws.rolling == RollingLaw::li_chu;
  const double radius =
      is_li_chu && laws.settings.mean_radius ? 0.5 * (spheres.radii[i] + spheres.radii[j]) : harmonic;
  made[kRollingStiffness] = (is_li_chu ? p.rolling_stiffness : 1.0) * kt * radius * radius;
  made[kRollingReach] = p.rolling_friction * radius;
  made[kForceStiffness] = p.rolling_force_stiffness * kt;
  made[kForceFriction] = p.rolling_force_friction;
  made[kHarmonicRadius] = harmonic;
  return made;
}

/// Which constants the kernels of a combination read.
std::array<bool, kSphereConstants> constants_read(const DiscCombination& laws) {
  const LawSettings& on = laws.settings;
  const bool rolls = laws.rolling != RollingLaw::off;
  std::array<bool, kSphereConstants> read{};
  read[kNormalStiffness] = read[kTangentialStiffness] = read[kFriction] = true;
  read[kNormalDashpot] = read[kTangentialDashpot] = on.damped;
  read[kRollingStiffness] = read[kRollingReach] = rolls;
  read[kForceStiffness] = read[kHarmonicRadius] = on.rolling_force;
  read[kForceFriction] = on.rolling_force && !on.symmetric;
  return read;
}

}  // namespace

bool is_bare(const DiscCombination& combination) {
  const LawSettings& on = combination.settings;
  const bool whole_spin = on.torsion && combination.rolling == RollingLaw::epsd2;
  return !(on.damped || on.limit_force || on.rolling_force || whole_spin);
}

int sphere_spring_count(const DiscCombination& combination) {
  const LawSettings& on = combination.settings;
  if (on.rolling_force && !on.symmetric) return kSphereSprings;
  if (combination.rolling == RollingLaw::off) return kBending;
  return combination.rolling == RollingLaw::li_chu && on.torsion ? kTorsion + 1 : kTorsion;
}

int springs_in_pass(const DiscCombination& combination) {
  return is_bare(combination) ? sphere_spring_count(combination) : kSphereSprings;
}

SphereKernels::Pass kernel_of(const SphereKernels& kernels, const DiscCombination& combination) {
  int rolling = static_cast<int>(combination.rolling);
  if (combination.rolling == RollingLaw::li_chu && combination.settings.torsion) ++rolling;
  return kernels.pass[combination.normal == NormalLaw::hertz ? 1 : 0]
                     [static_cast<int>(combination.tangential)][rolling][is_bare(combination) ? 1 : 0];
}

SpherePass pass_over(SphereList& list, const DiscCombination& combination) {
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
  const LawSettings& on = combination.settings;
  pass.settings = {on.damped, on.limit_force, on.rolling_force, on.symmetric, on.torsion};
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
