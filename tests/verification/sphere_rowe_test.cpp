// SPDX-License-Identifier: GPL-2.0-or-later
// Regular packings of nearly rigid spheres that slide under compression along e_3 (Rowe 1962, Thornton 1979), against
// their equilibrium. Every contact that is closed has the direction n = (cos b cos a, cos b sin a, sin b), a one of
// equally spaced angles about e_3; contacts within a layer are open. By symmetry no sphere turns, and the sphere above
// comes down along the normal plane of e_3 and n, so that the contact force leans from n towards e_3 by the angle of
// friction f: (cos a cos(b + f), sin a cos(b + f), sin(b + f)) F. With k contacts of length l a sphere,
//   s33 = - k (l F / V) sin b sin(b + f),     s11 = s22 = - (k / 2) (l F / V) cos b cos(b + f),
//   s33 / s11 = 2 tan b tan(b + f),           sin b = sin b0 (1 + e33),     1 + e11 = cos b / cos b0.
// In plane strain (e22 = 0) of the face-centred packing, along a row of touching spheres, n = (x, y, z) keeps its y = 1/2
// and the sphere slides within the plane of x and z: with tan b = z / x, r^2 = x^2 + z^2 and tan f = mu / r,
//   s33 / s11 = tan b tan(b + f),    while s22 is whatever the rows along e_2 carry.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "dem/cell/cell_service.hpp"
#include "tests/support/sphere_lattices.hpp"

