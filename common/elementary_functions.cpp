// SPDX-License-Identifier: GPL-2.0-or-later
// Every function reduces its argument to a small one, exactly or nearly so, and sums up the Taylor series
// there, from the small terms to the large ones. Series rather than minimax polynomials: with the few terms
// more come coefficients that anybody can check.
#include "common/elementary_functions.hpp"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <limits>

static_assert(LDBL_MANT_DIG == 64, "written for the extended precision of x86-64");

namespace polargrain {

namespace {

using Extended = long double;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Constants in parts: a whole number of 32 bits times a leading part is exact.
constexpr Extended kHalfPi[] = {0x6487ed51p-30L, 0x85a308d3p-65L, 0x98cc51701b839a25p-132L};
constexpr Extended kPi = 0xc90fdaa22168c235p-62L;
constexpr Extended kLogarithmOfTwo[] = {0x162e42ffp-29L, -0x5c610ca86c3898dp-93L};
constexpr Extended kInverseRootOfPi = 0x906eba8214db688dp-64L;

/// arctan(k / 8), k = 0 .. 8.
constexpr Extended kArcTangentOfEighths[] = {
    0.0L,
    0xfeadd4d5617b6e33p-67L,
    0xfadbafc96406eb15p-66L,
    0x2dec3283c9bde11dp-63L,
    0xed63382b0dda7b45p-65L,
    0x8f005d5ef7f59f9bp-64L,
    0x292f1f464d3dc249p-62L,
    0x2e014f8af08c679dp-62L,
    0xc90fdaa22168c235p-64L,
};

/// 1 / n!, with alternating signs from the second on when `sign` is -1, for n = first, first + step, ...
template <std::size_t terms>
constexpr std::array<Extended, terms> inverse_factorials(int first, int step, int sign) {
  std::array<Extended, terms> values{};
  Extended factorial = 1.0L;
  int n = 1;
  for (std::size_t k = 0; k < terms; ++k) {
    for (; n <= first + step * static_cast<int>(k); ++n) factorial *= n;
    values[k] = (k % 2 == 1 ? sign : 1) / factorial;
  }
  return values;
}

/// 1, sign / 3, 1 / 5, sign / 7, ...
template <std::size_t terms>
constexpr std::array<Extended, terms> inverse_odd_numbers(int sign) {
  std::array<Extended, terms> values{};
  for (std::size_t k = 0; k < terms; ++k)
    values[k] = (k % 2 == 1 ? sign : 1) / static_cast<Extended>(2 * k + 1);
  return values;
}

template <std::size_t terms>
Extended series(const std::array<Extended, terms>& coefficients, Extended x) {
  Extended sum = coefficients[terms - 1];
  for (std::size_t k = terms - 1; k > 0; --k) sum = sum * x + coefficients[k - 1];
  return sum;
}

// The number of terms leaves out what is below 2^-66 of the result.
constexpr auto kSine = inverse_factorials<11>(1, 2, -1);        // |x| <= pi / 4
constexpr auto kCosine = inverse_factorials<12>(0, 2, -1);      // |x| <= pi / 4
constexpr auto kExponential = inverse_factorials<18>(0, 1, 1);  // |x| <= log(2) / 2
constexpr auto kArcTangent = inverse_odd_numbers<9>(-1);        // |x| <= 1 / 16
constexpr auto kAreaTangent = inverse_odd_numbers<14>(1);       // |x| <= (sqrt(2) - 1) / (sqrt(2) + 1)

Extended nearest(Extended x) {
  return __builtin_rintl(x);
}

/// Angle of (x, y) for 0 <= y <= x, x > 0: the nearest of nine angles and the small one that is left.
Extended angle_in_first_octant(Extended y, Extended x) {
  const auto eighths = static_cast<int>(nearest(8.0L * (y / x)));
  const Extended slope = eighths / 8.0L;
  const Extended rest = (y - slope * x) / (x + slope * y);
  return kArcTangentOfEighths[eighths] + rest * series(kArcTangent, rest * rest);
}

/// Numbers that are no NaN, zeros of either sign, not both infinite.
Extended angle_of(Extended y, Extended x) {
  const Extended high = std::abs(y), wide = std::abs(x);
  Extended angle = 0.0L;
  if (high > wide)
    angle = kPi / 2.0L - (std::isinf(high) ? 0.0L : angle_in_first_octant(wide, high));
  else if (high > 0.0L && !std::isinf(wide))
    angle = angle_in_first_octant(high, wide);
  if (std::signbit(x)) angle = kPi - angle;
  return std::copysign(angle, y);
}

/// e^x for |x| < 1e4.
Extended exponential_of(Extended x) {
  const Extended twos = nearest(x / kLogarithmOfTwo[0]);
  const Extended rest = (x - twos * kLogarithmOfTwo[0]) - twos * kLogarithmOfTwo[1];
  return __builtin_ldexpl(series(kExponential, rest), static_cast<int>(twos));
}

/// A finite x > 0. log(m) = 2 artanh((m - 1) / (m + 1)).
Extended logarithm_of(double x) {
  int twos = 0;
  Extended mantissa = std::frexp(x, &twos);
  if (mantissa < 0.7071L) {
    mantissa *= 2.0L;
    --twos;
  }
  const Extended s = (mantissa - 1.0L) / (mantissa + 1.0L);
  return twos * kLogarithmOfTwo[0] + (2.0L * s * series(kAreaTangent, s * s) + twos * kLogarithmOfTwo[1]);
}

/// e^x beyond what a double holds is infinite or zero; the bounds keep the powers of two whole numbers.
double rounded_exponential(Extended x) {
  return static_cast<double>(exponential_of(std::clamp(x, -2000.0L, 2000.0L)));
}

}  // namespace

SineAndCosine sine_and_cosine(double angle) {
  if (!(std::abs(angle) <= 1e9)) return {kNotANumber, kNotANumber};
  if (angle == 0.0) return {angle, 1.0};  // keeps the sign of zero
  const Extended quarters = nearest(angle / (kPi / 2.0L));
  const Extended x = ((angle - quarters * kHalfPi[0]) - quarters * kHalfPi[1]) - quarters * kHalfPi[2];
  const Extended sine = x * series(kSine, x * x);
  const Extended cosine = series(kCosine, x * x);
  switch (static_cast<long long>(quarters) & 3) {
    case 0:
      return {static_cast<double>(sine), static_cast<double>(cosine)};
    case 1:
      return {static_cast<double>(cosine), static_cast<double>(-sine)};
    case 2:
      return {static_cast<double>(-sine), static_cast<double>(-cosine)};
    default:
      return {static_cast<double>(-cosine), static_cast<double>(sine)};
  }
}

double sine(double angle) {
  return sine_and_cosine(angle).sine;
}

double cosine(double angle) {
  return sine_and_cosine(angle).cosine;
}

double arc_tangent(double y, double x) {
  if (std::isnan(x) || std::isnan(y) || (std::isinf(x) && std::isinf(y))) return kNotANumber;
  return static_cast<double>(angle_of(y, x));
}

double arc_tangent(double x) {
  return arc_tangent(x, 1.0);
}

double arc_sine(double x) {
  if (!(std::abs(x) <= 1.0)) return kNotANumber;
  return static_cast<double>(angle_of(x, std::sqrt((1.0L - x) * (1.0L + x))));
}

double arc_cosine(double x) {
  if (!(std::abs(x) <= 1.0)) return kNotANumber;
  return static_cast<double>(angle_of(std::sqrt((1.0L - x) * (1.0L + x)), x));
}

double exponential(double x) {
  return std::isnan(x) ? x : rounded_exponential(x);
}

double logarithm(double x) {
  if (x == 0.0) return -kInfinity;
  if (!(x > 0.0)) return kNotANumber;
  return x == kInfinity ? x : static_cast<double>(logarithm_of(x));
}

double power(double base, double exponent) {
  if (exponent == 0.0 || base == 1.0) return 1.0;
  if (std::isnan(base) || std::isnan(exponent)) return kNotANumber;
  const bool whole = std::floor(exponent) == exponent;
  const bool odd = whole && std::abs(exponent) < 0x1p53 && std::fmod(exponent, 2.0) != 0.0;
  const double sign = odd && std::signbit(base) ? -1.0 : 1.0;
  const double size = std::abs(base);
  if (base < 0.0 && !whole && !std::isinf(base)) return kNotANumber;
  if (size == 1.0) return sign;  // also for an infinite exponent
  if (size == 0.0 || std::isinf(size)) return sign * ((size == 0.0) == (exponent > 0.0) ? 0.0 : kInfinity);
  if (std::isinf(exponent)) return (size < 1.0) == (exponent > 0.0) ? 0.0 : kInfinity;
  return sign * rounded_exponential(exponent * logarithm_of(size));
}

double complementary_error_function(double x) {
  if (std::isnan(x)) return x;
  if (std::abs(x) > 30.0) return x > 0.0 ? 0.0 : 2.0;
  const Extended size = std::abs(x);
  const Extended bell = kInverseRootOfPi * exponential_of(-size * size);
  Extended tail = 0.0L;
  if (size < 2.0L) {  // erf(x) = 2 / sqrt(pi) e^(-x^2) (x + 2 x^3 / 3 + 4 x^5 / (3 5) + ...)
    Extended term = size, sum = size;
    for (int k = 1; k < 60; ++k) sum += term *= 2.0L * size * size / (2 * k + 1);
    tail = 1.0L - 2.0L * bell * sum;
  } else {  // e^(-x^2) / sqrt(pi) / (x + (1/2) / (x + 1 / (x + (3/2) / (x + ...))))
    Extended fraction = size;
    for (int k = 80; k > 0; --k) fraction = size + 0.5L * k / fraction;
    tail = bell / fraction;
  }
  return static_cast<double>(std::signbit(x) ? 2.0L - tail : tail);
}

}  // namespace polargrain
