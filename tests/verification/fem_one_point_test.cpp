// SPDX-License-Identifier: GPL-2.0-or-later
// Elements with one integration point and springs against their hourglass patterns: H8R and Q4R.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <iostream>

#include "common/memory_archive.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/solver.hpp"
#include "fem/solver/stabilisation.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

template <int dim>
ElasticParameters<dim> one_point_parameters(double young, double poisson, double cosserat, double length) {
  ElasticParameters<dim> made;
  made.young_modulus = young;
  made.poisson_ratio = poisson;
  made.cosserat_shear_modulus = cosserat;
  made.internal_length = length;
  return made;
}

template <int dim>
std::shared_ptr<Material<dim>> one_point_elastic(const ElasticParameters<dim>& of) {
  return std::make_shared<LocalMaterial<ElasticLaw<dim>>>(ElasticLaw<dim>(of));
}

/// A brick or rectangle of unit elements.
template <int dim>
Mesh<dim> unit_elements(int along, const std::string& element) {
  if constexpr (dim == 2)
    return rectangle({{1.0 * along, 1.0 * along}, {along, along}}, element);
  else
    return box({{1.0 * along, 1.0 * along, 1.0 * along}, {along, along, along}}, element);
}

/// Eigenvalues of the stiffness without supports, below 1e-9 of the largest.
template <int dim>
int zero_modes(int along, const ElasticParameters<dim>& of, bool with_springs) {
  const Mesh<dim> mesh = unit_elements<dim>(along, dim == 2 ? "Q4R" : "H8R");
  const Discretisation<dim> discretisation(mesh, Continuum::cosserat);
  std::vector<Response<dim>> answers(discretisation.points());
  for (Response<dim>& answer : answers) answer.tangent = elastic_stiffness(of);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(discretisation.nodal_size(), discretisation.nodal_size());
  const auto springs = Stabilisation<dim>::of(mesh, Continuum::cosserat, Deformation::large);
  springs->learn(discretisation, answers);
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    const std::vector<int>& dofs = discretisation.element_dofs(e);
    stiffness(dofs, dofs) += discretisation.element_tangent(e, {answers});
    if (with_springs) stiffness(dofs, dofs) += springs->tangent(e);
  }
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues();
  return static_cast<int>((values.array() < 1e-9 * values(values.size() - 1)).count());
}

// One point has 18 strains (7 with s_33 in the plane, of which 6 are free): the rest of 48 (12) unknowns is unresisted without springs.
TEST(OnePoint, LeavesTheRigidMotionsAlone) {
  const auto space = one_point_parameters<3>(2.5, 0.25, 0.5, 0.3);
  const auto plane = one_point_parameters<2>(2.5, 0.25, 0.5, 0.3);
  EXPECT_EQ(zero_modes<3>(1, space, false), 48 - 18);
  EXPECT_EQ(zero_modes<2>(1, plane, false), 12 - 6);
  for (const int along : {1, 2, 3}) {
    EXPECT_EQ(zero_modes<3>(along, space, true), 6) << along;
    EXPECT_EQ(zero_modes<2>(along, plane, true), 3) << along;
  }
  // Without skew stiffness, uniform micro-rotations are free, as with every element.
  EXPECT_EQ(zero_modes<3>(2, one_point_parameters<3>(2.5, 0.25, 0.0, 0.3), true), 9);
  EXPECT_EQ(zero_modes<2>(2, one_point_parameters<2>(2.5, 0.25, 0.0, 0.3), true), 4);
}

/// A classical cantilever of length 4 and height 1 under a shear traction at its end: deflection of the end's middle.
double deflection(const std::string& element, int high, std::string* doubt = nullptr) {
  Problem<3> problem;
  problem.mesh = box({{4.0, 1.0, 1.0}, {4 * high, high, high}}, element);
  problem.continuum = Continuum::cauchy;
  problem.materials["all"] = one_point_elastic(one_point_parameters<3>(1000.0, 0.3, 0.0, 0.0));
  const TimeTable zero = TimeTable::constant(0.0);
  for (const Dof dof : {Dof::u1, Dof::u2, Dof::u3}) problem.prescribed.push_back({"left", dof, zero, {}});
  BoundaryLoad<3> load;
  load.on = "right";
  load.traction[2] = TimeTable::ramp(-1.0);
  problem.boundary_loads.push_back(load);
  const std::vector<int> end = problem.mesh.nodes_on("right");
  Solver<3> solver(std::move(problem), {});
  EXPECT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_TRUE(report.converged) << report.message;
  if (doubt != nullptr) *doubt = doubt_of_one_point_elements(solver);
  double sum = 0.0;
  for (const int node : end) sum += solver.state().displacement(entry_of<3>(node, Dof::u3));
  return sum / static_cast<double>(end.size());
}

