// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <numbers>
#include <string>

#include "dem/box/box.hpp"

namespace polargrain::dem {

/// One grain of a state, as plain numbers: place and velocity in the frame of the box, spin, and its rotation since the
/// packing in the laboratory.
template <int dim>
struct GrainMotion {
  std::array<double, dim> place{}, velocity{};                    ///< m, m/s
  std::array<double, Cosserat<dim>::rotations> spin{}, turned{};  ///< rad/s, rad
};

/// Area of a disc, m^2, or volume of a sphere, m^3.
template <int dim>
double grain_size(double radius) {
  if constexpr (dim == 2) {
    return std::numbers::pi * radius * radius;
  } else {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  }
}

// Bounds of the numbers in a state. Numbers that no evaluation leaves behind would make lists without end, not
// answers.

/// The fault of the box of a state; empty when it is sound. @param grain_sizes sum over all grains, m^2 or m^3
std::string box_fault(const Box<2>& box, double grain_sizes);
std::string box_fault(const Box<3>& box, double grain_sizes);

/// The fault of a grain; empty when it is sound. @param grain its number, for the message
/// @param radius m @param time_step s; 0: not known, motions need only be finite
std::string motion_fault(const Box<2>& box, std::size_t grain, const GrainMotion<2>& motion, double radius,
                         double time_step);
std::string motion_fault(const Box<3>& box, std::size_t grain, const GrainMotion<3>& motion, double radius,
                         double time_step);

/// Most bytes that the state of so many grains may have, and the fewest: many times the size of their contacts,
/// and the places and motions alone.
std::size_t most_state_bytes(std::size_t grains);
std::size_t least_state_bytes(std::size_t grains);
/// Most contacts of so many grains whose springs a state may hold.
std::size_t most_state_contacts(std::size_t grains);

}  // namespace polargrain::dem
