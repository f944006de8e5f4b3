// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "dem/contact/contact_recorder.hpp"
#include "dem/discs/candidates.hpp"
#include "dem/discs/combination.hpp"

namespace polargrain::dem {

/// A lattice vector of the box as it is now: where an image lies and how fast it moves.
struct MovingImage {
  double x = 0.0, y = 0.0;    ///< m
  double vx = 0.0, vy = 0.0;  ///< m/s
};

/// One pass over the contacts of discs: forces from positions, velocities and springs.
class ContactLoop {
 public:
  struct Scene {
    std::span<const Disc> discs;
    std::span<const MovingImage> images;                       ///< of the list's images
    Eigen::Vector2d curvature_rate = Eigen::Vector2d::Zero();  ///< in the frame of the box, rad/(m s)
    double step = 0.0;                                         ///< time step, s
    bool advance = false;                                      ///< springs move by a step
  };

  virtual ~ContactLoop() = default;
  /// Adds the contact forces to `forces`; moves the springs of `list`.
  virtual void add_forces(const Scene& scene, CandidateList& list, std::span<DiscForce> forces) const = 0;
  /// The same, and takes down the contacts.
  virtual void record_forces(const Scene& scene, CandidateList& list, std::span<DiscForce> forces,
                             std::vector<Contact>& contacts) const = 0;
};

/// The loop that cells run: one law is compiled into it, a disc's force stays in registers along its row.
std::unique_ptr<ContactLoop> make_contact_loop(const DiscCombination& combination);

/// Its plain twin, which reads like the equations: vectors, laws chosen at run time, one sum after the other.
/// Tests hold both together.
std::unique_ptr<ContactLoop> make_plain_contact_loop(const DiscCombination& combination);

}  // namespace polargrain::dem