constexpr double kShortening = 0.0012;  // m, of a specimen of 80 mm

/// An elastoplastic specimen between rough plates, in the plane or in space: the force of the upper plate at the end.
template <int dim>
double squeezed(const std::string& element, int along, int explicit_steps, double shortening = kShortening) {
  constexpr double pressure = 100e3;
  Problem<dim> problem;
  if constexpr (dim == 2)
    problem.mesh = rectangle({{0.04, 0.08}, {along, 2 * along}}, element);
  else
    problem.mesh = box({{0.04, 0.04, 0.08}, {along, along, 2 * along}}, element);
  ElastoplasticParameters<dim> sand;
  sand.elastic = one_point_parameters<dim>(40e6, 0.3, 10e6, 3e-3);
  for (int i = 0; i < dim; ++i) sand.elastic.initial_stress(Cosserat<dim>::stress_place(i, i)) = -pressure;
  if constexpr (dim == 2) sand.elastic.initial_stress(k33) = -pressure;
  sand.cone = hardening_cone({PiecewiseLinear(35.0), PiecewiseLinear(5.0), PiecewiseLinear(1e3)},
                             dim == 2 ? ConeMatch::plane_strain : ConeMatch::triaxial_compression);
  problem.materials["all"] =
      std::make_shared<LocalMaterial<ElastoplasticLaw<dim>>>(ElastoplasticLaw<dim>(sand));
  const Dof vertical = dim == 2 ? Dof::u2 : Dof::u3;
  for (const char* const plate : {"bottom", "top"})
    for (int i = 0; i < dim; ++i) {
      const Dof dof = node_dofs<dim>()[static_cast<std::size_t>(i)];
      const bool moves = plate[0] == 't' && dof == vertical;
      problem.prescribed.push_back(
          {plate, dof, moves ? TimeTable::ramp(-shortening) : TimeTable::constant(0.0), {}});
    }
  for (const char* const side : {"left", "right", "front", "back"}) {
    if (dim == 2 && (side[0] == 'f' || side[0] == 'b')) continue;
    BoundaryLoad<dim> load;
    load.on = side;
    load.pressure = TimeTable::constant(pressure);
    problem.boundary_loads.push_back(load);
  }
  Solver<dim> solver(std::move(problem), {});
  if (explicit_steps > 0) {
    EXPECT_TRUE(solver.begin_explicit().converged);
    EXPECT_TRUE(solver.advance_explicit(1.0, explicit_steps).converged);
  } else {
    EXPECT_TRUE(solver.equilibrate().converged);
    for (int step = 1; step <= 5; ++step) {
      const StepReport report = solver.advance(step / 5.0);
      EXPECT_TRUE(report.converged) << report.message;
    }
  }
  return solver.reaction("top")(dim - 1);
}

/// Nodal values of a body whose nodes go from x to moved(x); micro-rotations are those of the turn.
template <class Moved>
Eigen::VectorXd displaced(const Mesh<3>& mesh, const Moved& moved, const Eigen::Vector3d& turn) {
  Eigen::VectorXd values(entry_of<3>(static_cast<Eigen::Index>(mesh.nodes.size())));
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const auto entry = entry_of<3>(static_cast<Eigen::Index>(node));
    values.segment<3>(entry) = moved(mesh.nodes[node]) - mesh.nodes[node];
    values.segment<3>(entry + 3) = turn;
  }
  return values;
}

