// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The contact laws of docs/theory/grains.md, D.2 between discs, as numbers along the normal n (from the
// second disc to the first, as in the engine) and the tangent t = e_3 x n. In the plane a spring of a contact
// has one component. The engine's headers hold the same laws in space; tests hold both side by side.
#include <cmath>

#include "dem/contact/hertz_slope.hpp"
#include "dem/discs/combination.hpp"

namespace polargrain::dem {

/// How two discs touch and move against each other.
struct Touch {
  double nx = 0.0, ny = 0.0;     ///< unit normal
  double overlap = 0.0;          ///< m
  double opening_rate = 0.0;     ///< v_n of the first against the second along n, m/s
  double slip_rate = 0.0;        ///< of the first surface against the second along t, with the curvature, m/s
  double relative_spin = 0.0;    ///< of the first against the second, with the curvature, rad/s
  double spin_difference = 0.0;  ///< without it
  double radius_first = 0.0, radius_second = 0.0;                    ///< m
  double arm_first = 0.0, arm_second = 0.0;                          ///< centre to contact point, m
  double harmonic = 0.0;                                             ///< r_1 r_2 / (r_1 + r_2), m
  double inverse_mass_first = 0.0, inverse_mass_second = 0.0;        ///< 1/kg
  double inverse_inertia_first = 0.0, inverse_inertia_second = 0.0;  ///< 1/(kg m^2)

