// SPDX-License-Identifier: GPL-2.0-or-later
// The engine's logarithms and powers. Its shared library takes them from the C library, whose versions differ
// in the last bit between processors, for the damping constant of `hertz` and `hooke` (log of the
// restitution, once) and for the stiffness of `hooke` (pow, every contact and step). A function of a program
// goes before one of the same name in a shared library, so that the engine calls these. The build takes the
// file in with contact/registration.cpp, which calls them too. Trigonometric functions are not here: no
// contact model of the engine that takes part in a cell calls them.
#include "common/elementary_functions.hpp"

extern "C" {

double log(double x) noexcept {
  return polargrain::logarithm(x);
}

double pow(double base, double exponent) noexcept {
  return polargrain::power(base, exponent);
}

double exp(double x) noexcept {
  return polargrain::exponential(x);
}
}