/// One element in space that has turned already, turned on and strained unevenly in a step of large deformation.
class SpaceStepOf {
 public:
  explicit SpaceStepOf(const std::string& element)
      : mesh_(box({{0.1, 0.08, 0.09}, {1, 1, 1}}, element)),
        start_(mesh_, Continuum::cosserat),
        end_(mesh_, Continuum::cosserat) {
    ElasticParameters<3> of = one_point_parameters<3>(50e6, 0.25, 20e6, 0.02);
    // As large as the moduli, so that every turn of it shows.
    of.initial_stress << -3e7, 4e6, 2e6, 6e6, -1e7, 3e6, 1e6, -2e6, -2e7, 2e5, -1e5, 1e5, 3e5, 1e5, -2e5, 1e5,
        2e5, 1e5;
    law_ = one_point_elastic(of);
    law_->allocate(start_.points());
    before_ = nodal(0.3, 0.02);
    increment = nodal(0.7, 0.2) - before_;
    EXPECT_EQ(start_.move_to(before_), "");
  }

  Eigen::VectorXd forces() {
    EXPECT_EQ(end_.move_to(before_ + increment), "");
    increments_ = start_.increments_to(end_, increment);
    answers_.resize(increments_.size());
    law_->evaluate(increments_, answers_);
    return end_.internal_forces(answers_);
  }
  [[nodiscard]] Eigen::MatrixXd tangent() const {
    return end_.element_tangent(0, {answers_, Linearisation<3>::Moving{start_, increments_}});
  }
  [[nodiscard]] const std::vector<int>& entries() const { return start_.element_dofs(0); }

  Eigen::VectorXd increment;

 private:
  [[nodiscard]] Eigen::VectorXd nodal(double angle, double strain) const {
    const Eigen::Vector3d about = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, about).toRotationMatrix();
    Eigen::VectorXd values(start_.nodal_size());
    for (std::size_t node = 0; node < mesh_.nodes.size(); ++node) {
      const double k = static_cast<double>(node);
      const Eigen::Vector3d& x = mesh_.nodes[node];
      const Eigen::Vector3d uneven(0.01 * std::sin(2.1 * k), 0.01 * std::cos(1.3 * k),
                                   0.01 * std::sin(0.7 * k));
      const Eigen::Vector3d strained =
          x + strain * (Eigen::Vector3d(0.8 * x(0) + 0.6 * x(1), 0.3 * x(2) - x(1), x(0)) + uneven);
      const auto entry = entry_of<3>(static_cast<Eigen::Index>(node));
      values.segment<3>(entry) = turn * strained - x;
      values.segment<3>(entry + 3) = (angle + 0.3 * strain * std::sin(0.7 * k)) * about;
    }
    return values;
  }

  Mesh<3> mesh_;
  Discretisation<3> start_, end_;
  std::shared_ptr<Material<3>> law_;
  Eigen::VectorXd before_;
  std::vector<Increment<3>> increments_;
  std::vector<Response<3>> answers_;
};

/// Of an elastic body without strain.
std::vector<Response<3>> elastic_answers(const Discretisation<3>& discretisation) {
  Response<3> answer;
  answer.tangent = elastic_stiffness(one_point_parameters<3>(2.5, 0.25, 0.5, 0.3));
  return std::vector<Response<3>>(discretisation.points(), answer);
}

}  // namespace

// Energy of squares of nodal places: a turn by any angle adds none, and turns the forces.
TEST(OnePoint, SpringsTurnWithTheBody) {
  Mesh<3> mesh = box({{1, 1, 2}, {2, 2, 3}}, "H8R");
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const double k = static_cast<double>(node);
    mesh.nodes[node] += 0.05 * Eigen::Vector3d(std::sin(2.1 * k), std::cos(1.3 * k), std::sin(0.7 * k));
  }
  const Discretisation<3> discretisation(mesh, Continuum::cosserat);
  const auto springs = Stabilisation<3>::of(mesh, Continuum::cosserat, Deformation::large);
  springs->learn(discretisation, elastic_answers(discretisation));
  const auto forces_of = [&](const Eigen::VectorXd& values) {
    NodalForces forces;
    const Eigen::VectorXd start = Eigen::VectorXd::Zero(values.size());
    forces.internal = forces.parts = start;
    EXPECT_EQ(springs->evaluate({0.0, 1.0, start, values}, forces), "");
    return forces.internal;
  };
  const Eigen::Vector3d about = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0, about).toRotationMatrix();
  const auto bent = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return x + 0.1 * Eigen::Vector3d(x(1) * x(2), x(0) * x(2), x(0) * x(1) * x(2));
  };
  const Eigen::VectorXd straight = forces_of(displaced(mesh, bent, Eigen::Vector3d::Zero()));
  EXPECT_GT(straight.norm(), 1e-3);
  const auto rigid = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return turn * x; };
  EXPECT_LT(forces_of(displaced(mesh, rigid, 2.0 * about)).norm(), 1e-12 * straight.norm());
  const auto both = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return turn * bent(x); };
  const Eigen::VectorXd turned = forces_of(displaced(mesh, both, 2.0 * about));
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const auto entry = entry_of<3>(static_cast<Eigen::Index>(node));
    EXPECT_LT((turned.segment<3>(entry) - turn * straight.segment<3>(entry)).norm(), 1e-13);
  }
}

