// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>

#include "dem/discs/candidates.hpp"
#include "dem/discs/disc_pass.hpp"
#include "dem/laws/combination.hpp"

namespace polargrain::dem {

/// One pass over the contacts of discs, which reads like the equations: laws chosen at run time, one contact after the
/// other. The compiled kernels (disc_pass.hpp) are held to its bits.
class PlainContactLoop {
 public:
  struct Scene {
    std::span<const Disc> discs;
    std::span<const MovingImage> images;  ///< of the list's images
    Eigen::Vector2d curvature_rate;       ///< in the frame of the box, rad/(m s)
    double step = 0.0;                    ///< time step, s
    bool advance = false;                 ///< springs move by a step
    double* records = nullptr;            ///< as of a DiscPass
  };

  explicit PlainContactLoop(const LawCombination& combination) : combination_(combination) {}

  /// Adds the contact forces to `forces`; moves the springs of `list`.
  void add_forces(const Scene& scene, CandidateList& list, std::span<DiscForce> forces) const;

 private:
  LawCombination combination_;
};

}  // namespace polargrain::dem
