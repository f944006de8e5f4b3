// SPDX-License-Identifier: GPL-2.0-or-later
// Cells of spheres whose rotations are controlled (docs/theory/grains.md, C.6, C.9): moduli of lattices against closed
// form, objectivity, limits of the skew stress and of the couple stress, virtual work, work and stored energy.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <random>

#include "common/error.hpp"
#include "dem/box/rotation.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/space_tangents.hpp"
#include "tests/support/sphere_cells.hpp"
#include "tests/support/sphere_lattices.hpp"

namespace polargrain::dem {
namespace {

/// The Cosserat strain of a small increment in the order of CellResponse::components: eps_ij = d u_j/d x_i - e_ijk w_k,
/// then d w_j/d x_i.
Vector18 strain_of(const CellIncrement& increment) {
  Vector18 strain;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double turn = 0.0;  // e_ijk w_k
      if (i != j) {
        const int k = 3 - i - j;
        turn = ((j - i + 3) % 3 == 1 ? 1.0 : -1.0) * increment.rotation(k);
      }
      strain(3 * i + j) = increment.displacement_gradient(j, i) - turn;
      strain(9 + 3 * i + j) = increment.curvature(j, i);
    }
  return strain;
}

/// A displacement gradient, a micro-rotation and a curvature with all their components.
CellIncrement some_increment() {
  CellIncrement made;
  made.displacement_gradient << 3e-4, 1e-4, -2e-4, 5e-5, -4e-4, 1e-4, 1.5e-4, -1e-4, 2e-4;
  made.rotation << 1e-4, -2e-4, 1.5e-4;
  made.curvature << 0.02, -0.01, 0.015, -0.02, 0.03, 0.01, 0.005, -0.015, 0.02;
  return made;
}

CellDefinition controlled(CellDefinition definition) {
  definition.control.rotations = CellRotations::controlled;
  return definition;
}

/// 500 spheres with Hertz's contacts, rolling resistance and torsion; coarse and quick.
CellDefinition quick_spheres_of_sphere_cosserat() {
  CellDefinition definition = controlled(test::rolling_spheres(test::hertz_spheres(), 1.0, 0.4));
  definition.control.inertial_number = 2e-3;
  definition.control.tangent = CellTangent::none;
  return definition;
}

double pressure(const CellReply& reply) {
  return -reply.response.stress.trace() / 3.0;
}

/// e_kij s_ij
Eigen::Vector3d skew(const Eigen::Matrix3d& s) {
  return {s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0)};
}

struct Size {
  const char* name;
  test::Lattice (*lattice)();
};
void PrintTo(const Size& size, std::ostream* out) {
  *out << size.name;
}

class CosseratLattice : public ::testing::TestWithParam<Size> {};

TEST_P(CosseratLattice, AnswersEveryStrainAndCurvatureAsTheClosedFormAtAnySize) {
  // 1, 8 and 27 cells of the lattice: in the smallest one a sphere touches nothing but its own images.
  const test::Lattice lattice = GetParam().lattice();
  const Matrix18 exact = test::closed_form(lattice);
  Matrix18 of_one = Matrix18::Zero();
  for (const int repeats : {1, 2, 3}) {
    CellDefinition definition = controlled(test::definition_of(lattice, repeats));
    const auto cell = make_cell_service(definition);
    const CellReply rest = cell->initial();
    // Of forces, then of couples, the farther away.
    const auto away = [](const Matrix18& found, const Matrix18& from) {
      const Matrix18 off = found - from;
      return std::max(off.topLeftCorner(9, 9).norm() / from.topLeftCorner(9, 9).norm(),
                      off.bottomRightCorner(9, 9).norm() / from.bottomRightCorner(9, 9).norm());
    };
    EXPECT_LT(away(rest.response.tangent, exact), 1e-9);
    Matrix18 found;
    for (int column = 0; column < 18; ++column) {
      // One component of the Cosserat strain after the other; a skew one is a displacement gradient without rotation.
      constexpr double kStrain = 1e-6;
      constexpr double kCurvature = 1e-4;  // rad/m: over a diameter the same
      CellRequest request;
      const int i = column % 9 / 3;
      const int j = column % 3;
      if (column < 9)
        request.increment.displacement_gradient(j, i) = kStrain;
      else
        request.increment.curvature(j, i) = kCurvature;
      const CellReply reply = cell->evaluate(request);
      ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
      ASSERT_NEAR(strain_of(request.increment)(column), column < 9 ? kStrain : kCurvature, 1e-20);
      found.col(column) =
          (reply.response.components() - rest.response.components()) / (column < 9 ? kStrain : kCurvature);
    }
    if (repeats == 1) of_one = found;
    std::printf("[figure] %s, %d cells of it: moduli %.1e from closed form, %.1e from those of one cell\n",
                GetParam().name, repeats * repeats * repeats, away(found, exact), away(found, of_one));
    // The overlap of 2e-4 shortens branches and arms, and a shear turns the pressure that was there.
    EXPECT_LT(away(found, exact), 1e-3);
    // No size effect but round-off and unrest.
    EXPECT_LT(away(found, of_one), 1e-7);
  }
}