// Micro-rotations of both signs, and then the body turns by 2 rad in steps: moments turn with it, whatever the step.
TEST(OnePoint, SpringsOfMicroRotationsTurnWithTheBody) {
  const Mesh<3> mesh = box({{0.7, 0.9, 1.1}, {2, 2, 2}}, "H8R");
  const Discretisation<3> discretisation(mesh, Continuum::cosserat);
  const auto springs = Stabilisation<3>::of(mesh, Continuum::cosserat, Deformation::large);
  springs->learn(discretisation, elastic_answers(discretisation));
  Eigen::VectorXd values = Eigen::VectorXd::Zero(discretisation.nodal_size());
  const auto forces_at = [&](const Eigen::VectorXd& end) {
    NodalForces forces;
    forces.internal = forces.parts = Eigen::VectorXd::Zero(values.size());
    const Eigen::VectorXd increment = end - values;
    EXPECT_EQ(springs->evaluate({0.0, 1.0, values, increment}, forces), "");
    springs->commit();
    values = end;
    return forces.internal;
  };
  const auto entry = [](std::size_t node) { return entry_of<3>(static_cast<Eigen::Index>(node)); };
  Eigen::VectorXd twisted = values;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    twisted.segment<3>(entry(node) + 3) =
        1e-3 * Eigen::Vector3d(node % 2 == 0 ? 1 : -1, node % 3, node % 5 == 1);
  const Eigen::VectorXd straight = forces_at(twisted);
  EXPECT_GT(straight.norm(), 1e-5);
  const Eigen::Vector3d about = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  constexpr int kSteps = 5;
  Eigen::VectorXd turned;
  Eigen::Matrix3d turn;
  for (int step = 1; step <= kSteps; ++step) {
    const double angle = 2.0 * step / kSteps;
    turn = Eigen::AngleAxisd(angle, about).toRotationMatrix();
    Eigen::VectorXd end = twisted;
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      end.segment<3>(entry(node)) = turn * mesh.nodes[node] - mesh.nodes[node];
      end.segment<3>(entry(node) + 3) += angle * about;
    }
    turned = forces_at(end);
  }
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    EXPECT_LT((turned.segment<3>(entry(node) + 3) - turn * straight.segment<3>(entry(node) + 3)).norm(),
              1e-13 * straight.norm())
        << node;
  MemoryArchive kept;
  springs->save(kept);
  springs->allocate();
  springs->restore(kept);
  EXPECT_EQ(forces_at(values), turned);
}

// Micro-rotations alike in all nodes: what rounding leaves of their curvature softens no spring of an elastic body.
TEST(OnePoint, RoundingSoftensNoSprings) {
  const Mesh<3> mesh = box({{0.7, 0.9, 1.1}, {2, 2, 2}}, "H8R");
  const Discretisation<3> discretisation(mesh, Continuum::cosserat);
  const std::vector<Response<3>> answers = elastic_answers(discretisation);
  const auto springs = Stabilisation<3>::of(mesh, Continuum::cosserat, Deformation::small);
  springs->learn(discretisation, answers);
  const auto forces_of = [&](double alike) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(discretisation.nodal_size());
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      const auto entry = entry_of<3>(static_cast<Eigen::Index>(node));
      const Eigen::Vector3d& x = mesh.nodes[node];
      const long place = std::lround(x(0) / 0.35) + std::lround(x(1) / 0.45) + std::lround(x(2) / 0.55);
      values.segment<3>(entry + 3).setConstant(alike + (place % 2 == 0 ? 1e-3 : -1e-3));
    }
    NodalForces forces;
    const Eigen::VectorXd start = Eigen::VectorXd::Zero(values.size());
    forces.internal = forces.parts = start;
    EXPECT_EQ(springs->evaluate({0.0, 1.0, start, values}, forces), "");
    springs->commit();
    springs->learn(discretisation, answers);
    return forces.internal;
  };
  const Eigen::VectorXd first = forces_of(0.0);
  EXPECT_GT(first.norm(), 1e-6);
  for (const double alike : {0.1 / 3.0, 0.7, 1.1, 2.3, 0.4})
    EXPECT_LT((forces_of(alike) - first).norm(), 1e-11 * first.norm()) << alike;
}

