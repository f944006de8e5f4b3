// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>

namespace polargrain::app {

// The signs of a drawing of a case, as SVG; in the plane and in space.

/// Units of the drawing: pixels at its full size.
constexpr double kLongerSide = 760.0;
constexpr double kLeastScale = 0.6;  ///< its words can still be read; a narrower page scrolls
constexpr double kMargin = 90.0;
constexpr double kArrow = 46.0;
constexpr double kSymbol = 11.0;
constexpr double kSpacing = 34.0;  ///< least, between symbols of one boundary

constexpr std::array<const char*, 6> kRegionColours{"#e9d8a6", "#b8d8ba", "#bcd4e6",
                                                    "#e6c1c1", "#d5c6e0", "#d9d9d9"};
constexpr const char* kSupport = "#1d6996";
constexpr const char* kMovement = "#0f8554";
constexpr const char* kLoad = "#c4432b";
constexpr const char* kWater = "#3b8bc2";
constexpr const char* kFree = "#e17c05";

std::string point(const Eigen::Vector2d& p);
/// All in units of the drawing.
std::string arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const char* colour);
/// A triangle whose tip is at the node, with the ground behind it.
std::string support(const Eigen::Vector2d& tip, const Eigen::Vector2d& outward, bool is_filled);
/// Of a micro-rotation that is held.
std::string square(const Eigen::Vector2d& at);
/// The sign of a free surface of water: a line with a triangle on it.
std::string water_surface(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
/// A length of 1, 2 or 5 times a power of ten, about a fifth of the drawing, with its value.
/// @param extent of the body, m @param scale units of the drawing a metre @param height of the drawing
std::string scale_bar(double extent, double scale, double height);

}  // namespace polargrain::app
