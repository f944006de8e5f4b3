// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/cell.hpp"

namespace polargrain::test {

// Regular lattices of equal spheres whose contacts all stick, with bending and torsion, as packings and in closed form
// (docs/theory/grains.md, C.9).

inline constexpr double kNormal = 1e6;      // N/m
inline constexpr double kTangential = 4e5;  // N/m
inline constexpr double kBending = 2.0;     // N m; the torsion of li_chu has the same stiffness
inline constexpr double kDiameter = 0.01;   // m
inline constexpr double kOverlap = 2e-4;    // of the diameter
inline constexpr double kSpacing = kDiameter * (1.0 - kOverlap);

/// A lattice: base vectors over the spacing as columns, places in them, and how often it is repeated along each.
struct Lattice {
  Eigen::Matrix3d base;
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Vector3d> contacts;  ///< directions, one of each two opposite ones
};

inline Lattice simple_cubic() {
  return {Eigen::Matrix3d::Identity(), {{0.25, 0.25, 0.25}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

/// Face-centred cubic with the cube along the axes.
inline Lattice face_centred() {
  const double h = 1.0 / std::numbers::sqrt2;
  return {std::numbers::sqrt2 * Eigen::Matrix3d::Identity(),
          {{0.1, 0.1, 0.1}, {0.6, 0.6, 0.1}, {0.6, 0.1, 0.6}, {0.1, 0.6, 0.6}},
          {{h, h, 0}, {h, -h, 0}, {h, 0, h}, {h, 0, -h}, {0, h, h}, {0, h, -h}}};
}

/// The same lattice by its three shortest vectors, a box with all tilts, layers of triangles in the plane.
inline Lattice face_centred_tilted() {
  Lattice lattice;
  lattice.base << 1.0, 0.5, 0.5, 0.0, std::sqrt(3.0) / 2.0, std::sqrt(3.0) / 6.0, 0.0, 0.0,
      std::sqrt(2.0 / 3.0);
  lattice.places = {{0.1, 0.1, 0.1}};
  const auto a = lattice.base.col(0), b = lattice.base.col(1), c = lattice.base.col(2);
  lattice.contacts = {a, b, c, a - b, b - c, c - a};
  return lattice;
}

inline CellDefinition definition_of(const Lattice& lattice, int repeats) {
  CellDefinition definition;
  definition.name = "lattice";
  definition.script_file = "lattice.in";
  definition.script =
      "units si\ndimension 3\natom_style granular\natom_modify map array\nboundary p p p\nnewton off\n"
      "communicate single vel yes\nread_data ${packing}\nneighbor 0.001 bin\nneigh_modify delay 0\n"
      "fix kn all property/global kn peratomtypepair 1 1e6\nfix kt all property/global kt peratomtypepair 1 4e5\n"
      "fix gn all property/global gamman_abs peratomtypepair 1 0\n"
      "fix gt all property/global gammat_abs peratomtypepair 1 0\n"
      "fix mu all property/global coefficientFriction peratomtypepair 1 1e3\n"
      // k_th = ratio * k_t R*^2, R* a quarter of the diameter.
      "fix fr all property/global coefficientRollingFriction peratomtypepair 1 1e3\n"
      "fix kr all property/global rollingStiffnessRatio peratomtypepair 1 0.8\n"
      "pair_style gran model hooke/stiffness tangential li_chu rolling_friction li_chu absolute_damping on "
      "torsionTorque on\npair_coeff * *\nfix integrate all nve/sphere\n";
  const Eigen::Matrix3d base = repeats * kSpacing * lattice.base;
  definition.packing.dimension = 3;
  definition.packing.box = base.topLeftCorner<2, 2>();
  definition.packing.lean = base.topRightCorner<2, 1>();
  definition.packing.thickness = base(2, 2);
  for (int i = 0; i < repeats; ++i)
    for (int j = 0; j < repeats; ++j)
      for (int k = 0; k < repeats; ++k)
        for (const Eigen::Vector3d& place : lattice.places) {
          const Eigen::Vector3d at = kSpacing * lattice.base * (place + Eigen::Vector3d(i, j, k));
          Grain grain;
          grain.id = static_cast<std::int64_t>(definition.packing.grains.size());
          grain.position = at.head<2>();
          grain.height = at.z();
          grain.radius = 0.5 * kDiameter;
          grain.mass = 2650.0 * 4.0 / 3.0 * std::numbers::pi * std::pow(grain.radius, 3);
          grain.moment_of_inertia = 0.4 * grain.mass * grain.radius * grain.radius;
          definition.packing.grains.push_back(grain);
        }
  definition.control.inertial_number = 2.4e-4;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e-7;
  definition.control.damping = 0.5;
  return definition;
}

/// sigma_ij = C_ijkl eps_kl and m_ij = B_ijkl kappa_kl with C = (l^2/V) sum n_i n_k (k_n n_j n_l + k_t (d_jl - n_j n_l))
/// over the contacts of one grain, each once, and B the same with bending and torsion: grains that move affinely are in
/// equilibrium in a lattice.
inline Matrix18 closed_form(const Lattice& lattice) {
  const double volume =
      std::pow(kSpacing, 3) * lattice.base.determinant() / static_cast<double>(lattice.places.size());
  Matrix18 tangent = Matrix18::Zero();
  for (const Eigen::Vector3d& n : lattice.contacts)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) {
            const double across = (j == l ? 1.0 : 0.0) - n(j) * n(l);
            const double share = kSpacing * kSpacing / volume * n(i) * n(k);
            tangent(3 * i + j, 3 * k + l) += share * (kNormal * n(j) * n(l) + kTangential * across);
            tangent(9 + 3 * i + j, 9 + 3 * k + l) += share * kBending * (across + n(j) * n(l));
          }
  return tangent;
}

}  // namespace polargrain::test
