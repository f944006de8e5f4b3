// SPDX-License-Identifier: GPL-2.0-or-later
// Finite elements in space against exact fields: patch tests, bending, glide, torsion's zero modes, roll-up.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <random>

#include "common/elementary_functions.hpp"
#include "fem/element/dofs.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/material/polar_decomposition.hpp"
#include "fem/mesh/box.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

using Place = Eigen::Vector3d;
using NodeField = std::function<Cosserat<3>::NodeValues(const Place&)>;
constexpr std::array kDofs = node_dofs<3>();

ElasticParameters<3> parameters(double young, double poisson, double cosserat, double length) {
  ElasticParameters<3> made;
  made.young_modulus = young;
  made.poisson_ratio = poisson;
  made.cosserat_shear_modulus = cosserat;
  made.internal_length = length;
  return made;
}

std::shared_ptr<Material<3>> elastic(const ElasticParameters<3>& of) {
  return std::make_shared<LocalMaterial<ElasticLaw<3>>>(ElasticLaw<3>(of));
}

/// Puts the middle nodes of edges half way between their corners.
void straighten(Mesh<3>& mesh) {
  for (const Element<3>& element : mesh.elements) {
    const auto& reference = element.type->node_positions;
    for (int a = element.type->corners; a < element.type->nodes; ++a)
      for (int b = 0; b < element.type->corners; ++b)
        for (int c = b + 1; c < element.type->corners; ++c)
          if (2.0 * reference[a] == reference[b] + reference[c] &&
              (element.type->corners != 8 || (reference[b] - reference[c]).norm() == 2.0))
            mesh.nodes[element.nodes[a]] =
                0.5 * (mesh.nodes[element.nodes[b]] + mesh.nodes[element.nodes[c]]);
  }
}

/// The unit cube in 3 x 3 x 3 blocks whose inner corners are shaken.
Mesh<3> shaken_cube(const std::string& element) {
  Mesh<3> mesh = box({{1, 1, 1}, {3, 3, 3}}, element);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shake(-0.06, 0.06);
  for (Place& x : mesh.nodes)
    if (x.minCoeff() > 1e-9 && x.maxCoeff() < 1.0 - 1e-9)
      x += Place(shake(random), shake(random), shake(random));
  straighten(mesh);
  return mesh;
}

/// All unknowns given on a boundary by a field, reached at time 1.
void prescribe(Problem<3>& problem, const std::vector<std::string>& places, const NodeField& field) {
  for (const std::string& place : places)
    for (const Dof dof : kDofs)
      problem.prescribed.push_back({place, dof, TimeTable::ramp(1.0),
                                    [field, dof](const Place& x) { return field(x)(place_of<3>(dof)); }});
}

const std::vector<std::string> kFaces{"left", "right", "front", "back", "bottom", "top"};

SolverOptions exact() {
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-11;
  return options;
}

struct Patch {
  const char* name;
  Eigen::Vector3d turned;     ///< rotation beside that of the continuum
  Eigen::Matrix3d curvature;  ///< d w_j / d x_i
};

const Eigen::Matrix3d kGradient = (Eigen::Matrix3d() << 1, .5, -.3, 1, 1, .4, .2, -.6, .8).finished() * 1e-3;

/// G = 1000, nu = 1/4, Gc = 500, gamma = 40.
ElasticParameters<3> patch_material(double alpha, double beta) {
  ElasticParameters<3> made = parameters(2500.0, 0.25, 500.0, std::sqrt(0.02));
  made.couple_trace_ratio = alpha / 40.0;
  made.couple_transpose_ratio = beta / 40.0;
  return made;
}

