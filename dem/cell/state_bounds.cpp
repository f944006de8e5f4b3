// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/state_bounds.hpp"

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

std::string box_fault(const Box& box, double grain_area) {
  const bool is_sound = box.area() > kLeastArea * grain_area && box.area() < kMostArea * grain_area &&
                        box.length_x > 0.0 && std::abs(box.tilt) <= 0.6 * box.length_x &&
                        box.length_x < kMostArea * box.length_y && box.length_y < kMostArea * box.length_x &&
                        std::abs(box.rotation) < kMostTurns;
  if (is_sound) return {};
  return fmt::format(
      "this state of a cell is damaged: its box has sides of {:.3g} and {:.3g} m, a tilt of {:.3g} m and is "
      "turned by {:.3g} rad",
      box.length_x, box.length_y, box.tilt, box.rotation);
}

std::string motion_fault(const Box& box, std::size_t grain, const GrainMotion& motion, double radius,
                         double time_step) {
  const bool is_sound = motion.y >= -radius && motion.y <= box.length_y + radius &&
                        std::abs(motion.x) <= 2.0 * box.length_x + radius && std::isfinite(motion.vx) &&
                        std::isfinite(motion.vy) && std::isfinite(motion.spin) &&
                        std::abs(motion.vx) * time_step < radius &&
                        std::abs(motion.vy) * time_step < radius && std::abs(motion.spin) * time_step < 1.0 &&
                        std::abs(motion.turned) < kMostTurns;
  if (is_sound) return {};
  return fmt::format(
      "this state of a cell is damaged: grain {} lies at ({:.3g}, {:.3g}) m and moves at ({:.3g}, {:.3g}) "
      "m/s and {:.3g} rad/s, turned by {:.3g} rad",
      grain, motion.x, motion.y, motion.vx, motion.vy, motion.spin, motion.turned);
}

std::string box_fault(const SpaceBox& box, double grain_volume) {
  const Eigen::Vector3d sides = box.base.diagonal();
  bool is_sound = box.base.allFinite() && box.frame.allFinite() && sides.minCoeff() > 0.0 &&
                  sides.maxCoeff() < kMostArea * sides.minCoeff() &&
                  box.volume() > kLeastArea * grain_volume && box.volume() < kMostArea * grain_volume;
  is_sound = is_sound && std::abs(box.base(0, 1)) <= kMostTilt * sides(0) &&
             std::abs(box.base(0, 2)) <= kMostTilt * sides(0) &&
             std::abs(box.base(1, 2)) <= kMostTilt * sides(1);
  constexpr double kSkewed = 1e-6;  // of a frame that has been turned a million times and more
  is_sound = is_sound && (box.frame.transpose() * box.frame - Eigen::Matrix3d::Identity()).norm() < kSkewed;
  if (is_sound) return {};
  return fmt::format(
      "this state of a cell is damaged: its box has sides of {:.3g}, {:.3g} and {:.3g} m, tilts of {:.3g}, "
      "{:.3g} and {:.3g} m, or a frame that is no rotation",
      sides(0), sides(1), sides(2), box.base(0, 1), box.base(0, 2), box.base(1, 2));
}

std::string motion_fault(const SpaceBox& box, std::size_t grain, const SpaceMotionOfGrain& motion,
                         double radius, double time_step) {
  // A grain may have left the box by a little, and a box that is tilted holds more than its sides tell.
  const double reach = 2.0 * box.base.diagonal().sum() + radius;
  const bool is_sound =
      motion.place.cwiseAbs().maxCoeff() <= reach && motion.velocity.allFinite() && motion.spin.allFinite() &&
      motion.velocity.cwiseAbs().maxCoeff() * time_step < radius &&
      motion.spin.cwiseAbs().maxCoeff() * time_step < 1.0 && motion.turned.cwiseAbs().maxCoeff() < kMostTurns;
  if (is_sound) return {};
  return fmt::format(
      "this state of a cell is damaged: grain {} lies at ({:.3g}, {:.3g}, {:.3g}) m and moves at {:.3g} m/s and "
      "{:.3g} rad/s, turned by {:.3g} rad",
      grain, motion.place.x(), motion.place.y(), motion.place.z(), motion.velocity.norm(), motion.spin.norm(),
      motion.turned.norm());
}

std::size_t most_state_contacts(std::size_t grains) {
  return kMostContactsPerGrain * grains;
}

std::size_t most_state_bytes(std::size_t grains) {
  return kBytesOfHeader + grains * kBytesPerGrain + most_state_contacts(grains) * kBytesPerContact;
}

std::size_t least_state_bytes(std::size_t grains) {
  return grains * sizeof(GrainMotion);
}

}  // namespace polargrain::dem