TEST_P(CosseratLattice, ARelativeRotationIsASkewStrain) {
  const test::Lattice lattice = GetParam().lattice();
  const Matrix18 exact = test::closed_form(lattice);
  const auto cell = make_cell_service(controlled(test::definition_of(lattice, 2)));
  CellRequest request;
  request.increment.rotation = 1e-6 * Eigen::Vector3d(1.0, -2.0, 0.5);
  const CellReply reply = cell->evaluate(request);
  ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
  const Vector18 expected = exact * strain_of(request.increment);
  const Vector18 found = reply.response.components() - cell->initial().response.components();
  EXPECT_LT((found - expected).head<9>().norm(), 1e-3 * expected.head<9>().norm());
  // The multiplier is what the skew stress is balanced by (C.4).
  EXPECT_NEAR(reply.diagnostics.multiplier, -skew(reply.response.stress).z(),
              1e-4 * skew(reply.response.stress).norm());
}

INSTANTIATE_TEST_SUITE_P(Lattices, CosseratLattice,
                         ::testing::Values(Size{"simple_cubic", test::simple_cubic},
                                           Size{"face_centred", test::face_centred},
                                           Size{"face_centred_tilted", test::face_centred_tilted}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(CosseratSpheres, SameRequestGivesTheSameBitsWhateverCameBetween) {
  CellDefinition definition = quick_spheres_of_sphere_cosserat();
  definition.control.tangent = CellTangent::condensed;
  const auto cell = make_cell_service(definition);
  const CellRequest request{nullptr, some_increment()};
  const CellReply once = cell->evaluate(request);
  CellRequest between{once.state, some_increment()};
  between.increment.curvature *= -1.0;
  cell->evaluate(between);
  const CellReply again = cell->evaluate(request);
  const auto other = make_cell_service(definition);
  const CellReply elsewhere = other->evaluate(request);
  for (const CellReply* reply : {&again, &elsewhere}) {
    EXPECT_EQ(once.response.components(), reply->response.components());
    EXPECT_EQ(once.response.tangent, reply->response.tangent);
    EXPECT_TRUE(std::ranges::equal(once.state->bytes(), reply->state->bytes()));
  }
  EXPECT_GT(once.response.couple_stress.norm(), 0.0);
}

TEST(CosseratSpheres, ARotationOnTopTurnsStressAndCoupleStress) {
  const auto cell = make_cell_service(quick_spheres_of_sphere_cosserat());
  const CellRequest plain{nullptr, some_increment()};
  const CellReply straight = cell->evaluate(plain);
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, 3.0).normalized();
  const Eigen::Matrix3d turn = rotation_by(0.2 * axis);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  CellRequest request = plain;
  request.increment.displacement_gradient = turn * (one + plain.increment.displacement_gradient) - one;
  request.increment.rotation = rotation_vector(turn * rotation_by(plain.increment.rotation));
  const CellReply turned = cell->evaluate(request);
  ASSERT_EQ(turned.response.quality, Quality::good) << turned.response.message;
  EXPECT_EQ(turned.diagnostics.dem_steps, straight.diagnostics.dem_steps);
  const auto away = [&turn](const Eigen::Matrix3d& found, const Eigen::Matrix3d& from) {
    return (found - turn * from * turn.transpose()).norm() / from.norm();
  };
  const double stress = away(turned.response.stress, straight.response.stress);
  const double couples = away(turned.response.couple_stress, straight.response.couple_stress);
  std::printf(
      "[figure] strain, relative rotation and curvature with a rotation of 0.2 rad on top: stress %.1e, couple "
      "stress %.1e of itself away\n",
      stress, couples);
  // The same steps in the frame of the box; what is left is the growth of round-off.
  EXPECT_LT(stress, 1e-9);
  EXPECT_LT(couples, 1e-8);
  // And on from there, in the turned frame: axes, directions and all.
  CellRequest further{straight.state, some_increment()};
  const CellReply second = cell->evaluate(further);
  further.state = turned.state;
  further.increment.displacement_gradient = turn * further.increment.displacement_gradient * turn.transpose();
  further.increment.rotation = turn * further.increment.rotation;
  further.increment.curvature = turn * further.increment.curvature * turn.transpose();
  const CellReply second_turned = cell->evaluate(further);
  EXPECT_LT(away(second_turned.response.stress, second.response.stress), 1e-9);
  EXPECT_LT(away(second_turned.response.couple_stress, second.response.couple_stress), 1e-8);
}

TEST(CosseratSpheres, OtherBaseVectorsOfTheSameLatticeGiveTheSameAnswer) {
  // See SphereCell: other faces, other order of the contacts, another frame that turns in another way.
  CellDefinition definition = quick_spheres_of_sphere_cosserat();
  const CellRequest request{nullptr, some_increment()};
  const CellReply one = make_cell_service(definition)->evaluate(request);
  const Eigen::Matrix2d box = definition.packing.box;
  definition.packing.box << box.col(1), -box.col(0);
  definition.packing.lean += box.col(0);
  const CellReply other = make_cell_service(definition)->evaluate(request);
  const double stress = (other.response.stress - one.response.stress).norm() / one.response.stress.norm();
  const double couples =
      (other.response.couple_stress - one.response.couple_stress).norm() / one.response.couple_stress.norm();
  std::printf("[figure] another description of the lattice: stress %.1e, couple stress %.1e of itself away\n",
              stress, couples);
  EXPECT_LT(stress, 1e-5);
  EXPECT_LT(couples, 1e-4);
}

TEST(CosseratSpheres, SkewStressAtItsLimit) {
  // All contacts slide as the grains turn about an axis a: sum of (l x f) . a = mu sum l f_n |n x a|, whose mean over all
  // directions is pi / 4, so the skew stress is (3 pi / 4) mu p.
  CellDefinition definition = quick_spheres_of_sphere_cosserat();
  definition.control.damping = 0.5;
  const auto cell = make_cell_service(definition);
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0;
  CellRequest turn;
  turn.increment.rotation = 4e-3 * axis;
  const double mu = std::tan(0.5);
  double ratio = 0.0;
  double off = 0.0;
  for (int step = 1; step <= 20; ++step) {
    const CellReply reply = cell->evaluate(turn);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    turn.state = reply.state;
    const Eigen::Vector3d moment = -skew(reply.response.stress);
    ratio = moment.dot(axis) / (0.75 * std::numbers::pi * mu * pressure(reply));
    off = std::abs(reply.diagnostics.multiplier - moment.z()) / pressure(reply);
    // The mean unbalanced moment is below 5e-3 of force times radius, and those of grains cancel.
    EXPECT_LT(off, 5e-3);
  }
  std::printf(
      "[figure] skew stress over (3 pi / 4) mu p at a relative rotation of 0.08: %.3f; multiplier against skew stress: "
      "%.1e of the pressure\n",
      ratio, off);
  EXPECT_NEAR(ratio, 1.0, 0.05);
}

TEST(CosseratSpheres, CoupleStressOfMomentsAtTheirLimit) {
  // A curvature d w_3 / d x_1: a contact at its limit has bending mu_th r_c f_n along e_3 - n n_3 and torsion as much along
  // n; the mean of |n_1| (1 - n_3^2)^(1/2) over all directions is 4 / (3 pi), that of |n_1| |n_3| is 2 / (3 pi), so the
  // moments make m_13 = (4 / pi) mu_th r_c p, and with torsion (6 / pi).
  constexpr double kFriction = 0.2;
  for (const bool torsion : {false, true}) {
    CellDefinition definition =
        controlled(test::rolling_spheres(test::hertz_spheres(), 1.0, kFriction, torsion));
    definition.control.inertial_number = 2e-3;
    definition.control.tangent = CellTangent::none;
    const auto cell = make_cell_service(definition);
    CellRequest bend;
    bend.increment.curvature(2, 0) = 0.5;
    CellReply reply;
    for (int step = 1; step <= 16; ++step) {
      reply = cell->evaluate(bend);
      ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
      bend.state = reply.state;
    }
    double of_moments = 0.0;
    double sum = 0.0;
    double weights = 0.0;
    for (const Contact& contact : cell->contacts()) {
      of_moments += contact.branch.x() * contact.moment.z() / definition.packing.volume();
      const double weight = contact.branch.norm() * contact.normal_force();
      sum += weight * contact.arm_first * contact.arm_second / (contact.arm_first + contact.arm_second);
      weights += weight;
    }
    const double limit =
        (torsion ? 6.0 : 4.0) / std::numbers::pi * kFriction * (sum / weights) * pressure(reply);
    std::printf(
        "[figure] couple stress of the moments over its limit at a curvature of 8 rad/m, torsion %s: %.3f, %.0f "
        "%% of the contacts at the limit; the polar part adds %.3f\n",
        torsion ? "on" : "off", of_moments / limit, 100.0 * reply.diagnostics.rolling_fraction,
        (reply.response.couple_stress(0, 2) - of_moments) / limit);
    EXPECT_NEAR(of_moments / limit, 1.0, 0.1);
  }
}

TEST(CosseratSpheres, VirtualWorkOfAnyMotionIsThatOfTheStress) {
  // Hill-Mandel (C.4): for any strain and any motion of the grains whose weighted mean rotation vanishes, the work of the
  // contacts is V stress . strain, as exactly as the grains are balanced.
  CellDefinition definition = quick_spheres_of_sphere_cosserat();
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e-6;
  definition.control.damping = 0.3;
  const auto cell = make_cell_service(definition);
  const CellRequest request{nullptr, some_increment()};
  const CellReply reply = cell->evaluate(request);
  ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
  const std::span<const Contact> contacts = cell->contacts();
  const double volume = definition.packing.volume() *
                        (Eigen::Matrix3d::Identity() + request.increment.displacement_gradient).determinant();
  // The frame of the box: the packing's is the laboratory's, and the increment turns it a little.
  const Eigen::Matrix3d deformed =
      (Eigen::Matrix3d::Identity() + request.increment.displacement_gradient) *
      (Eigen::Matrix3d() << definition.packing.box(0, 0), definition.packing.box(0, 1),
       definition.packing.lean(0), definition.packing.box(1, 0), definition.packing.box(1, 1),
       definition.packing.lean(1), 0.0, 0.0, definition.packing.thickness)
          .finished();
  const Eigen::Matrix3d frame = triangular_parts(deformed).rotation;
  const std::vector<double> weights =
      rotation_weights(contacts, static_cast<int>(definition.packing.grains.size()));

  std::mt19937 numbers(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::Matrix<double, 6, 1>> motion(weights.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < motion.size(); ++k) {
    for (int m = 0; m < 6; ++m) motion[k](m) = (m < 3 ? 1e-2 : 1.0) * uniform(numbers);
    mean += weights[k] * motion[k].tail<3>();
  }
  for (auto& m : motion) m.tail<3>() -= mean;
  Vector18 strain;
  for (int k = 0; k < 18; ++k) strain(k) = (k < 9 ? 1.0 : 50.0) * uniform(numbers);
  double work = 0.0;
  double size = 0.0;
  for (const Contact& contact : contacts) {
    const LinearSpaceContact law(contact, frame);
    Eigen::Matrix<double, 12, 1> both;
    both << motion[static_cast<std::size_t>(contact.first)], motion[static_cast<std::size_t>(contact.second)];
    const Eigen::Matrix<double, 6, 1> opening = law.motions * both + law.affine * strain;
    const double done =
        (frame * contact.force).dot(opening.head<3>()) + (frame * contact.moment).dot(opening.tail<3>());
    work += done;
    size += std::abs(done);
  }
  const double of_stress = volume * reply.response.components().dot(strain);
  std::printf(
      "[figure] virtual work of the contacts of spheres against that of the stress: %.1e of the sum of magnitudes; "
      "skew stress %.3f of the pressure, couple stress %.2e N/m\n",
      std::abs(work - of_stress) / size, skew(reply.response.stress).norm() / pressure(reply),
      reply.response.couple_stress.norm());
  EXPECT_LT(std::abs(work - of_stress), 1e-6 * size);
}

TEST(CosseratSpheres, WorkIsTheStoredEnergyWhenNothingSlips) {
  CellDefinition definition = controlled(test::rolling_spheres(test::linear_spheres(), 4.0, 1e3));
  const std::string friction = "0.5463024898437905";
  definition.script.replace(definition.script.find(friction), friction.size(), "1e3");
  definition.control.inertial_number = 5e-4;
  definition.control.tangent = CellTangent::none;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e-4;
  const auto cell = make_cell_service(definition);
  const auto energy = [&cell] {
    double sum = 0.0;
    for (const Contact& contact : cell->contacts()) {
      const Eigen::Vector3d n = contact.branch.normalized();
      const double normal = contact.force.dot(n);
      sum += 0.5 * normal * normal / contact.normal_stiffness +
             0.5 * (contact.force - normal * n).squaredNorm() / contact.tangential_stiffness +
             0.5 * contact.moment.squaredNorm() / contact.rolling_stiffness;  // torsion is as stiff
    }
    return sum;
  };
  CellRequest request;
  request.increment.displacement_gradient << -1e-5, 4e-5, 0.0, 0.0, -3e-5, 2e-5, 1e-5, 0.0, -2e-5;
  request.increment.rotation << 4e-5, -2e-5, 3e-5;
  request.increment.curvature << 8e-3, -4e-3, 4e-3, 6e-3, 2e-3, -8e-3, 4e-3, 6e-3, -4e-3;
  const Vector18 strain = strain_of(request.increment);
  CellReply reply = cell->evaluate(CellRequest{});  // records the contacts of the start
  const double start = energy();
  double work = 0.0;
  double of_couples = 0.0;
  double volume = definition.packing.volume();
  Vector18 before = reply.response.components();
  for (int step = 0; step < 6; ++step) {
    request.state = reply.state;
    reply = cell->evaluate(request);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    const Vector18 mean = 0.5 * (before + reply.response.components());
    const double middle = volume * (1.0 + 0.5 * request.increment.displacement_gradient.trace());
    work += middle * mean.dot(strain);
    of_couples += middle * mean.tail<9>().dot(strain.tail<9>());
    volume *= (Eigen::Matrix3d::Identity() + request.increment.displacement_gradient).determinant();
    before = reply.response.components();
  }
  const double stored = energy() - start;
  std::printf(
      "[figure] spheres: work of the stresses over the energy that the contacts stored: %.4f, couple stresses' "
      "share %.3f\n",
      work / stored, of_couples / work);
  EXPECT_NEAR(work / stored, 1.0, 0.01);
  EXPECT_GT(of_couples / work, 0.05);
}

}  // namespace
}  // namespace polargrain::dem
