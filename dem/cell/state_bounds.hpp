// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>

#include "dem/cell/box.hpp"
#include "dem/spheres/space_box.hpp"

namespace polargrain::dem {

/// One grain of a state, in the frame of its box.
struct GrainMotion {
  double x = 0.0, y = 0.0;    ///< m
  double vx = 0.0, vy = 0.0;  ///< m/s
  double spin = 0.0;          ///< rad/s
  double turned = 0.0;        ///< rotation since the packing, rad
};

/// The same of a sphere in space.
struct SpaceMotionOfGrain {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< rad/s
  Eigen::Vector3d turned = Eigen::Vector3d::Zero();    ///< rotation since the packing, rad
};

// Bounds of the numbers in a state. Numbers that no evaluation leaves behind would make lists without end, not
// answers.

/// The fault of the box of a state; empty when it is sound. @param grain_area of all grains, m^2
std::string box_fault(const Box& box, double grain_area);
/// The same in space. @param grain_volume of all grains, m^3
std::string box_fault(const SpaceBox& box, double grain_volume);

/// The fault of a grain; empty when it is sound. @param grain its number, for the message
/// @param radius m @param time_step s; 0: not known, motions need only be finite
std::string motion_fault(const Box& box, std::size_t grain, const GrainMotion& motion, double radius,
                         double time_step);
std::string motion_fault(const SpaceBox& box, std::size_t grain, const SpaceMotionOfGrain& motion,
                         double radius, double time_step);

/// Most bytes that the state of so many grains may have, and the fewest: many times the size of their contacts,
/// and the places and motions alone.
std::size_t most_state_bytes(std::size_t grains);
std::size_t least_state_bytes(std::size_t grains);
/// Most contacts of so many grains whose springs a state may hold.
std::size_t most_state_contacts(std::size_t grains);

}  // namespace polargrain::dem