// Rough plates and plastic flow: the springs carry a share that falls with the mesh. Beside them, elements with more points.
TEST(OnePoint, CarriesAPlasticSpecimen) {
  const double fine = squeezed<3>("H20R", 4, 0);
  for (const char* const element : {"H8R", "H8", "H20R"})
    std::cout << "[figure] force of " << element
              << " on 2 x 2 x 4 over that of H20R on 4 x 4 x 8: " << squeezed<3>(element, 2, 0) / fine
              << '\n';
  EXPECT_NEAR(squeezed<3>("H8R", 2, 0) / fine, 1.0, 0.08);
  EXPECT_NEAR(squeezed<2>("Q4R", 4, 0) / squeezed<2>("Q8R", 8, 0), 1.0, 0.05);
}

// At four times the strain as at first. Springs that stay elastic carry more and more.
TEST(OnePoint, SpringsYieldWithTheirPoint) {
  const double far = 4.0 * kShortening;
  const double space = squeezed<3>("H8R", 2, 0, far) / squeezed<3>("H20R", 4, 0, far);
  const double plane = squeezed<2>("Q4R", 4, 0, far) / squeezed<2>("Q8R", 8, 0, far);
  std::cout << "[figure] force at 6 % of strain over that of a fine mesh of H20R, Q8R: H8R " << space
            << ", Q4R " << plane << '\n';
  EXPECT_NEAR(space, 1.0, 0.08);
  EXPECT_NEAR(plane, 1.0, 0.05);
}

/// A beam of 2 x 0.2 x 0.4 m whose right support settles before its load comes, both in small deformation: sag of its top at the end.
double sag_after_settlement(double settlement) {
  Problem<3> problem;
  problem.mesh = box({{2.0, 0.2, 0.4}, {20, 1, 8}}, "H8R");
  problem.continuum = Continuum::cauchy;
  problem.materials["all"] = one_point_elastic(one_point_parameters<3>(30e9, 0.2, 0.0, 0.0));
  const TimeTable zero = TimeTable::constant(0.0);
  for (const Dof dof : {Dof::u1, Dof::u2, Dof::u3})
    problem.prescribed.push_back({"bottom_left", dof, zero, {}});
  problem.prescribed.push_back({"bottom_right", Dof::u2, zero, {}});
  problem.prescribed.push_back({"bottom_right", Dof::u3, TimeTable({{0.0, 0.0}, {1.0, -settlement}}), {}});
  BoundaryLoad<3> load;
  load.on = "top";
  load.pressure = TimeTable({{0.0, 0.0}, {1.0, 0.0}, {2.0, 100e3}});
  problem.boundary_loads.push_back(load);
  Solver<3> solver(std::move(problem), {});
  EXPECT_TRUE(solver.equilibrate().converged);
  Eigen::VectorXd settled;
  for (const double time : {0.5, 1.0, 1.25, 1.5, 2.0}) {
    EXPECT_TRUE(solver.advance(time).converged);
    if (time == 1.0) settled = solver.state().displacement;
  }
  double sum = 0.0;
  const std::vector<int> top = solver.problem().mesh.nodes_on("top");
  for (const int node : top)
    sum += solver.state().displacement(entry_of<3>(node, Dof::u3)) - settled(entry_of<3>(node, Dof::u3));
  return sum / static_cast<double>(top.size());
}

// Small deformation knows no turn: neither does the secant.
TEST(OnePoint, ATurnLeavesTheSpringsOfAnElasticBeam) {
  const double sag = sag_after_settlement(0.0);
  EXPECT_LT(sag, -1e-5);
  EXPECT_NEAR(sag_after_settlement(0.06) / sag, 1.0, 1e-6);
}

