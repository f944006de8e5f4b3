// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/audits.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polargrain::coupler {
namespace {

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

double hashed_share(std::uint64_t seed, std::uint64_t first, std::uint64_t second) {
  return static_cast<double>(mixed(mixed(mixed(seed) ^ first) ^ second) >> 11) * 0x1p-53;
}

double MeasuredErrors::mean() const {
  if (errors_.empty()) return 0.0;
  return std::accumulate(errors_.begin(), errors_.end(), 0.0) / static_cast<double>(errors_.size());
}

double MeasuredErrors::percentile(double share) const {
  if (errors_.empty()) return 0.0;
  std::vector<double> sorted = errors_;
  std::sort(sorted.begin(), sorted.end());
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

}  // namespace polargrain::coupler
