// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/archive.hpp"
#include "coupler/pool/pool.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Where the wall time of a run (or of one step) went, in s. The parts add up to `total`.
struct Costs {
  double total = 0.0;
  double grains = 0.0;    ///< inside the engines, divided by the number of workers
  double messages = 0.0;  ///< requests on their way, packed or unpacked, divided by the number of workers
  double waiting = 0.0;   ///< workers without a cell while others finish
  double finite_elements = 0.0;  ///< local materials, assembly, solution
  double rest = 0.0;             ///< output, reading, starting
};

/// @param before, after the pool's counts at both ends; zeroes without a pool @param finite_elements seconds
/// of assembly and solution @param materials seconds of Material::evaluate, cells included
Costs costs_between(const coupler::PoolCounts& before, const coupler::PoolCounts& after, int workers,
                    double total, double finite_elements, double materials);

Costs& operator+=(Costs& sum, const Costs& more);
coupler::PoolCounts operator+(const coupler::PoolCounts& a, const coupler::PoolCounts& b);
coupler::PoolCounts operator-(const coupler::PoolCounts& after, const coupler::PoolCounts& before);

/// The costs of a run so far, in a checkpoint.
void save(ArchiveWriter& archive, const Costs& costs, const coupler::PoolCounts& counts);
/// @throws RunError when the archive does not hold it
void restore(ArchiveReader& archive, Costs& costs, coupler::PoolCounts& counts);

}  // namespace polargrain::app
