// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// The data that a host hands over for one integration point: the binary interface of MFront's generic behaviours, version 1, as
// MFrontGenericInterfaceSupport (MGIS) 2.0 and later call them. Layout and meaning are theirs; the words are ours.

namespace polargrain::coupler::mgis {

/// A point at one end of the time step.
template <class Real>
struct StateView {
  const double* gradients;
  Real* forces;
  const double* mass_density;
  const double* material_properties;
  Real* internal_variables;
  Real* stored_energy;      ///< may be null
  Real* dissipated_energy;  ///< may be null
  const double* external_variables;
};

struct DataView {
  char* error_message;  ///< null, or room for 512 characters
  double time_increment;
  /// In: in its first place the wish of the host (Wish). Out: the blocks of the tangent, one after the other, each row by row.
  double* tangent;
  double* time_step_factor;  ///< out: the proposed next time step, over this one
  double* speed_of_sound;
  StateView<const double> start;
  StateView<double> end;
};

/// The request in the first number of the tangent.
struct Wish {
  explicit Wish(double code)
      : is_of_sound(code > 50.0),
        is_prediction((is_of_sound ? code - 100.0 : code) < -0.5),
        has_tangent(is_prediction || (is_of_sound ? code - 100.0 : code) > 0.5) {}
  bool is_of_sound;
  bool is_prediction;  ///< the tangent of the start alone; nothing is integrated
  bool has_tangent;
};

/// Return values of a behaviour.
inline constexpr int kFailed = -1;
inline constexpr int kUnreliable = 0;
inline constexpr int kReliable = 1;

}  // namespace polargrain::coupler::mgis