/// Stress by the tensor formula, independent of the matrix of the law. @returns error relative to the largest stress
double patch_error(const std::string& element, bool shaken, const Patch& patch, double alpha, double beta) {
  constexpr double shear = 1000.0;
  constexpr double lambda = 1000.0;
  constexpr double cosserat = 500.0;
  constexpr double gamma = 40.0;
  const Eigen::Vector3d continuum = axial(kGradient);
  const auto rotation = [=](const Place& x) -> Eigen::Vector3d {
    return continuum + patch.turned + patch.curvature.transpose() * x;
  };
  const auto stress = [=](const Place& x) -> Eigen::Matrix3d {
    const Eigen::Matrix3d strain = kGradient.transpose() + cross_matrix(rotation(x));  // -e_ijk w_k
    return lambda * strain.trace() * Eigen::Matrix3d::Identity() + (shear + cosserat) * strain +
           (shear - cosserat) * strain.transpose();
  };
  const Eigen::Matrix3d couple = alpha * patch.curvature.trace() * Eigen::Matrix3d::Identity() +
                                 beta * patch.curvature.transpose() + gamma * patch.curvature;
  Problem<3> problem;
  problem.mesh = shaken ? shaken_cube(element) : box({{1, 1, 1}, {2, 2, 2}}, element);
  problem.materials["all"] = elastic(patch_material(alpha, beta));
  prescribe(problem, kFaces, [=](const Place& x) {
    Cosserat<3>::NodeValues values;
    values << kGradient * x, rotation(x);
    return values;
  });
  problem.body_loads.push_back({[=](const Place& x) {
                                  Cosserat<3>::NodeValues load = Cosserat<3>::NodeValues::Zero();
                                  for (int j = 0; j < 3; ++j) {
                                    const Place step = 0.5 * Place::Unit(j);
                                    load.head<3>() -=
                                        (stress(x + step) - stress(x - step)).row(j).transpose();
                                  }
                                  load.tail<3>() = -2.0 * axial(stress(x).transpose());  // -e_ijk s_jk
                                  return load;
                                },
                                TimeTable::ramp(1.0)});
  Solver<3> solver(std::move(problem), exact());
  EXPECT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_TRUE(report.converged) << report.message;
  double error = 0.0;
  double largest = 0.0;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const Eigen::Matrix3d expected = stress(solver.position_of_point(point));
    const Vector18& found = solver.state().responses[point].stress;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        error = std::max({error, std::abs(found(3 * i + j) - expected(i, j)),
                          std::abs(found(9 + 3 * i + j) - couple(i, j))});
        largest = std::max(largest, std::abs(expected(i, j)));
      }
  }
  return error / largest;
}

