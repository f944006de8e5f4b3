// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <vector>

#include "common/grain_view.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// The view of a cell, from the data of its engine in the frame of the box.
/// @param grains whose places may be outside of the box; their numbers of contacts are found here
/// @param contacts count the grains in that order
/// @param base base vectors of the box in its frame as columns, upper triangular, m @param frame box frame to laboratory
GrainView grains_in_laboratory(std::vector<GrainView::Grain> grains, std::span<const Contact> contacts,
                               const Eigen::Matrix3d& base, const Eigen::Matrix3d& frame);

}  // namespace polargrain::dem
