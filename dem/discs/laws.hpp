// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The contact laws of docs/theory/grains.md, D.2 between discs, as numbers along the normal n (from the
// second disc to the first, as in the engine) and the tangent t = e_3 x n. In the plane a spring of a contact
// has one component. The engine's headers hold the same laws in space; tests hold both side by side. The laws are
// written for numbers of any lanes: a plain double is one contact (dem/lanes/vectors.hpp).
#include "dem/contact/hertz_slope.hpp"
#include "dem/discs/law_settings.hpp"
#include "dem/lanes/vectors.hpp"

namespace polargrain::dem {
namespace {

/// How two discs touch and move against each other.
template <typename Number>
struct Touch {
  Number nx{}, ny{};         ///< unit normal
  Number overlap{};          ///< m
  Number opening_rate{};     ///< v_n of the first against the second along n, m/s
  Number slip_rate{};        ///< of the first surface against the second along t, with the curvature, m/s
  Number relative_spin{};    ///< of the first against the second, with the curvature, rad/s
  Number spin_difference{};  ///< without it
  Number radius_first{}, radius_second{};                    ///< m
  Number arm_first{}, arm_second{};                          ///< centre to contact point, m
  Number harmonic{};                                         ///< r_1 r_2 / (r_1 + r_2), m
  Number inverse_mass_first{}, inverse_mass_second{};        ///< 1/kg
  Number inverse_inertia_first{}, inverse_inertia_second{};  ///< 1/(kg m^2)

  [[nodiscard]] POLARGRAIN_INLINE Number effective_mass() const {
    return 1.0 / (inverse_mass_first + inverse_mass_second);
  }
  [[nodiscard]] POLARGRAIN_INLINE Number effective_inertia() const {
    return 1.0 / (inverse_inertia_first + inverse_inertia_second);
  }
};

/// Two discs as they are about to meet.
template <typename Number>
struct DiscPair {
  Number dx{}, dy{};                   ///< centre of the second to centre of the first, m
  Number vx{}, vy{};                   ///< of the first against the second, m/s
  Number distance{}, over_distance{};  ///< of the centres, m; one over it
  Number spin_first{}, spin_second{};
  Number radius_first{}, radius_second{};
  Number harmonic{};
  Number inverse_mass_first{}, inverse_mass_second{};
  Number inverse_inertia_first{}, inverse_inertia_second{};

  [[nodiscard]] POLARGRAIN_INLINE Number square() const { return dx * dx + dy * dy; }
  [[nodiscard]] POLARGRAIN_INLINE auto touches() const {
    const Number reach = radius_first + radius_second;
    return square() < reach * reach;
  }
  POLARGRAIN_INLINE void measure() {
    distance = root(square());
    over_distance = 1.0 / distance;
  }
};

/// Kinematics of a contact (D.1) between discs whose distance is measured. @param bend_x, bend_y rate of curvature in the frame of the box, rad/(m s)
template <typename Number>
POLARGRAIN_INLINE Touch<Number> touch_of(const DiscPair<Number>& pair, double bend_x, double bend_y) {
  Touch<Number> touch;
  touch.nx = pair.dx * pair.over_distance;
  touch.ny = pair.dy * pair.over_distance;
  touch.overlap = pair.radius_first + pair.radius_second - pair.distance;
  touch.radius_first = pair.radius_first;
  touch.radius_second = pair.radius_second;
  touch.arm_first = pair.radius_first - 0.5 * touch.overlap;
  touch.arm_second = pair.radius_second - 0.5 * touch.overlap;
  touch.harmonic = pair.harmonic;
  touch.inverse_mass_first = pair.inverse_mass_first;
  touch.inverse_mass_second = pair.inverse_mass_second;
  touch.inverse_inertia_first = pair.inverse_inertia_first;
  touch.inverse_inertia_second = pair.inverse_inertia_second;
  touch.opening_rate = pair.vx * touch.nx + pair.vy * touch.ny;
  // Spins seen from the middle of the branch (C.8).
  const Number bent = 0.5 * (bend_x * pair.dx + bend_y * pair.dy);
  const Number spin_first = pair.spin_first + bent;
  const Number spin_second = pair.spin_second - bent;
  touch.slip_rate = pair.vy * touch.nx - pair.vx * touch.ny -
                    (touch.arm_first * spin_first + touch.arm_second * spin_second);
  touch.spin_difference = pair.spin_first - pair.spin_second;
  touch.relative_spin = spin_first - spin_second;
  return touch;
}

template <typename Number>
struct NormalAnswer {
  Number force{};               ///< on the first along n, positive when they push, N
  Number kn{}, kt{};            ///< N/m
  Number normal_dashpot{};      ///< N s/m
  Number tangential_dashpot{};  ///< N s/m