const Patch kClassical{"classical", Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
const Patch kTurned{"turned", 1e-3 * Eigen::Vector3d(.3, -.2, .5), Eigen::Matrix3d::Zero()};
const Patch kCurved{"curved", 1e-3 * Eigen::Vector3d(.3, -.2, .5),
                    1e-3 * (Eigen::Matrix3d() << 1, .5, -.4, .3, -.6, .2, -.7, .9, .4).finished()};

class SpacePatch : public ::testing::TestWithParam<std::string> {};

TEST_P(SpacePatch, ConstantStrainAndRotationOnAShakenMesh) {
  EXPECT_LT(patch_error(GetParam(), true, kClassical, 0.0, 0.0), 1e-11);
  EXPECT_LT(patch_error(GetParam(), true, kTurned, 0.0, 0.0), 1e-11);
}

// 2x2x2 points of H20R, one point, and those of wedges, do not integrate N s,j of a distorted element exactly; on parallelepipeds they do.
TEST_P(SpacePatch, ConstantCurvature) {
  const bool shaken = GetParam() != "H20R" && GetParam() != "W15" && GetParam() != "H8R";
  EXPECT_LT(patch_error(GetParam(), shaken, kCurved, 0.0, 0.0), 1e-11);
  EXPECT_LT(patch_error(GetParam(), shaken, kCurved, 12.0, 8.0), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Elements, SpacePatch, ::testing::ValuesIn(element_names<3>()));

/// Stiffness of a mesh with no supports. @returns its eigenvalues below 1e-9 of the largest
int zero_modes(const std::string& element, std::array<int, 3> elements, const ElasticParameters<3>& of) {
  const Mesh<3> mesh = box({{1.0 * elements[0], 1.0 * elements[1], 1.0 * elements[2]}, elements}, element);
  const Discretisation<3> discretisation(mesh, Continuum::cosserat);
  std::vector<Response<3>> answers(discretisation.points());
  for (Response<3>& answer : answers) answer.tangent = elastic_stiffness(of);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(discretisation.nodal_size(), discretisation.nodal_size());
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    const std::vector<int>& dofs = discretisation.element_dofs(e);
    stiffness(dofs, dofs) += discretisation.element_tangent(e, {answers});
  }
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues();
  return static_cast<int>((values.array() < 1e-9 * values(values.size() - 1)).count());
}

/// The table of zero-energy modes that an independent code gave: E = 2.5, nu = 0.25, Gc = 0.5, lc = 0.3 unless said.
TEST(SpaceElements, ZeroEnergyModesAreTheRigidMotionsAlone) {
  const ElasticParameters<3> generic = parameters(2.5, 0.25, 0.5, 0.3);
  const ElasticParameters<3> no_skew = parameters(2.5, 0.25, 0.0, 0.3);
  const ElasticParameters<3> no_length = parameters(2.5, 0.25, 0.5, 0.0);
  ElasticParameters<3> conformal = generic;
  conformal.couple_trace_ratio = -2.0 / 3.0;
  conformal.couple_transpose_ratio = 1.0;
  EXPECT_EQ(zero_modes("H20R", {1, 1, 1}, generic), 6);
  EXPECT_EQ(zero_modes("H20R", {1, 1, 2}, generic), 6);
  EXPECT_EQ(zero_modes("H20R", {1, 1, 1}, no_skew), 15);
  EXPECT_EQ(zero_modes("H20R", {1, 1, 2}, no_skew), 12);
  EXPECT_EQ(zero_modes("H20R", {1, 1, 1}, no_length), 48);
  EXPECT_EQ(zero_modes("H20R", {1, 1, 1}, conformal), 16);
  EXPECT_EQ(zero_modes("H20", {1, 1, 1}, generic), 6);
  EXPECT_EQ(zero_modes("H20", {1, 1, 1}, no_skew), 9);
  EXPECT_EQ(zero_modes("H8", {1, 1, 1}, generic), 6);
  EXPECT_EQ(zero_modes("H8", {2, 2, 2}, no_skew), 9);
  EXPECT_EQ(zero_modes("H8", {1, 1, 1}, no_length), 6);
  EXPECT_EQ(zero_modes("T10", {1, 1, 1}, generic), 6);
  EXPECT_EQ(zero_modes("T10", {1, 1, 1}, no_skew), 9);
  EXPECT_EQ(zero_modes("T10", {1, 1, 1}, no_length), 24);
  EXPECT_EQ(zero_modes("W15", {1, 1, 1}, generic), 6);
  EXPECT_EQ(zero_modes("W15", {1, 1, 1}, no_skew), 9);
}

/// Bending about x of a bar along z: exact for beta = -nu gamma, alpha any. M_x over that of the classical beam.
TEST(SpaceElements, BendingWithCoupleStressIsExact) {
  constexpr double side = 1.2;
  constexpr double length = 2.4;
  constexpr double poisson = 0.3;
  constexpr double internal = 0.35;
  constexpr double bend = 1e-3;
  ElasticParameters<3> of = parameters(2.6, poisson, 0.5, internal);
  of.couple_transpose_ratio = -poisson;
  Problem<3> problem;
  problem.mesh = box({{side, side, length}, {2, 2, 2}, Place(-0.5 * side, -0.5 * side, 0.0)});
  problem.materials["all"] = elastic(of);
  prescribe(problem, {"bottom", "top"}, [=](const Place& x) {
    Cosserat<3>::NodeValues v;
    v << poisson * x(0) * x(1), 0.5 * (x(2) * x(2) - poisson * (x(0) * x(0) - x(1) * x(1))), -x(1) * x(2),
        -x(2), 0.0, -poisson * x(0);
    return Cosserat<3>::NodeValues(bend * v);
  });
  const std::vector<Place> nodes = problem.mesh.nodes;
  const std::vector<int> end = problem.mesh.nodes_on("top");
  Solver<3> solver(std::move(problem), exact());
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const Eigen::VectorXd forces = solver.internal_forces();
  double moment = 0.0;
  for (const int node : end)
    moment += nodes[node](1) * forces(entry_of<3>(node, Dof::u3)) + forces(entry_of<3>(node, Dof::w1));
  const double classical = -bend * 2.6 * std::pow(side, 4) / 12.0;
  EXPECT_NEAR(moment / classical, 1.0 + 12.0 * (1.0 - poisson) * internal * internal / (side * side), 1e-10);
  EXPECT_NEAR(moment / classical, 1.71458333, 1e-8);
}

/// The layer of MOOSE's cosserat_glide (Forest): exact w3 = sinh 2y.
double glide_error(int elements, double beta) {
  ElasticParameters<3> of = parameters(2.0 * 2.0 * (1.0 + 1.0 / 6.0), 1.0 / 6.0, 3.0, std::sqrt(0.3));
  of.couple_transpose_ratio = beta;
  Problem<3> problem;
  const double width = 1.0 / elements;
  problem.mesh = box({{width, 1.0, width}, {1, elements, 1}});
  problem.materials["all"] = elastic(of);
  const auto given = [&](const std::string& on, Dof dof, double value) {
    problem.prescribed.push_back({on, dof, TimeTable::ramp(value), {}});
  };
  for (const Dof dof : kDofs) {
    given("front", dof, 0.0);
    given("back", dof, dof == Dof::w3 ? 3.626860408 : dof == Dof::u1 ? -1.657317415 : 0.0);
    if (dof != Dof::w3 && dof != Dof::u1) given("all", dof, 0.0);
  }
  problem.ties = {{"left", "right"}, {"bottom", "top"}};
  const std::vector<Place> nodes = problem.mesh.nodes;
  SolverOptions options = exact();
  options.largest_strain = 100.0;
  Solver<3> solver(std::move(problem), options);
  EXPECT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_TRUE(report.converged) << report.message;
  double error = 0.0;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    error = std::max(
        error, std::abs(solver.state().displacement(static_cast<Eigen::Index>(entry_of<3>(node, Dof::w3))) -
                        std::sinh(2.0 * nodes[node](1))));
  return error / 3.626860408;
}

// An independent code has 4.0e-4, 3.0e-5, 2.1e-6 of w (over the layer; here the nodes alone); beta does not matter.
TEST(SpaceElements, GlideLayerConvergesWithTheFourthOrder) {
  const double coarse = glide_error(4, 0.0);
  const double middle = glide_error(8, 0.0);
  const double fine = glide_error(16, 0.0);
  std::printf("glide: error of w3 %.2e %.2e %.2e with 4, 8, 16 elements\n", coarse, middle, fine);
  EXPECT_GT(coarse / middle, 12.0);
  EXPECT_GT(middle / fine, 12.0);
  EXPECT_LT(fine, 2.1e-6);
  EXPECT_NEAR(glide_error(8, 1.0), middle, 1e-9);
}

/// A bar of 1 x 1 x 6 rolled up by 1.5 rad and turned in space as a whole. @returns moment about the centre of the end
Eigen::Vector3d roll_up(int steps, const Eigen::Vector3d& turned) {
  constexpr double kLength = 6.0;
  const Eigen::Matrix3d whole = rotation_by(turned);
  Problem<3> problem;
  problem.deformation = Deformation::large;
  problem.mesh = box({{1, 1, kLength}, {1, 1, 6}, Place(-0.5, -0.5, 0.0)});
  for (Place& x : problem.mesh.nodes) x = whole * x;
  problem.materials["all"] = elastic(parameters(2.6, 0.3, 0.5, 0.3));
  const auto centre_at = [&](double t) -> Place {
    return whole * Place(0.0, t == 0.0 ? 0.0 : -kLength / t * (1.0 - std::cos(t)),
                         t == 0.0 ? kLength : kLength / t * std::sin(t));
  };
  const std::vector<Place> nodes = problem.mesh.nodes;
  const std::vector<int> end = problem.mesh.nodes_on("top");
  const Place axis = whole * Place::UnitX();
  for (const Dof dof : kDofs) problem.prescribed.push_back({"bottom", dof, TimeTable::constant(0.0), {}});
  for (const int node : end) {
    const std::string name = "end" + std::to_string(node);
    problem.mesh.node_sets[name] = {node};
    for (const Dof dof : kDofs) {
      std::vector<TimeTable::Point> points;
      for (int k = 0; k <= steps; ++k) {
        const double t = 1.5 * k / steps;
        const Place moved =
            centre_at(t) + rotation_by(t * axis) * (nodes[node] - centre_at(0.0)) - nodes[node];
        points.push_back({1.0 * k / steps, is_rotation(dof) ? t * axis(axis_of(dof)) : moved(axis_of(dof))});
      }
      problem.prescribed.push_back({name, dof, TimeTable(points), {}});
    }
  }
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-9;
  Solver<3> solver(std::move(problem), options);
  EXPECT_TRUE(solver.equilibrate().converged);
  for (int k = 1; k <= steps; ++k) {
    const StepReport report = solver.advance(1.0 * k / steps);
    EXPECT_TRUE(report.converged) << report.message;
    EXPECT_EQ(report.cuts, 0);
    EXPECT_LE(report.iterations, 7) << "step " << k;
  }
  const Eigen::VectorXd forces = solver.internal_forces();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const int node : end) {
    const Place arm =
        nodes[node] + solver.state().displacement.segment<3>(entry_of<3>(node)) - centre_at(1.5);
    moment += arm.cross(forces.segment<3>(entry_of<3>(node))) + forces.segment<3>(entry_of<3>(node, Dof::w1));
  }
  return whole.transpose() * moment;
}

