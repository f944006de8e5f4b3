// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The contact laws of docs/theory/grains.md, D.2, for discs and for spheres. The normal n points from the second grain to
// the first, as in the engine, whose headers hold the same laws; tests hold both side by side. The laws are written
// for numbers of any lanes: a plain double is one contact (dem/lanes/vectors.hpp).
//
// A contact (DiscContact, SphereContact) says what differs between the plane and space:
//
//   Number, Tangent, Turn       a displacement along the contact and a rotation: numbers for discs, vectors for spheres
//   overlap, opening_rate       m, m/s; opening counts positive
//   slip_rate, spin, own_spin   of the first grain against the second; spin with the curvature and without it
//   flat, turned                the part in the contact plane; a spring that has moved with the contact through a step
//   across, lever               n x a rotation; n x a displacement
//   sliding, rolled, bending    springs, kept by keep_sliding, keep_rolled, keep_bending
//   find_stiffnesses, friction, ...  constants
//   where_touching              a number where the grains touch, zero where the loop treats a pair that has parted
//
// No law has a branch that depends on a contact of space: a pair that has parted pushes with no force, so that every
// limit is zero, and a spring cut to its limit is forgotten.
#include "dem/laws/contact_constants.hpp"
#include "dem/laws/limited_springs.hpp"

namespace polargrain::dem {
namespace {

/// Laws that a kernel is compiled for.
template <TangentialLaw Tangential_, RollingLaw Rolling_, bool Twists_, bool Bare_>
struct LawKind {
  static constexpr TangentialLaw tangential = Tangential_;
  static constexpr RollingLaw rolling = Rolling_;
  static constexpr bool twists = Twists_;  ///< li_chu of spheres resists torsion
  static constexpr bool bare = Bare_;      ///< settings are off, but mean radius and torsion of li_chu
  static constexpr bool bends = Rolling_ == RollingLaw::li_chu;
};

template <typename Contact>
struct LawAnswer {
  using Number = typename Contact::Number;
  Number normal;                         ///< force on the first along n, N
  typename Contact::Tangent resistance;  ///< to slip: tangential force on the second, N
  typename Contact::Turn moment;         ///< rolling resistance on the second, N m
  Stiffnesses<Number> stiff;
  Number rolling_stiffness;        ///< N m
  Number rolling_limit;            ///< of the moment, N m
  Number is_rolling, is_twisting;  ///< 1 where the spring stands at its limit, or 0
};

/// The law at work on one contact a lane.
template <typename Kind, typename Contact>
class ContactLaw {
  using Number = typename Contact::Number;
  using Tangent = typename Contact::Tangent;
  using Turn = typename Contact::Turn;
  using Answer = LawAnswer<Contact>;
  using Choice = decltype(Number{} > Number{});

 public:
  /// @param step of the loop, s @param advance springs move by it @param of_contact that make the contact, where it stays:
  /// a copy would cost a tenth of the law
  template <typename... OfContact>
  POLARGRAIN_INLINE ContactLaw(const LawSettings& settings, double step, bool advance,
                               const OfContact&... of_contact)
      : contact(of_contact...),
        settings_(settings),
        advance_(advance),
        step_(all<Number>(advance ? step : 0.0)),
        whole_step_(all<Number>(step)) {}

  Contact contact;

  POLARGRAIN_INLINE Answer operator()() {
    Answer made;
    const Number zero = all<Number>(0.0);
    made.rolling_stiffness = made.rolling_limit = made.is_rolling = made.is_twisting = zero;
    contact.find_stiffnesses(has(&LawSettings::damped), made.stiff);
    made.normal = normal(made.stiff);
    push_ = Kind::bare ? made.normal : greater(made.normal, all<Number>(0.0));
    size_ = Kind::bare ? made.normal : magnitude(made.normal);
    if constexpr (Kind::tangential == TangentialLaw::history)
      history(made.stiff, made.resistance);
    else
      li_chu(made.stiff, made.resistance);
    if constexpr (Kind::rolling == RollingLaw::off)
      made.moment = typename Contact::Turn{};
    else if constexpr (Kind::rolling == RollingLaw::epsd2)
      epsd2(made, made.moment);
    else
      rolling_li_chu(made, made.moment);
    return made;
  }

 private:
  POLARGRAIN_INLINE bool has(bool LawSettings::*which) const { return !Kind::bare && settings_.*which; }

  /// A dashpot acts where grains touch and its spring does not stand at its limit.
  POLARGRAIN_INLINE Number acting(Number dashpot, Choice at_limit) const {
    return select(at_limit, all<Number>(0.0), contact.where_touching(dashpot));
  }

  POLARGRAIN_INLINE Number normal(const Stiffnesses<Number>& stiff) const {
    Number force = stiff.normal * contact.overlap;
    const Number zero = all<Number>(0.0);
    if constexpr (Kind::bare) return greater(force, zero);
    if (settings_.damped) force = force - stiff.normal_dashpot * contact.opening_rate;
    if (settings_.limit_force) force = greater(force, zero);
    return contact.where_touching(force);
  }

  POLARGRAIN_INLINE void history(const Stiffnesses<Number>& stiff, Tangent& force) const {
    Tangent spring = contact.flat(contact.sliding() + step_ * contact.slip_rate);
    const Choice slides = limited_force(spring, stiff.tangential, contact.friction() * size_, force);
    contact.keep_sliding(spring);
    if (has(&LawSettings::damped))
      force = force + acting(stiff.tangential_dashpot, slides) * contact.slip_rate;
  }

