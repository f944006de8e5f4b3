// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Models, settings and parameters of the contact laws of the loops over grains. Kernels of several instruction sets include this file, so it
// includes no header of the standard library (dem/lanes/vectors.hpp).

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

  [[nodiscard]] constexpr bool has_dashpots() const {
    return damped || rolling_force_damped || rolling_damped;
  }
};

/// Parameters of the contacts between two types of grains, made ready for the loops; of one contact a lane.
template <typename Number>
struct ParametersOf {
  /// hooke/radii: 2 E_c, Pa; hooke/stiffness: k_n, N/m; hertz: 4/3 Y*, Pa.
  Number normal{};
  /// hooke/radii: k_t / k_n; hooke/stiffness: k_t, N/m; hertz: 8 G*, Pa.
  Number tangential{};
  /// hooke/radii: damping ratio; hooke/stiffness: gamma, 1/s (absolute: N s/m); hertz: the number that
  /// sqrt(sqrt(R* delta) m_eff) is multiplied by.
  Number normal_damping{};
  Number tangential_damping{};
  Number friction{};                 ///< mu_s
  Number rolling_friction{};         ///< mu_th
  Number rolling_stiffness{};        ///< li_chu: k_th / (k_t r_c^2)
  Number rolling_damping{};          ///< li_chu: zeta_th
  Number rolling_force_friction{};   ///< li_chu: mu_r
  Number rolling_force_stiffness{};  ///< li_chu: k_r / k_t
  Number rolling_force_damping{};    ///< li_chu: zeta_r
};
using PairParameters = ParametersOf<double>;

/// Places of the springs of a contact between discs. `history` keeps its spring as a vector (the two components), `li_chu`
/// as its length along t, with the rolling displacement beside it; the rolling law has one value behind them:
/// epsd2 its moment, N m, li_chu its angle, rad.
inline constexpr int kRollingSpring = 2;
inline constexpr int kDiscSprings = 3;
constexpr int spring_count(RollingLaw rolling) {
  return rolling == RollingLaw::off ? 2 : 3;
}

}  // namespace polargrain::dem
