// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <span>

namespace polargrain::coupler {

/// The upper bound, with 95 % confidence, of the mean of `population` errors, all zero or positive, when `sample` of them, drawn
/// by chance, have been measured. The measured ones are known; the rest is taken to scatter like exponentially distributed
/// errors (standard deviation equal to the mean), of which 2 n mean / (true mean) is distributed like chi-square with 2n
/// degrees of freedom (Epstein and Sobel 1953). One sample of many bounds the mean by
/// 19.5 times itself, eight by 2.0 times, twenty by 1.5 times their mean.
/// @returns infinity for an empty sample of a population that is not
double mean_at_most(std::span<const double> sample, std::size_t population);

/// The factor on the mean of n exponentially distributed numbers that bounds their true mean from above with 95 %
/// confidence: 2n over the 5 % quantile of chi-square with 2n degrees of freedom. @param n at least 1
double exponential_bound_factor(std::size_t n);

}  // namespace polargrain::coupler
