// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The cost of a step of the stock programs `liggghts` and `lmp` on a packing, by bench/step.in.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>

#include "common/packing.hpp"

namespace polargrain::bench {

inline bool is_installed(const std::string& program) {
  if (std::system(fmt::format("command -v {} > /dev/null", program).c_str()) == 0) return true;
  fmt::print(stderr, "{} is not installed: left out\n", program);
  return false;
}

/// How the box of step.in is strained: isochoric, along x1 at this rate.
struct StockStrain {
  double rate;       ///< 1/s
  double time_step;  ///< s
  double drag;       ///< `fix viscous`, N s/m
};

/// The packing as a data file of one of the programs, in a right box or an oblique one. Removed at the end.
class StockPacking {
 public:
  StockPacking(const Packing& packing, bool lammps)
      : is_in_space_(packing.dimension == 3),
        name_(fmt::format("/tmp/stock_packing.{}.{}.data", lammps ? "lammps" : "liggghts", getpid())) {
    const Eigen::Matrix3d base = packing.base_vectors();
    const double below = is_in_space_ ? 0.0 : -0.5 * packing.thickness;
    std::ofstream file(name_);
    file << fmt::format(
        "packing of a bench\n\n{} atoms\n1 atom types\n\n0 {:.17g} xlo xhi\n0 {:.17g} ylo yhi\n",
        packing.grains.size(), base(0, 0), base(1, 1));
    file << fmt::format("{:.17g} {:.17g} zlo zhi\n", below, below + packing.thickness);
    if (is_in_space_)
      file << fmt::format("{:.17g} {:.17g} {:.17g} xy xz yz\n", base(0, 1), base(0, 2), base(1, 2));
    file << "\nAtoms\n\n";
    for (const Grain& grain : packing.grains) {
      // In dimension 2 liggghts takes a density for that of discs of unit thickness, lammps for that of spheres.
      const double area = std::numbers::pi * grain.radius * grain.radius;
      const double volume = lammps || is_in_space_ ? 4.0 / 3.0 * area * grain.radius : area;
      file << fmt::format("{} 1 {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", grain.id + 1, 2.0 * grain.radius,
                          grain.mass / volume, grain.position.x(), grain.position.y(), grain.height);
    }
  }
  StockPacking(const StockPacking&) = delete;
  StockPacking& operator=(const StockPacking&) = delete;
  ~StockPacking() { std::remove(name_.c_str()); }

  /// Processor seconds a step, the start of the program taken off; negative when it failed.
  /// @param models the words of the pair style
  [[nodiscard]] double seconds_a_step(bool lammps, const std::string& models, const StockStrain& strain,
                                      int steps) const {
    const double start_up = seconds(lammps, models, strain, 0);
    const double whole = seconds(lammps, models, strain, steps);
    return start_up < 0.0 || whole < 0.0 ? -1.0 : (whole - start_up) / steps;
  }

 private:
  [[nodiscard]] double seconds(bool lammps, const std::string& models, const StockStrain& strain,
                               int steps) const {
    const auto spent = [] {
      rusage usage{};
      getrusage(RUSAGE_CHILDREN, &usage);
      return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
    };
    const double before = spent();
    const std::string command = fmt::format(
        "OMP_NUM_THREADS=1 {} -in bench/step.in -log none -var lammps {} -var space {} -var packing {} -var models "
        "\"{}\" -var steps {} -var rate {:.17g} -var step {:.17g} -var drag {:.17g} > /dev/null 2>&1",
        lammps ? "lmp" : "liggghts", lammps ? 1 : 0, is_in_space_ ? 1 : 0, name_, models, steps, strain.rate,
        strain.time_step, strain.drag);
    return std::system(command.c_str()) == 0 ? spent() - before : -1.0;
  }

  bool is_in_space_;
  std::string name_;
};

}  // namespace polargrain::bench
