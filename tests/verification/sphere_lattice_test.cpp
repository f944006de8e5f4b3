// SPDX-License-Identifier: GPL-2.0-or-later
// Regular lattices of equal spheres whose contacts all stick: stiffness against closed form (docs/theory/grains.md, C.9).
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "dem/cell/cell_service.hpp"
#include "tests/support/sphere_cells.hpp"

namespace polargrain::dem {
namespace {

constexpr double kNormal = 1e6;      // N/m
constexpr double kTangential = 4e5;  // N/m
constexpr double kBending = 2.0;     // N m; the torsion of li_chu has the same stiffness
constexpr double kDiameter = 0.01;   // m
constexpr double kOverlap = 2e-4;    // of the diameter
constexpr double kSpacing = kDiameter * (1.0 - kOverlap);

/// A lattice: base vectors over the spacing as columns, places in them, and how often it is repeated along each.
struct Lattice {
  Eigen::Matrix3d base;
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Vector3d> contacts;  ///< directions, one of each two opposite ones
};

Lattice simple_cubic() {
  return {Eigen::Matrix3d::Identity(), {{0.25, 0.25, 0.25}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

/// Face-centred cubic with the cube along the axes.
Lattice face_centred() {
  const double h = 1.0 / std::numbers::sqrt2;
  return {std::numbers::sqrt2 * Eigen::Matrix3d::Identity(),
          {{0.1, 0.1, 0.1}, {0.6, 0.6, 0.1}, {0.6, 0.1, 0.6}, {0.1, 0.6, 0.6}},
          {{h, h, 0}, {h, -h, 0}, {h, 0, h}, {h, 0, -h}, {0, h, h}, {0, h, -h}}};
}

/// The same lattice by its three shortest vectors, a box with all tilts, layers of triangles in the plane.
Lattice face_centred_tilted() {
  Lattice lattice;
  lattice.base << 1.0, 0.5, 0.5, 0.0, std::sqrt(3.0) / 2.0, std::sqrt(3.0) / 6.0, 0.0, 0.0,
      std::sqrt(2.0 / 3.0);
  lattice.places = {{0.1, 0.1, 0.1}};
  const auto a = lattice.base.col(0), b = lattice.base.col(1), c = lattice.base.col(2);
  lattice.contacts = {a, b, c, a - b, b - c, c - a};
  return lattice;
}

CellDefinition definition_of(const Lattice& lattice, int repeats) {
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
Matrix18 closed_form(const Lattice& lattice) {
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

TEST(SphereLatticeForm, ModuliByHand) {
  // The sums above written out, so that both cannot be wrong alike.
  const Matrix18 cubic = closed_form(simple_cubic());
  EXPECT_NEAR(cubic(0, 0) * kSpacing / kNormal, 1.0, 1e-12);
  EXPECT_NEAR(cubic(0, 4), 0.0, 1e-6);
  EXPECT_NEAR(cubic(1, 1) * kSpacing / kTangential, 1.0, 1e-12);
  const Matrix18 fcc = closed_form(face_centred());
  const double unit = std::numbers::sqrt2 / kSpacing;
  EXPECT_NEAR(fcc(0, 0) / unit / (kNormal + kTangential), 1.0, 1e-12);
  EXPECT_NEAR(fcc(0, 4) / unit / (0.5 * (kNormal - kTangential)), 1.0, 1e-12);
  EXPECT_NEAR(fcc(1, 1) / unit / (0.5 * kNormal + 1.5 * kTangential), 1.0, 1e-12);
  EXPECT_NEAR(fcc(1, 3) / unit / (0.5 * (kNormal - kTangential)), 1.0, 1e-12);
}

struct Size {
  const char* name;
  Lattice (*lattice)();
  int repeats;
};
void PrintTo(const Size& size, std::ostream* out) {
  *out << size.name << "_" << size.repeats;
}

class SphereLattice : public testing::TestWithParam<Size> {};

TEST_P(SphereLattice, TangentsAreTheClosedForm) {
  const Lattice lattice = GetParam().lattice();
  CellDefinition definition = definition_of(lattice, GetParam().repeats);
  const Matrix18 expected = closed_form(lattice);
  definition.control.tangent = CellTangent::cosserat;
  const Matrix18 found = make_cell_service(definition)->initial().response.tangent;
  const double forces =
      (found - expected).topLeftCorner<9, 9>().norm() / expected.topLeftCorner<9, 9>().norm();
  const double couples =
      (found - expected).bottomRightCorner<9, 9>().norm() / expected.bottomRightCorner<9, 9>().norm();
  // Nothing but round-off: a lattice needs no fluctuations.
  EXPECT_LT(forces, 1e-9);
  EXPECT_LT(couples, 1e-9);
  const double mixed = found.topRightCorner<9, 9>().norm() / expected.bottomRightCorner<9, 9>().norm();
  EXPECT_LT(mixed, 1e-9 / kSpacing);
}

TEST_P(SphereLattice, StressesFollowTheClosedForm) {
  const Lattice lattice = GetParam().lattice();
  CellDefinition definition = definition_of(lattice, GetParam().repeats);
  definition.control.tangent = CellTangent::condensed;
  const auto cell = make_cell_service(definition);
  const CellReply rest = cell->initial();
  const Matrix18 cosserat = closed_form(lattice);
  constexpr double kStrain = 1e-6;
  double worst = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      CellRequest request;
      request.increment.displacement_gradient(i, j) = kStrain;
      const CellReply reply = cell->evaluate(request);
      ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
      // Free rotations feel the symmetric strain; a simple shear also turns what was there.
      Eigen::Matrix<double, 18, 1> strain = Eigen::Matrix<double, 18, 1>::Zero();
      strain(3 * i + j) += 0.5 * kStrain;
      strain(3 * j + i) += 0.5 * kStrain;
      const Eigen::Matrix<double, 18, 1> expected = cosserat * strain;
      const Eigen::Matrix<double, 18, 1> found = (reply.response.components() - rest.response.components());
      worst = std::max(worst, (found - expected).head<9>().norm() / expected.head<9>().norm());
      // The tangent of free rotations says the same.
      const Eigen::Matrix<double, 18, 1> linear = reply.response.tangent * strain;
      EXPECT_LT((linear - expected).head<9>().norm() / expected.head<9>().norm(), 1e-3);
    }
  std::printf("[figure] %s of %d repeats: largest error of a stress %.1e\n", GetParam().name,
              GetParam().repeats, worst);
  // The overlap of 2e-4, which also makes a simple shear turn the pressure that was there, and the rest of 1e-7 of it.
  EXPECT_LT(worst, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, SphereLattice,
                         testing::Values(Size{"simple_cubic", simple_cubic, 4},
                                         Size{"simple_cubic", simple_cubic, 6},
                                         Size{"face_centred", face_centred, 3},
                                         Size{"face_centred_tilted", face_centred_tilted, 4},
                                         Size{"face_centred_tilted", face_centred_tilted, 6}),
                         [](const auto& instance) {
                           return std::string(instance.param.name) + "_" +
                                  std::to_string(instance.param.repeats);
                         });

}  // namespace
}  // namespace polargrain::dem