namespace polargrain::dem {
namespace {

/// A regular packing on its way down: its base vectors over the length of a contact, as a function of the angle of the
/// contacts that carry.
struct Packing {
  const char* name;
  double start;                           ///< of that angle, b0
  Eigen::Matrix3d (*base)(double angle);  ///< upper triangular
  std::vector<Eigen::Vector3d> places;    ///< in the box
  double (*ratio)(double angle, double friction);
};
double axisymmetric(double angle, double friction) {
  return 2.0 * std::tan(angle) * std::tan(angle + std::atan(friction));
}

/// Face-centred cubic, compressed along an edge of the cube: four spheres under each, contacts at 45 degrees.
Packing face_centred_along_edge() {
  return {"face_centred_along_edge",
          std::numbers::pi / 4.0,
          [](double b) {
            return Eigen::Matrix3d(
                Eigen::Vector3d(2.0 * std::cos(b), 2.0 * std::cos(b), 2.0 * std::sin(b)).asDiagonal());
          },
          {{0.1, 0.1, 0.1}, {0.6, 0.6, 0.1}, {0.6, 0.1, 0.6}, {0.1, 0.6, 0.6}},
          axisymmetric};
}

/// The same along the diagonal of the cube: triangular layers, three spheres under each.
Packing face_centred_along_diagonal() {
  return {"face_centred_along_diagonal",
          std::asin(std::sqrt(2.0 / 3.0)),
          [](double b) {
            // Rows of the layers have the spacing a, their spheres lie above the middle of triangles: a / sqrt 3 aside.
            const double a = std::sqrt(3.0) * std::cos(b);
            Eigen::Matrix3d base;
            base << a, 0.5 * a, 0.5 * a, 0.0, 0.5 * std::sqrt(3.0) * a, a / (2.0 * std::sqrt(3.0)), 0.0, 0.0,
                std::sin(b);
            return base;
          },
          {{0.1, 0.1, 0.1}},
          axisymmetric};
}

/// Body-centred cubic along an edge: four spheres under each, contacts at 35 degrees.
Packing body_centred() {
  return {"body_centred",
          std::atan(1.0 / std::numbers::sqrt2),
          [](double b) {
            const double side = std::numbers::sqrt2 * std::cos(b);
            return Eigen::Matrix3d(Eigen::Vector3d(side, side, 2.0 * std::sin(b)).asDiagonal());
          },
          {{0.1, 0.1, 0.1}, {0.6, 0.6, 0.6}},
          axisymmetric};
}

/// Face-centred along an edge again, in plane strain along rows of touching spheres. The angle is that of z over x.
Packing face_centred_in_plane_strain() {
  return {"face_centred_in_plane_strain",
          std::atan(std::numbers::sqrt2),
          [](double b) {
            const double r = std::sqrt(0.75);
            return Eigen::Matrix3d(
                Eigen::Vector3d(2.0 * r * std::cos(b), 1.0, 2.0 * r * std::sin(b)).asDiagonal());
          },
          {{0.1, 0.1, 0.1}, {0.6, 0.6, 0.6}},
          [](double b, double friction) {
            return std::tan(b) * std::tan(b + std::atan(friction / std::sqrt(0.75)));
          }};
}

class SphereRowe : public ::testing::TestWithParam<std::tuple<Packing (*)(), double>> {};

TEST_P(SphereRowe, StressRatioFollowsTheAngleOfTheContacts) {
  const Packing packing = std::get<0>(GetParam())();
  const double friction = std::get<1>(GetParam());
  // k_n over the pressure is some 1e4: the spheres are rigid for what is measured.
  const double length = test::kDiameter * (1.0 - 1e-4);
  const auto angle = [&packing](double strain) {
    return std::asin(std::sin(packing.start) * (1.0 + strain));
  };
  // Odd: with two cells along a base vector triangular layers slide in pairs, 0.2 to 3 % below.
  constexpr int kRepeats = 3;
  // Compressed by 0.2 % already, so that the contacts within a layer are open.
  double strain = -0.002;
  test::Lattice lattice{packing.base(angle(strain)), packing.places, {}};
  CellDefinition definition = test::definition_of(lattice, kRepeats);
  const double scale = length / test::kSpacing;
  definition.packing.box *= scale;
  definition.packing.lean *= scale;
  definition.packing.thickness *= scale;
  for (Grain& grain : definition.packing.grains) {
    grain.position *= scale;
    grain.height *= scale;
  }
  const std::string property = "coefficientFriction peratomtypepair 1 1e3";
  const auto place = definition.script.find(property);
  ASSERT_NE(place, std::string::npos);
  definition.script.replace(place, property.size(),
                            "coefficientFriction peratomtypepair 1 " + std::to_string(friction));
  definition.control = {};
  definition.control.inertial_number = 5e-3;
  // Spheres at their limit let go one after the other where they ring.
  definition.control.damping = 0.5;
  definition.control.tangent = CellTangent::none;
  const auto cell = make_cell_service(definition);
  StatePointer state;
  Eigen::Matrix3d now = packing.base(angle(strain));
  double largest = 0.0;
  double asymmetry = 0.0;
  for (int step = 1; step <= 48; ++step) {
    strain -= 0.001;
    const Eigen::Matrix3d next = packing.base(angle(strain));
    CellRequest request;
    request.state = state;
    // Keeps the contacts at their length; the spheres can only slide.
    request.increment.displacement_gradient = next * now.inverse() - Eigen::Matrix3d::Identity();
    const CellReply reply = cell->evaluate(request);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    state = reply.state;
    now = next;
    const Eigen::Matrix3d& stress = reply.response.stress;
    if (strain > -0.0095) continue;  // until sliding has set in everywhere
    const double expected = packing.ratio(angle(strain), friction);
    const double found = stress(2, 2) / stress(0, 0);
    largest = std::max(largest, std::abs(found / expected - 1.0));
    if (packing.ratio == axisymmetric)
      asymmetry = std::max(asymmetry, std::abs(stress(1, 1) / stress(0, 0) - 1.0));
    for (const double printed : {0.01, 0.05})
      if (std::abs(strain + printed) < 1e-6)
        std::printf("[figure] %s, mu %.1f, e33 %.0f %%: s33 / s11 %.4f, exact %.4f\n", packing.name, friction,
                    100.0 * strain, found, expected);
  }
  std::printf("[figure] %s, mu %.1f: stress ratio within %.1e of the closed form\n", packing.name, friction,
              largest);
  // In plane strain the friction of the rows along e_2 has a share that goes with the overlap of 1e-4.
  EXPECT_LT(largest, 2e-4);
  EXPECT_LT(asymmetry, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Packings, SphereRowe,
                         ::testing::Combine(::testing::Values(face_centred_along_edge,
                                                              face_centred_along_diagonal, body_centred,
                                                              face_centred_in_plane_strain),
                                            ::testing::Values(0.2, 0.3)));

}  // namespace
}  // namespace polargrain::dem