  [[nodiscard]] POLARGRAIN_INLINE Number push() const { return select(force > 0.0, force, Number{}); }
};

template <NormalLaw Law, typename Number>
POLARGRAIN_INLINE NormalAnswer<Number> normal_law(const ParametersOf<Number>& p, const LawSettings& settings,
                                                  const Touch<Number>& touch) {
  NormalAnswer<Number> answer;
  if constexpr (Law == NormalLaw::hooke_radii) {
    answer.kn = p.normal * touch.harmonic;
    answer.kt = p.tangential * answer.kn;
    if (settings.damped) {
      const Number mass = touch.effective_mass();
      answer.normal_dashpot = 2.0 * p.normal_damping * root(answer.kn * mass);
      answer.tangential_dashpot = 2.0 * p.tangential_damping * root(answer.kt * mass);
    }
  } else if constexpr (Law == NormalLaw::hooke_stiffness) {
    answer.kn = p.normal;
    answer.kt = p.tangential;
    if (settings.damped) {
      const Number mass = settings.absolute_damping ? all<Number>(1.0) : touch.effective_mass();
      answer.normal_dashpot = mass * p.normal_damping;
      answer.tangential_dashpot = mass * p.tangential_damping;
    }
  } else {
    const Number stiffening = root(touch.harmonic * touch.overlap);
    answer.kn = p.normal * stiffening;
    answer.kt = p.tangential * stiffening;
    if (settings.damped) {
      const Number factor = root(stiffening * touch.effective_mass());
      answer.normal_dashpot = p.normal_damping * factor;
      answer.tangential_dashpot = p.tangential_damping * factor;
    }
  }
  answer.force = answer.kn * touch.overlap;
  if (settings.damped) answer.force = answer.force - answer.normal_dashpot * touch.opening_rate;
  if (settings.limit_force) answer.force = select(answer.force < 0.0, Number{}, answer.force);
  return answer;
}

/// Cuts a number down to a limit, keeping its sign. @return whether it was beyond.
template <typename Number>
POLARGRAIN_INLINE auto cut(Number& value, Number limit) {
  const auto beyond = magnitude(value) > limit;
  value = select(beyond, with_sign_of(limit, value), value);
  return beyond;
}

/// Tangential force on the first disc along t, N; moves the springs by a step when `advance`.
template <TangentialLaw Law, typename Number>
POLARGRAIN_INLINE Number tangential_law(const ParametersOf<Number>& p, const LawSettings& settings,
                                        const Touch<Number>& touch, const NormalAnswer<Number>& normal,
                                        double step, bool advance, Number* springs) {
  const Number kt = normal.kt;
  if constexpr (Law == TangentialLaw::history) {
    Number spring = springs[1] * touch.nx - springs[0] * touch.ny;
    if (advance) spring = spring + touch.slip_rate * step;
    Number force = -kt * spring;
    const auto slides = cut(force, p.friction * magnitude(normal.force));
    if (any(slides)) spring = select(slides, -force / kt, spring);
    if (settings.damped) force = select(slides, force, force - normal.tangential_dashpot * touch.slip_rate);
    if (advance) {
      springs[0] = -spring * touch.ny;
      springs[1] = spring * touch.nx;
    }
    return force;
  } else {
    const Number push = normal.push();
    const Number cap = p.friction * push;
    const Number spring = advance ? springs[0] + touch.slip_rate * step : springs[0];
    Number elastic = kt * spring;
    auto slides = cut(elastic, cap);
    Number rolling{};
    Number viscous{};
    if (settings.rolling_force) {
      // Rolling displacement of the first along t: R* en x W = -R* W.
      const Number kr = p.rolling_force_stiffness * kt;
      auto rolls_freely = kr < kr;
      if (settings.symmetric) {
        const Number angle =
            advance ? springs[kRollingSpring] + touch.relative_spin * step : springs[kRollingSpring];
        rolling = -kr * touch.harmonic * angle;
      } else {
        const Number rolled = advance ? springs[1] - touch.harmonic * touch.relative_spin * step : springs[1];
        rolling = kr * rolled;
        rolls_freely = cut(rolling, p.rolling_force_friction * push);
        if (advance) {
          springs[1] = rolled;
          if (any(rolls_freely)) springs[1] = select(rolls_freely, rolling / kr, rolled);
        }
      }
      if (settings.rolling_force_damped)
        viscous = select(rolls_freely, Number{},
                         -2.0 * p.rolling_force_damping * root(kr * touch.effective_mass()) * touch.harmonic *
                             touch.relative_spin);
      elastic = elastic + rolling;
      slides = cut(elastic, cap) | slides;
    }
    if (advance) {
      springs[0] = spring;
      if (any(slides)) springs[0] = select(slides & (kt > 0.0), (elastic - rolling) / kt, spring);
    }
    const Number force = -elastic;
    if (!settings.rolling_force_damped && !settings.damped) return force;
    Number damped = force;
    if (settings.rolling_force_damped) damped = damped - viscous;
    if (settings.damped) damped = damped - normal.tangential_dashpot * touch.slip_rate;
    // A dashpot cannot push past the friction of the surfaces either.
    cut(damped, cap);
    return select(slides, force, damped);
  }
}

template <typename Number>
struct RollingAnswer {
  Number moment{};     ///< on the second about e_3, N m; the first gets the opposite
  Number stiffness{};  ///< N m/rad
  Number at_limit{};   ///< 1, or 0
  Number limit{};      ///< of the moment, N m
};

/// Rolling resistance; comes after the tangential law of the same contact.
template <RollingLaw Law, typename Number>
POLARGRAIN_INLINE RollingAnswer<Number> rolling_law(const ParametersOf<Number>& p,
                                                    const LawSettings& settings, const Touch<Number>& touch,
                                                    const NormalAnswer<Number>& normal, double step,
                                                    bool advance, Number* springs) {
  RollingAnswer<Number> answer;
  if constexpr (Law == RollingLaw::epsd2) {
    const Number radius = touch.harmonic;
    answer.stiffness = normal.kt * radius * radius;
    // As in the engine, which looks a step ahead even where it does not keep it.
    answer.moment = springs[kRollingSpring] + answer.stiffness * touch.spin_difference * step;
    answer.limit = p.rolling_friction * radius * magnitude(normal.force);
    answer.at_limit = select(cut(answer.moment, answer.limit), all<Number>(1.0), Number{});
    if (advance) springs[kRollingSpring] = answer.moment;
  } else if constexpr (Law == RollingLaw::li_chu) {
    const Number radius =
        settings.mean_radius ? 0.5 * (touch.radius_first + touch.radius_second) : touch.harmonic;
    answer.stiffness = p.rolling_stiffness * normal.kt * radius * radius;
    const Number angle =
        advance ? springs[kRollingSpring] + touch.relative_spin * step : springs[kRollingSpring];
    const Number coupling =
        settings.symmetric ? p.rolling_force_stiffness * normal.kt * touch.harmonic * springs[0] : Number{};
    answer.moment = answer.stiffness * angle - coupling;
    answer.limit = p.rolling_friction * radius * normal.push();
    const auto rolls = cut(answer.moment, answer.limit);
    answer.at_limit = select(rolls, all<Number>(1.0), Number{});
    if (advance) {
      springs[kRollingSpring] = angle;
      if (any(rolls))
        springs[kRollingSpring] = select(rolls, (answer.moment + coupling) / answer.stiffness, angle);
    }
    if (settings.rolling_damped)
      answer.moment = select(rolls, answer.moment,
                             answer.moment + 2.0 * p.rolling_damping *
                                                 root(answer.stiffness * touch.effective_inertia()) *
                                                 touch.relative_spin);
  }
  return answer;
}

}  // namespace
}  // namespace polargrain::dem
