// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/box/state_bounds.hpp"

#include <fmt/format.h>

#include <cmath>

namespace polargrain::dem {

namespace {

/// Area of the box over that of the grains; sides over each other; rotations, rad.
constexpr double kLeastArea = 0.3;
constexpr double kMostArea = 1e3;
constexpr double kMostTurns = 1e6;
constexpr double kMostTilt = 0.6;  // in space, of the side it leans along

/// Grains that do not overlap have three contacts each on average in the plane, and six in space.
constexpr std::size_t kMostContactsPerGrain = 24;
/// Partner, image and sixteen springs of a contact.
constexpr std::size_t kBytesPerContact = 16 + 16 * sizeof(double);
/// Place, motion, type, mass and what scripts may add to a grain.
constexpr std::size_t kBytesPerGrain = 1024;
constexpr std::size_t kBytesOfHeader = 1024;

}  // namespace

std::string box_fault(const Box<2>& box, double grain_area) {
  const bool is_sound = box.size() > kLeastArea * grain_area && box.size() < kMostArea * grain_area &&
                        box.base(0, 0) > 0.0 && std::abs(box.base(0, 1)) <= 0.6 * box.base(0, 0) &&
                        box.base(0, 0) < kMostArea * box.base(1, 1) &&
                        box.base(1, 1) < kMostArea * box.base(0, 0) && std::abs(box.orientation) < kMostTurns;
  if (is_sound) return {};
  return fmt::format(
      "this state of a cell is damaged: its box has sides of {:.3g} and {:.3g} m, a tilt of {:.3g} m and is "
      "turned by {:.3g} rad",
      box.base(0, 0), box.base(1, 1), box.base(0, 1), box.orientation);
}

std::string motion_fault(const Box<2>& box, std::size_t grain, const GrainMotion<2>& motion, double radius,
                         double time_step) {
  const auto [x, y] = motion.place;
  const auto [vx, vy] = motion.velocity;
  const double spin = motion.spin[0];
  const bool is_sound = y >= -radius && y <= box.base(1, 1) + radius &&
                        std::abs(x) <= 2.0 * box.base(0, 0) + radius && std::isfinite(vx) &&
                        std::isfinite(vy) && std::isfinite(spin) && std::abs(vx) * time_step < radius &&
                        std::abs(vy) * time_step < radius && std::abs(spin) * time_step < 1.0 &&
                        std::abs(motion.turned[0]) < kMostTurns;
  if (is_sound) return {};
  return fmt::format(
      "this state of a cell is damaged: grain {} lies at ({:.3g}, {:.3g}) m and moves at ({:.3g}, {:.3g}) "
      "m/s and {:.3g} rad/s, turned by {:.3g} rad",
      grain, x, y, vx, vy, spin, motion.turned[0]);
}

std::string box_fault(const Box<3>& box, double grain_volume) {
  const Eigen::Vector3d sides = box.base.diagonal();
  bool is_sound = box.base.allFinite() && box.orientation.allFinite() && sides.minCoeff() > 0.0 &&
                  sides.maxCoeff() < kMostArea * sides.minCoeff() && box.size() > kLeastArea * grain_volume &&
                  box.size() < kMostArea * grain_volume;
  is_sound = is_sound && std::abs(box.base(0, 1)) <= kMostTilt * sides(0) &&
             std::abs(box.base(0, 2)) <= kMostTilt * sides(0) &&
             std::abs(box.base(1, 2)) <= kMostTilt * sides(1);
  constexpr double kSkewed = 1e-6;  // of a frame that has been turned a million times and more
  is_sound = is_sound &&
             (box.orientation.transpose() * box.orientation - Eigen::Matrix3d::Identity()).norm() < kSkewed;
  if (is_sound) return {};
  return fmt::format(
      "this state of a cell is damaged: its box has sides of {:.3g}, {:.3g} and {:.3g} m, tilts of {:.3g}, "
      "{:.3g} and {:.3g} m, or a frame that is no rotation",
      sides(0), sides(1), sides(2), box.base(0, 1), box.base(0, 2), box.base(1, 2));
}

std::string motion_fault(const Box<3>& box, std::size_t grain, const GrainMotion<3>& motion, double radius,
                         double time_step) {
  const Eigen::Vector3d place(motion.place.data());
  const Eigen::Vector3d velocity(motion.velocity.data());
  const Eigen::Vector3d spin(motion.spin.data());
  const Eigen::Vector3d turned(motion.turned.data());
  // A grain may have left the box by a little, and a box that is tilted holds more than its sides tell.
  const double reach = 2.0 * box.base.diagonal().sum() + radius;
  const bool is_sound = place.cwiseAbs().maxCoeff() <= reach && velocity.allFinite() && spin.allFinite() &&
                        velocity.cwiseAbs().maxCoeff() * time_step < radius &&
                        spin.cwiseAbs().maxCoeff() * time_step < 1.0 &&
                        turned.cwiseAbs().maxCoeff() < kMostTurns;
  if (is_sound) return {};
  return fmt::format(
      "this state of a cell is damaged: grain {} lies at ({:.3g}, {:.3g}, {:.3g}) m and moves at {:.3g} m/s and "
      "{:.3g} rad/s, turned by {:.3g} rad",
      grain, place.x(), place.y(), place.z(), velocity.norm(), spin.norm(), turned.norm());
}

std::size_t most_state_contacts(std::size_t grains) {
  return kMostContactsPerGrain * grains;
}

std::size_t most_state_bytes(std::size_t grains) {
  return kBytesOfHeader + grains * kBytesPerGrain + most_state_contacts(grains) * kBytesPerContact;
}

std::size_t least_state_bytes(std::size_t grains) {
  return grains * sizeof(GrainMotion<2>);
}

}  // namespace polargrain::dem