  [[nodiscard]] double effective_mass() const { return 1.0 / (inverse_mass_first + inverse_mass_second); }
  [[nodiscard]] double effective_inertia() const {
    return 1.0 / (inverse_inertia_first + inverse_inertia_second);
  }
};

struct NormalAnswer {
  double force = 0.0;               ///< on the first along n, positive when they push, N
  double kn = 0.0, kt = 0.0;        ///< N/m
  double slope = 1.0;               ///< d force / d overlap over kn
  double normal_dashpot = 0.0;      ///< N s/m
  double tangential_dashpot = 0.0;  ///< N s/m
};

template <NormalLaw Law>
[[gnu::always_inline]] inline NormalAnswer normal_law(const PairParameters& p, const LawSettings& settings,
                                                      const Touch& touch) {
  NormalAnswer answer;
  if constexpr (Law == NormalLaw::hooke_radii) {
    answer.kn = p.normal * touch.harmonic;
    answer.kt = p.tangential * answer.kn;
    if (settings.damped) {
      const double mass = touch.effective_mass();
      answer.normal_dashpot = 2.0 * p.normal_damping * std::sqrt(answer.kn * mass);
      answer.tangential_dashpot = 2.0 * p.tangential_damping * std::sqrt(answer.kt * mass);
    }
  } else if constexpr (Law == NormalLaw::hooke_stiffness) {
    answer.kn = p.normal;
    answer.kt = p.tangential;
    if (settings.damped) {
      const double mass = settings.absolute_damping ? 1.0 : touch.effective_mass();
      answer.normal_dashpot = mass * p.normal_damping;
      answer.tangential_dashpot = mass * p.tangential_damping;
    }
  } else {
    const double root = std::sqrt(touch.harmonic * touch.overlap);
    answer.slope = kHertzSlope;
    answer.kn = p.normal * root;
    answer.kt = p.tangential * root;
    if (settings.damped) {
      const double factor = std::sqrt(root * touch.effective_mass());
      answer.normal_dashpot = p.normal_damping * factor;
      answer.tangential_dashpot = p.tangential_damping * factor;
    }
  }
  answer.force = answer.kn * touch.overlap;
  if (settings.damped) answer.force -= answer.normal_dashpot * touch.opening_rate;
  if (settings.limit_force && answer.force < 0.0) answer.force = 0.0;
  return answer;
}

/// Cuts a number down to a limit, keeping its sign. @return whether it was beyond.
[[gnu::always_inline]] inline bool cut(double& value, double limit) {
  if (!(std::abs(value) > limit)) return false;
  value = std::copysign(limit, value);
  return true;
}

/// Places of the springs of a contact. `history` keeps its spring as a vector (the two components), `li_chu`
/// as its length along t, with the rolling displacement beside it; the rolling law has one value behind them:
/// epsd2 its moment, N m, li_chu its angle, rad.
inline constexpr int kRollingSpring = 2;
constexpr int spring_count(RollingLaw rolling) {
  return rolling == RollingLaw::off ? 2 : 3;
}

/// Tangential force on the first disc along t, N; moves the springs by a step when `advance`.
template <TangentialLaw Law>
[[gnu::always_inline]] inline double tangential_law(const PairParameters& p, const LawSettings& settings,
                                                    const Touch& touch, const NormalAnswer& normal,
                                                    double step, bool advance, double* springs) {
  const double kt = normal.kt;
  if constexpr (Law == TangentialLaw::history) {
    double spring = springs[1] * touch.nx - springs[0] * touch.ny;
    if (advance) spring += touch.slip_rate * step;
    double force = -kt * spring;
    if (cut(force, p.friction * std::abs(normal.force)))
      spring = -force / kt;
    else if (settings.damped)
      force -= normal.tangential_dashpot * touch.slip_rate;
    if (advance) {
      springs[0] = -spring * touch.ny;
      springs[1] = spring * touch.nx;
    }
    return force;
  } else {
    const double push = normal.force > 0.0 ? normal.force : 0.0;
    const double cap = p.friction * push;
    const double spring = advance ? springs[0] + touch.slip_rate * step : springs[0];
    double elastic = kt * spring;
    bool slides = cut(elastic, cap);
    double rolling = 0.0;
    double viscous = 0.0;
    if (settings.rolling_force) {
      // Rolling displacement of the first along t: R* en x W = -R* W.
      const double kr = p.rolling_force_stiffness * kt;
      bool rolls_freely = false;
      if (settings.symmetric) {
        const double angle = springs[kRollingSpring] + (advance ? touch.relative_spin * step : 0.0);
        rolling = -kr * touch.harmonic * angle;
      } else {
        const double rolled = springs[1] - (advance ? touch.harmonic * touch.relative_spin * step : 0.0);
        rolling = kr * rolled;
        rolls_freely = cut(rolling, p.rolling_force_friction * push);
        if (advance) springs[1] = rolls_freely ? rolling / kr : rolled;
      }
      if (settings.rolling_force_damped && !rolls_freely)
        viscous = -2.0 * p.rolling_force_damping * std::sqrt(kr * touch.effective_mass()) * touch.harmonic *
                  touch.relative_spin;
      elastic += rolling;
      slides = cut(elastic, cap) || slides;
    }
    if (advance) springs[0] = slides && kt > 0.0 ? (elastic - rolling) / kt : spring;
    double force = -elastic;
    if (slides) return force;
    if (settings.rolling_force_damped) force -= viscous;
    if (settings.damped) force -= normal.tangential_dashpot * touch.slip_rate;
    // A dashpot cannot push past the friction of the surfaces either.
    if (settings.rolling_force_damped || settings.damped) cut(force, cap);
    return force;
  }
}

struct RollingAnswer {
  double moment = 0.0;     ///< on the second about e_3, N m; the first gets the opposite
  double stiffness = 0.0;  ///< N m/rad
  bool at_limit = false;
  double limit = 0.0;  ///< of the moment, N m
};

/// Rolling resistance; comes after the tangential law of the same contact.
template <RollingLaw Law>
[[gnu::always_inline]] inline RollingAnswer rolling_law(const PairParameters& p, const LawSettings& settings,
                                                        const Touch& touch, const NormalAnswer& normal,
                                                        double step, bool advance, double* springs) {
  RollingAnswer answer;
  if constexpr (Law == RollingLaw::epsd2) {
    const double radius = touch.harmonic;
    answer.stiffness = normal.kt * radius * radius;
    // As in the engine, which looks a step ahead even where it does not keep it.
    answer.moment = springs[kRollingSpring] + answer.stiffness * touch.spin_difference * step;
    answer.limit = p.rolling_friction * radius * std::abs(normal.force);
    answer.at_limit = cut(answer.moment, answer.limit);
    if (advance) springs[kRollingSpring] = answer.moment;
  } else if constexpr (Law == RollingLaw::li_chu) {
    const double radius =
        settings.mean_radius ? 0.5 * (touch.radius_first + touch.radius_second) : touch.harmonic;
    answer.stiffness = p.rolling_stiffness * normal.kt * radius * radius;
    const double push = normal.force > 0.0 ? normal.force : 0.0;
    const double angle = springs[kRollingSpring] + (advance ? touch.relative_spin * step : 0.0);
    const double coupling =
        settings.symmetric ? p.rolling_force_stiffness * normal.kt * touch.harmonic * springs[0] : 0.0;
    answer.moment = answer.stiffness * angle - coupling;
    answer.limit = p.rolling_friction * radius * push;
    answer.at_limit = cut(answer.moment, answer.limit);
    if (advance)
      springs[kRollingSpring] = answer.at_limit ? (answer.moment + coupling) / answer.stiffness : angle;
    if (settings.rolling_damped && !answer.at_limit)
      answer.moment += 2.0 * p.rolling_damping * std::sqrt(answer.stiffness * touch.effective_inertia()) *
                       touch.relative_spin;
  }
  return answer;
}

}  // namespace polargrain::dem