// Three moduli against curvature: twisted and bent elements stay elastic.
TEST(OnePoint, CoupleModuliOfSpaceAreElastic) {
  Problem<3> problem;
  problem.mesh = unit_elements<3>(3, "H8R");
  ElasticParameters<3> of = one_point_parameters<3>(10e6, 0.3, 4e6, 1.5);
  of.couple_trace_ratio = 5.0;
  of.couple_transpose_ratio = 0.5;
  problem.materials["all"] = one_point_elastic(of);
  for (const Dof dof : node_dofs<3>())
    problem.prescribed.push_back({"bottom", dof, TimeTable::constant(0.0), {}});
  for (const Dof dof : {Dof::w1, Dof::w2})
    problem.prescribed.push_back({"top_front_left", dof, TimeTable::ramp(0.01), {}});
  Solver<3> solver(std::move(problem), {});
  EXPECT_TRUE(solver.equilibrate().converged);
  EXPECT_TRUE(solver.advance(0.25).converged);
  const auto quarter = solver.reaction("top_front_left");
  for (const double time : {0.5, 0.75, 1.0}) EXPECT_TRUE(solver.advance(time).converged);
  const auto whole = solver.reaction("top_front_left");
  EXPECT_LT((whole - 4.0 * quarter).norm(), 1e-6 * whole.norm());
}

// As fast as Newton's steps allow; the difference is that of explicit steps with every element (explicit_bodies_test).
TEST(OnePoint, ExplicitStepsAgreeWithNewton) {
  EXPECT_NEAR(squeezed<2>("Q4R", 2, 2000) / squeezed<2>("Q4R", 2, 0), 1.0, 0.02);
  EXPECT_NEAR(squeezed<3>("H8R", 2, 2000) / squeezed<3>("H8R", 2, 0), 1.0, 0.02);
}

// Deflections over Timoshenko's, P L^3 / (3 E I) + P L / (k G A) with k = 5/6, by an independent code. The clamped end is held sideways
// too: fine meshes come to 0.983.
TEST(OnePoint, BendsACantilever) {
  const double timoshenko = -(64.0 / 3.0 / (1000.0 / 12.0) + 4.0 / (5.0 / 6.0 * 1000.0 / 2.6));
  EXPECT_NEAR(deflection("H20R", 2) / timoshenko, 0.983, 0.01);
  EXPECT_NEAR(deflection("H8", 2) / timoshenko, 0.9585, 1e-4);
  EXPECT_NEAR(deflection("H8R", 2) / timoshenko, 1.2434, 1e-4);
  EXPECT_NEAR(deflection("H8R", 4) / timoshenko, 1.0364, 1e-4);
}

// Of the energy of bending, N elements over the height leave 1 / N^2 to the springs: all of it, a quarter, a sixteenth.
TEST(OnePoint, DoubtsABentPlateOfFewElements) {
  std::string doubt;
  deflection("H8R", 1, &doubt);
  EXPECT_EQ(doubt.substr(0, 6), "100 % ") << doubt;
  deflection("H8R", 2, &doubt);
  EXPECT_EQ(doubt.substr(0, 5), "25 % ") << doubt;
  deflection("H8R", 4, &doubt);
  EXPECT_EQ(doubt, "");
  deflection("H20R", 1, &doubt);
  EXPECT_EQ(doubt, "");
}

// Means of gradients change otherwise than gradients do.
TEST(OnePoint, TheTangentOfLargeDeformationIsTheDerivative) {
  for (const char* const element : {"H8R", "H8", "H20R"}) {
    SpaceStepOf step(element);
    (void)step.forces();
    const Eigen::MatrixXd tangent = step.tangent();
    double error = 0.0;
    for (std::size_t column = 0; column < step.entries().size(); ++column) {
      const int j = step.entries()[column];
      const double size = column % 6 < 3 ? 1e-6 : 1e-5;
      const double kept = step.increment(j);
      step.increment(j) = kept + size;
      const Eigen::VectorXd plus = step.forces();
      step.increment(j) = kept - size;
      const Eigen::VectorXd difference = (plus - step.forces()) / (2.0 * size);
      step.increment(j) = kept;
      const Eigen::VectorXd expected = difference(step.entries());
      error = std::max(error,
                       (expected - tangent.col(static_cast<Eigen::Index>(column))).norm() / expected.norm());
    }
    std::cout << "[figure] tangent of " << element << " against central differences: " << error << '\n';
    EXPECT_LT(error, 2e-7) << element;  // as in the plane (fem_large_tangent_test)
  }
}
