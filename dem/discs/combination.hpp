// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// Contact models that the loop over discs knows; the names in a script are the same, with `/` for `_`.
enum class NormalLaw { hooke_radii, hooke_stiffness, hertz };
enum class TangentialLaw { history, li_chu };
enum class RollingLaw { off, epsd2, li_chu };

/// Settings of the models of a combination, as in the heads of the models' files.
struct LawSettings {
  bool damped = false;                ///< there are normal or tangential dashpots
  bool absolute_damping = false;      ///< hooke/stiffness: dashpots do not scale with the mass
  bool limit_force = false;           ///< a normal force does not pull
  bool rolling_force = false;         ///< tangential li_chu: rolling friction force
  bool rolling_force_damped = false;  ///< and its dashpot
  bool symmetric = false;             ///< li_chu: the pair of laws has an elastic energy
  bool rolling_damped = false;        ///< rolling li_chu: dashpot
  bool mean_radius = false;           ///< rolling li_chu: r_c is the mean radius
  bool torsion = false;               ///< rolling laws of spheres resist twisting too
};

/// Parameters of the contacts between two types of grains, made ready for the loop.
struct PairParameters {
  /// hooke/radii: 2 E_c, Pa; hooke/stiffness: k_n, N/m; hertz: 4/3 Y*, Pa.
  double normal = 0.0;
  /// hooke/radii: k_t / k_n; hooke/stiffness: k_t, N/m; hertz: 8 G*, Pa.
  double tangential = 0.0;
  /// hooke/radii: damping ratio; hooke/stiffness: gamma, 1/s (absolute: N s/m); hertz: the number that
  /// sqrt(sqrt(R* delta) m_eff) is multiplied by.
  double normal_damping = 0.0;
  double tangential_damping = 0.0;
  double friction = 0.0;                 ///< mu_s
  double rolling_friction = 0.0;         ///< mu_th
  double rolling_stiffness = 0.0;        ///< li_chu: k_th / (k_t r_c^2)
  double rolling_damping = 0.0;          ///< li_chu: zeta_th
  double rolling_force_friction = 0.0;   ///< li_chu: mu_r
  double rolling_force_stiffness = 0.0;  ///< li_chu: k_r / k_t
  double rolling_force_damping = 0.0;    ///< li_chu: zeta_r
};

/// The contacts that a script sets up, where the loops over discs and over spheres can take it.
struct DiscCombination {
  NormalLaw normal = NormalLaw::hooke_radii;
  TangentialLaw tangential = TangentialLaw::history;
  RollingLaw rolling = RollingLaw::off;
  LawSettings settings;
  int types = 1;
  std::vector<PairParameters> pairs;  ///< of types a and b: pairs[a * types + b]

  /// A number for the models and settings: springs mean something under the same one only.
  [[nodiscard]] int code() const;
  [[nodiscard]] std::string name() const;  ///< "hooke/radii, history, li_chu"
};

struct DiscSelection {
  std::optional<DiscCombination> combination;
  std::string reason;  ///< why the general loop has to run, when there is no combination
};

/// The contact models of an initialised engine, where the loop over discs knows them.
DiscSelection disc_models(LAMMPS_NS::LAMMPS& lammps);

/// Whether the scene of an initialised engine can be stepped by the loop over discs: a plane scene of one of
/// the combinations above that does nothing but integrate its grains.
DiscSelection disc_combination(LAMMPS_NS::LAMMPS& lammps);

/// The same for the loop over spheres: a scene in space.
DiscSelection sphere_combination(LAMMPS_NS::LAMMPS& lammps);

}  // namespace polargrain::dem
