// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Elementary functions with the same bits on every x86-64 processor. The system's library has several
/// versions of each (with and without fused multiply-add) whose last bits differ, and takes the one that
/// suits the processor. These are made of + - * / and roots of extended precision (64 bits of mantissa),
/// which the standard of arithmetic lays down to the last bit; their error is less than 0.51 units in the
/// last place of a double, unless said otherwise. They take 20 to 80 ns.
///
/// Every value that decides a result (stress, fields, packings) must use these; sqrt, abs, floor, fmod and hypot of the
/// system are the same everywhere. For arguments that are not finite they agree with the system's functions.
namespace polargrain {

struct SineAndCosine {
  double sine;
  double cosine;
};

/// @param angle in rad; beyond 1e9 the results are NaN.
SineAndCosine sine_and_cosine(double angle);
double sine(double angle);
double cosine(double angle);

double arc_sine(double x);
double arc_cosine(double x);
double arc_tangent(double x);
/// Angle of the point (x, y) against the x axis, -pi to pi; signs of zeros as in std::atan2. Not for two
/// infinities.
double arc_tangent(double y, double x);

double exponential(double x);
/// Natural logarithm.
double logarithm(double x);
/// base^exponent as std::pow, with an error of less than 1.1 units in the last place.
double power(double base, double exponent);
/// 1 - erf(x), with a relative error below 1e-14.
double complementary_error_function(double x);

}  // namespace polargrain
