// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/laws/combination.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "dem/contact/spoken_settings.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/engine/private_access.hpp"

namespace polargrain::dem {

namespace models = LIGGGHTS::ContactModels;
using LAMMPS_NS::LAMMPS;

namespace {

/// sqrt(5/6), as in the engine's Hertz model.
constexpr double kRootOfFiveSixths = 0.91287092917527685576161630466800355658790782499663875;

/// A table of the engine by pair of types, which counts types from 1.
class Table {
 public:
  Table(LAMMPS& lammps, const char* name) { lammps.force->registry.connect(name, values_, "polargrain"); }
  [[nodiscard]] double at(int a, int b) const { return values_[a + 1][b + 1]; }

 private:
  double** values_ = nullptr;
};

std::optional<NormalLaw> normal_of(int number) {
  if (number == models::HOOKE_RADII) return NormalLaw::hooke_radii;
  if (number == models::HOOKE_STIFFNESS) return NormalLaw::hooke_stiffness;
  if (number == models::HERTZ) return NormalLaw::hertz;
  return std::nullopt;
}

std::optional<TangentialLaw> tangential_of(int number) {
  if (number == models::TANGENTIAL_HISTORY) return TangentialLaw::history;
  if (number == models::TANGENTIAL_LI_CHU) return TangentialLaw::li_chu;
  return std::nullopt;
}

std::optional<RollingLaw> rolling_of(int number) {
  if (number == models::ROLLING_OFF) return RollingLaw::off;
  if (number == models::ROLLING_EPSD2) return RollingLaw::epsd2;
  if (number == models::ROLLING_LI_CHU) return RollingLaw::li_chu;
  return std::nullopt;
}

/// The first fix of the scene that does more than the loops over grains do; empty without one. No script can name
/// `pack/gravity`; the making of packings does its work in the loops too.
std::string foreign_fix(const LAMMPS& lammps) {
  constexpr std::array<std::string_view, 7> kKnown{"property/global", "nve/sphere",  "enforce2d",
                                                   "contacthistory",  "cell/strain", "pack/gravity"};
  int integrators = 0;
  for (int k = 0; k < lammps.modify->nfix; ++k) {
    const LAMMPS_NS::Fix& fix = *lammps.modify->fix[k];
    const std::string_view style = fix.style;
    if (std::find(kKnown.begin(), kKnown.end(), style) == kKnown.end()) return fmt::format("fix {}", style);
    if (style == "nve/sphere") {
      ++integrators;
      if (fix.igroup != 0) return "fix nve/sphere of a group";
    }
  }
  return integrators == 1 ? "" : "a fix nve/sphere that is missing or doubled";
}

/// Why the loop over discs, or spheres, cannot step a scene, whatever its contacts; empty when it can.
std::string foreign_scene(const LAMMPS& lammps, int dimension) {
  if (lammps.domain->dimension != dimension) return fmt::format("dimension {}", lammps.domain->dimension);
  if (lammps.force->newton_pair) return "newton on";
  if (lammps.neighbor->exclude_setting() != 0) return "neigh_modify exclude";
  if (lammps.atom->rmass == nullptr || lammps.atom->radius == nullptr) return "an atom style without radii";
  return foreign_fix(lammps);
}

void read_normal(LAMMPS& lammps, const SpokenSettings& spoken, LawCombination& made) {
  const auto each = [&made](auto set) {
    for (int a = 0; a < made.types; ++a)
      for (int b = 0; b < made.types; ++b)
        set(made.pairs[static_cast<std::size_t>(a) * made.types + b], a, b);
  };
  if (made.normal == NormalLaw::hooke_radii) {
    const Table modulus(lammps, "contactModulus");
    const Table ratio(lammps, "tangentialStiffnessRatio");
    each([&](PairParameters& p, int a, int b) {
      p.normal = 2.0 * modulus.at(a, b);
      p.tangential = ratio.at(a, b);
    });
    if (!spoken.damping) return;
    const Table damping(lammps, "contactDampingRatio");
    each(
        [&](PairParameters& p, int a, int b) { p.normal_damping = p.tangential_damping = damping.at(a, b); });
  } else if (made.normal == NormalLaw::hooke_stiffness) {
    const Table kn(lammps, "k_n");
    const Table kt(lammps, "k_t");
    const Table gamman(lammps, spoken.absolute_damping ? "gamman_abs" : "gamman");
    const Table gammat(lammps, spoken.absolute_damping ? "gammat_abs" : "gammat");
    each([&](PairParameters& p, int a, int b) {
      p.normal = kn.at(a, b) / lammps.force->nktv2p;
      p.tangential = kt.at(a, b) / lammps.force->nktv2p;
      p.normal_damping = gamman.at(a, b);
      p.tangential_damping = spoken.tangential_damping ? gammat.at(a, b) : 0.0;
    });
  } else {
    const Table young(lammps, "Yeff");
    const Table shear(lammps, "Geff");
    const Table beta(lammps, "betaeff");
    each([&](PairParameters& p, int a, int b) {
      p.normal = 4.0 / 3.0 * young.at(a, b) / lammps.force->nktv2p;
      p.tangential = 8.0 * shear.at(a, b) / lammps.force->nktv2p;
      const double factor = -2.0 * kRootOfFiveSixths * beta.at(a, b);
      p.normal_damping = factor * std::sqrt(2.0 * young.at(a, b));
      p.tangential_damping = spoken.tangential_damping ? factor * std::sqrt(8.0 * shear.at(a, b)) : 0.0;
    });
  }
}

using MemberOfPair = double PairParameters::*;

void read_table(LAMMPS& lammps, const char* name, LawCombination& made, MemberOfPair member) {
  const Table table(lammps, name);
  for (int a = 0; a < made.types; ++a)
    for (int b = 0; b < made.types; ++b)
      made.pairs[static_cast<std::size_t>(a) * made.types + b].*member = table.at(a, b);
}

void read_friction(LAMMPS& lammps, LawCombination& made) {
  const LawSettings& on = made.settings;
  if (made.tangential == TangentialLaw::history)
    read_table(lammps, "coeffFrict", made, &PairParameters::friction);
  else
    read_table(lammps, "coefficientFriction", made, &PairParameters::friction);
  if (on.rolling_force)
    read_table(lammps, "rollingFrictionForceStiffnessRatio", made, &PairParameters::rolling_force_stiffness);
  if (on.rolling_force && !on.symmetric)
    read_table(lammps, "coefficientRollingFrictionForce", made, &PairParameters::rolling_force_friction);
  if (on.rolling_force_damped)
    read_table(lammps, "rollingFrictionForceDampingRatio", made, &PairParameters::rolling_force_damping);
  if (made.rolling == RollingLaw::epsd2)
    read_table(lammps, "coeffRollFrict", made, &PairParameters::rolling_friction);
  if (made.rolling != RollingLaw::li_chu) return;
  read_table(lammps, "coefficientRollingFriction", made, &PairParameters::rolling_friction);
  read_table(lammps, "rollingStiffnessRatio", made, &PairParameters::rolling_stiffness);
  if (on.rolling_damped) read_table(lammps, "rollingDampingRatio", made, &PairParameters::rolling_damping);
}

LawSettings law_settings(const SpokenSettings& spoken, const LawCombination& made) {
  LawSettings on;
  on.damped = made.normal == NormalLaw::hooke_radii ? spoken.damping : false;
  for (const PairParameters& p : made.pairs)
    on.damped = on.damped || p.normal_damping != 0.0 || p.tangential_damping != 0.0;
  on.absolute_damping = spoken.absolute_damping;
  on.limit_force = spoken.limit_force;
  on.rolling_force = spoken.rolling_force;
  on.rolling_force_damped = spoken.rolling_force && spoken.rolling_force_damped;
  on.symmetric = spoken.symmetric;
  on.rolling_damped = spoken.rolling_damped;
  on.mean_radius = spoken.mean_radius;
  on.torsion = spoken.torsion;
  return on;
}

}  // namespace

LawSelection disc_combination(LAMMPS& lammps) {
  if (std::string why = foreign_scene(lammps, 2); !why.empty()) return {std::nullopt, std::move(why)};
  return known_models(lammps);
}

LawSelection sphere_combination(LAMMPS& lammps) {
  if (std::string why = foreign_scene(lammps, 3); !why.empty()) return {std::nullopt, std::move(why)};
  // Spheres are counted as in the packing.
  for (int k = 0; k < lammps.atom->nlocal; ++k)
    if (lammps.atom->tag[k] != k + 1) return {std::nullopt, "grains that the engine has reordered"};
  return known_models(lammps);
}

LawSelection known_models(LAMMPS& lammps) {
  auto* const source = dynamic_cast<SettingsSource*>(pair_implementation(lammps.force->pair));
  if (source == nullptr) return {std::nullopt, "a pair style of its own"};
  const auto hash = static_cast<LAMMPS_NS::PairGran*>(lammps.force->pair)->hashcode();
  const auto number = [hash](int place) { return static_cast<int>((hash >> (6 * place)) & 63); };
  const auto normal = normal_of(number(0));
  const auto tangential = tangential_of(number(1));
  const auto rolling = rolling_of(number(3));
  if (!normal || !tangential || !rolling || number(2) != models::COHESION_OFF ||
      number(4) != models::SURFACE_DEFAULT)
    return {std::nullopt, "contact models that it has not compiled"};
  const SpokenSettings& spoken = source->spoken_settings();
  if (spoken.keeps_books()) return {std::nullopt, "a contact model that keeps books of heat or energy"};

  LawCombination made;
  made.normal = *normal;
  made.tangential = *tangential;
  made.rolling = *rolling;
  made.types = lammps.atom->ntypes;
  made.pairs.resize(static_cast<std::size_t>(made.types) * made.types);
  read_normal(lammps, spoken, made);
  made.settings = law_settings(spoken, made);
  read_friction(lammps, made);
  return {std::move(made), ""};
}

}  // namespace polargrain::dem