// Limit of the independent code, which turns stresses half before and half after the law: 0.09573.
TEST(SpaceElements, RollUpIsOfSecondOrderAndTheSameInAnyFrame) {
  const double coarse = roll_up(4, Eigen::Vector3d::Zero())(0);
  const Eigen::Vector3d straight = roll_up(8, Eigen::Vector3d::Zero());
  const double fine = roll_up(16, Eigen::Vector3d::Zero())(0);
  std::printf("roll-up: moment %.7f %.7f %.7f with 4, 8, 16 steps\n", coarse, straight(0), fine);
  EXPECT_NEAR(fine, 0.09573, 1e-5);
  EXPECT_LT(std::abs(fine - straight(0)), 0.35 * std::abs(straight(0) - coarse));
  const Eigen::Vector3d elsewhere = roll_up(8, Eigen::Vector3d(.7, -.4, 1.1));
  EXPECT_LT((elsewhere - straight).norm(), 1e-8);
}

/// A body that turns as it is, first about one axis and then about others, to more than half a turn. @returns largest stress over E
double turned_as_it_is(bool gives_rotations, double& from_vector) {
  constexpr int kSteps = 24;
  const auto vector_at = [](double t) -> Place {
    const Place first(0.9, 0.0, 0.0), second(0.8, 0.7, 0.0), last(1.6, 2.0, 2.4);
    return t <= 1.0   ? Place(t * first)
           : t <= 2.0 ? first + (t - 1.0) * (second - first)
                      : second + (t - 2.0) * (last - second);
  };
  Problem<3> problem;
  problem.deformation = Deformation::large;
  problem.mesh = box({{1, 0.8, 2}, {1, 1, 1}}, "H8");
  problem.materials["all"] = elastic(parameters(1.0, 0.25, 0.5, 0.3));
  const std::vector<Place> nodes = problem.mesh.nodes;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const std::string name = "node" + std::to_string(node);
    problem.mesh.node_sets[name] = {static_cast<int>(node)};
    for (const Dof dof : kDofs) {
      if (is_rotation(dof) && !gives_rotations) continue;
      std::vector<TimeTable::Point> points;
      for (int k = 0; k <= kSteps; ++k) {
        const double t = 3.0 * k / kSteps;
        const Place moved = rotation_by(vector_at(t)) * nodes[node] - nodes[node];
        points.push_back({t, (is_rotation(dof) ? vector_at(t) : moved)(axis_of(dof))});
      }
      problem.prescribed.push_back({name, dof, TimeTable(points), {}});
    }
  }
  Solver<3> solver(std::move(problem), exact());
  EXPECT_TRUE(solver.equilibrate().converged);
  for (int k = 1; k <= kSteps; ++k) EXPECT_TRUE(solver.advance(3.0 * k / kSteps).converged);
  double stress = 0.0;
  for (const Response<3>& answer : solver.state().responses) stress = std::max(stress, answer.stress.norm());
  from_vector = 0.0;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const Place turned =
        solver.state().displacement.segment<3>(entry_of<3>(static_cast<Eigen::Index>(node)) + 3);
    from_vector = std::max(from_vector, (turned - vector_at(3.0)).norm());
  }
  return stress;
}

// Micro-rotations are vectors of rotations, as what is given for them is; sums of steps are not.
TEST(SpaceElements, RotationsAboutChangingAxesAreVectors) {
  for (const bool gives_rotations : {true, false}) {
    double from_vector = 0.0;
    EXPECT_LT(turned_as_it_is(gives_rotations, from_vector), 1e-12) << gives_rotations;
    EXPECT_LT(from_vector, 1e-11) << gives_rotations;
  }
}

}  // namespace