  POLARGRAIN_INLINE void li_chu(const Stiffnesses<Number>& stiff, Tangent& force) {
    const Number limit = contact.friction() * push_;
    if (has(&LawSettings::symmetric)) stored_sliding_ = contact.sliding();
    const Tangent spring = contact.flat(contact.turned(contact.sliding()) + step_ * contact.slip_rate);
    Tangent kept = spring;
    Tangent viscous{};
    const bool rolls = has(&LawSettings::rolling_force);
    if (rolls) {
      force = stiff.tangential * spring;
      Choice slides = cut(force, limit);
      const Tangent rolling = rolling_force(stiff.tangential, viscous);
      force = force + rolling;
      slides = cut(force, limit) | slides;
      kept = contact.where_touching(given_way(slides, force - rolling, stiff.tangential, spring));
    } else {
      limited_force(kept, stiff.tangential, limit, force);
    }
    contact.keep_sliding(kept);
    const bool rolling_damped = rolls && settings_.rolling_force_damped;
    if (rolling_damped || has(&LawSettings::damped)) {
      const Choice stands = stands_at(force, limit);
      if (rolling_damped) force = select(stands, force, force + viscous);
      if (has(&LawSettings::damped))
        force = force + acting(stiff.tangential_dashpot, stands) * contact.slip_rate;
      // A dashpot cannot push past the friction of the surfaces either.
      cut(force, limit);
    }
  }

  /// Elastic part of the rolling friction force against the slip. @param viscous gets that of its dashpot
  POLARGRAIN_INLINE Tangent rolling_force(Number kt, Tangent& viscous) const {
    const Number kr = contact.force_stiffness(kt);
    const Number radius = contact.harmonic();
    const Tangent rate = radius * contact.across(contact.spin);  // of the rolling displacement
    const Number dashpot =
        settings_.rolling_force_damped ? contact.where_touching(contact.force_dashpot(kr)) : all<Number>(0.0);
    viscous = dashpot * rate;
    if constexpr (Kind::bends)
      if (settings_.symmetric) return (kr * radius) * contact.across(bending_ahead());
    Tangent spring = contact.turned(contact.rolled()) + step_ * rate;
    const Number limit = contact.force_friction() * push_;
    Tangent force;
    limited_force(spring, kr, limit, force);
    contact.keep_rolled(spring);
    viscous = acting(dashpot, stands_at(force, limit)) * rate;
    return force;
  }

  /// The bending spring as the rolling law finds it in this step, which comes after the sliding one.
  POLARGRAIN_INLINE Turn bending_ahead() const {
    return contact.turned(contact.bending()) + step_ * contact.flat(contact.spin);
  }

  POLARGRAIN_INLINE void epsd2(Answer& made, Turn& moment) const {
    made.rolling_stiffness = contact.rolling_stiffness(made.stiff.tangential);
    made.rolling_limit = contact.rolling_reach() * size_;
    const Turn way = has(&LawSettings::torsion) ? contact.own_spin : contact.flat(contact.own_spin);
    // As in the engine, which looks a step ahead even where it does not keep it.
    moment = contact.bending() + whole_step_ * (made.rolling_stiffness * way);
    made.is_rolling = select(cut(moment, made.rolling_limit), all<Number>(1.0), all<Number>(0.0));
    contact.keep_bending(moment);
  }

  POLARGRAIN_INLINE void rolling_li_chu(Answer& made, Turn& moment) const {
    const Number stiff = contact.rolling_stiffness(made.stiff.tangential);
    const Number limit = contact.rolling_reach() * push_;
    made.rolling_stiffness = stiff;
    made.rolling_limit = limit;
    Turn bending = bending_ahead();
    Choice rolls;
    if (has(&LawSettings::symmetric)) {
      const Turn coupling = (contact.force_stiffness(made.stiff.tangential) * contact.harmonic()) *
                            contact.lever(advance_ ? contact.sliding() : stored_sliding_);
      moment = stiff * bending - coupling;
      rolls = cut(moment, limit);
      bending = contact.where_touching(given_way(rolls, moment + coupling, stiff, bending));
    } else {
      rolls = limited_force(bending, stiff, limit, moment);
    }
    contact.keep_bending(bending);
    made.is_rolling = select(rolls, all<Number>(1.0), all<Number>(0.0));
    Number dashpot{};
    if (has(&LawSettings::rolling_damped)) {
      dashpot = contact.rolling_dashpot(stiff);
      moment = moment + acting(dashpot, stands_at(moment, limit)) * contact.flat(contact.spin);
    }
    if constexpr (Kind::twists) moment = moment + torsion(made, dashpot);
  }

  /// Resistance to a rotation about the normal, which spheres alone have.
  POLARGRAIN_INLINE Turn torsion(Answer& made, Number dashpot) const {
    const Number rate = contact.twist_rate();
    Number angle = contact.torsion() + step_ * rate;
    Number torque;
    const Choice twists = limited_force(angle, made.rolling_stiffness, made.rolling_limit, torque);
    contact.keep_torsion(contact.where_touching(angle));
    made.is_twisting = select(twists, all<Number>(1.0), all<Number>(0.0));
    if (has(&LawSettings::rolling_damped))
      torque = torque + acting(dashpot, stands_at(torque, made.rolling_limit)) * rate;
    return torque * contact.n;
  }

  const LawSettings& settings_;
  bool advance_;
  Number step_;        // by which springs move, s
  Number whole_step_;  // of the loop, s
  Tangent stored_sliding_{};
  Number push_{}, size_{};  // compressive normal force; magnitude of the normal force, N
};

}  // namespace
}  // namespace polargrain::dem
