// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/cell_tangents.hpp"

#include "dem/cell/tangents.hpp"

namespace polargrain::dem {

namespace {

/// Spring that holds each grain in the condensed tangent, over the mean normal stiffness. From 1e-6 to 1e-3
/// it changes no modulus by more than 1 %.
constexpr double kHold = 1e-4;

/// The same in the tangent of spheres along an increment. Networks whose contacts slide have motions with next to no
/// stiffness, or a negative one; with kHold these can make the tangent several times too large. In the cell the damping
/// against the affine flow holds the grains: its rate times the mean mass over the time of an increment is about this
/// much. Chosen by differences of cells (bench/sphere_tangent_bench.cpp).
constexpr double kHoldOnTheWay = 3e-3;

}  // namespace

template <>
void CellTangents<2>::start(const GrainBox<2>& /*box*/) {}

template <>
void CellTangents<3>::start(const GrainBox<3>& box) {
  if (control_.tangent == CellTangent::condensed)
    slip_.start(box.contacts(), box.places().data(), box.rotations(), box.box(), grains_);
}

template <>
Matrix7 CellTangents<2>::of(const GrainBox<2>& box, std::span<const double> weights, double volume,
                            const Way* way) {
  if (control_.tangent == CellTangent::none) return Matrix7::Zero();
  const ContactNetwork network{box.contacts(), grains_, box.box().frame(),
                               volume,         kHold,   way == nullptr ? 0.0 : way->size};
  const auto voigt = [&network, this] {
    return controlled() ? voigt_cosserat_tangent(network.contacts, network.frame, network.volume)
                        : voigt_tangent(network.contacts, network.frame, network.volume);
  };
  if (control_.tangent == CellTangent::voigt) return voigt();
  if (control_.tangent == CellTangent::condensed && !controlled()) {
    const auto found = condensed_.classical(network);
    return found ? *found : voigt();
  }
  // Grains that have no neighbours but one each have no mean rotation that could be held.
  std::optional<Matrix7> condensed;
  if (!weights.empty()) condensed = condensed_.cosserat(network, weights);
  if (condensed) return *condensed;
  return voigt_cosserat_tangent(network.contacts, network.frame, network.volume);
}

template <>
Matrix18 CellTangents<3>::of(const GrainBox<3>& box, std::span<const double> weights, double volume,
                             const Way* way) {
  if (control_.tangent == CellTangent::none) return Matrix18::Zero();
  std::vector<SpaceSlip> slips;
  if (way != nullptr && control_.tangent == CellTangent::condensed) {
    Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
    if (controlled()) curvature = way->increment.curvature;
    slips = slip_.until(box.contacts(), box.rotations(), box.box(), curvature);
  }
  const SpaceNetwork network{
      box.contacts(), grains_, box.box().frame(), volume, slips.empty() ? kHold : kHoldOnTheWay, slips};
  const auto voigt = [&network, this] {
    return controlled() ? voigt_cosserat_space_tangent(network) : voigt_space_tangent(network);
  };
  if (control_.tangent == CellTangent::voigt) return voigt();
  if (control_.tangent == CellTangent::condensed && !controlled()) {
    const auto found = condensed_.classical(network);
    return found ? *found : voigt();
  }
  std::optional<Matrix18> condensed;
  if (!weights.empty()) condensed = condensed_.cosserat(network, weights);
  return condensed ? *condensed : voigt_cosserat_space_tangent(network);
}

template class CellTangents<2>;
template class CellTangents<3>;

}  // namespace polargrain::dem
