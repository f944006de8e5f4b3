// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// Two grains that move as prescribed, in an engine of their own: asks a contact law for its forces along any
/// path of the pair. Call start_engine_process() first.
class ContactPair {
 public:
  struct Definition {
    int dimension = 2;               ///< 2: discs, 3: spheres
    std::vector<std::string> model;  ///< script lines: properties and pair_style
    double radius_first = 0.0;       ///< m
    double radius_second = 0.0;      ///< m
    double density = 2500.0;         ///< kg/m^3
    double time_step = 1e-5;         ///< s
  };
  struct Place {
    Eigen::Vector3d first, second;  ///< centres, m
  };
  struct Spins {
    Eigen::Vector3d first, second;  ///< rad/s
  };
  struct Answer {
    Eigen::Vector3d force;                        ///< on first, N (on second: the opposite)
    Eigen::Vector3d torque_first, torque_second;  ///< N m
    Contact contact;                              ///< as recorded; zero when the grains do not touch
  };

  /// Grains at rest at `start`, springs unstressed.
  ContactPair(const Definition& definition, const Place& start);
  ContactPair(const ContactPair&) = delete;
  ContactPair& operator=(const ContactPair&) = delete;
  ~ContactPair();

  /// As a cell with that rate of curvature does, rad/(m s), from the next step on.
  void bend(const Eigen::Vector2d& curvature_rate);
  /// Moves both centres to `next` in one time step at constant velocity, the grains spinning at `spins`.
  Answer advance(const Place& next, const Spins& spins);

 private:
  struct Engineroom;
  std::unique_ptr<Engineroom> room_;
};

}  // namespace polargrain::dem
