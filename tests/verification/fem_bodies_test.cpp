// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies in space with size effect: torsion of round and square bars, a spherical cavity; a cylinder under a pressure that
// follows its side. References: closed form of Gauthier and Jahsman (1975); figures of an independent code.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <map>

#include "fem/element/dofs.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/block.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/cylinder.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

using PlaceOfBodies = Eigen::Vector3d;

/// G = 1.
struct Body {
  double cosserat = 0.5;  ///< Gc over G
  double length = 0.1;    ///< lc
  double alpha = 0.0;     ///< over gamma
  double beta = 0.0;      ///< over gamma
};
constexpr double kPoisson = 0.3;

ElasticParameters<3> parameters_of(const Body& body) {
  ElasticParameters<3> made;
  made.young_modulus = 2.0 * (1.0 + kPoisson);
  made.poisson_ratio = kPoisson;
  made.cosserat_shear_modulus = body.cosserat;
  made.internal_length = body.length;
  made.couple_trace_ratio = body.alpha;
  made.couple_transpose_ratio = body.beta;
  return made;
}

std::shared_ptr<Material<3>> elastic_of_bodies(const ElasticParameters<3>& of) {
  return std::make_shared<LocalMaterial<ElasticLaw<3>>>(ElasticLaw<3>(of));
}

SolverOptions exact_of_bodies() {
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-10;
  options.largest_strain = 10.0;
  return options;
}

/// Torque of a bar of height 1 about x3, twisted by 1 rad. By symmetry its ends turn as they are, u1 and u2 and w3 given; u3
/// (the warping), w1 and w2 are free there.
double torque(Mesh<3> mesh, const Body& body, const std::string& fixed_node) {
  Problem<3> problem;
  problem.mesh = std::move(mesh);
  problem.materials["all"] = elastic_of_bodies(parameters_of(body));
  for (const double end : {0.0, 1.0}) {
    const std::string on = end == 0.0 ? "bottom" : "top";
    problem.prescribed.push_back(
        {on, Dof::u1, TimeTable::ramp(1.0), [end](const PlaceOfBodies& x) { return -end * x(1); }});
    problem.prescribed.push_back(
        {on, Dof::u2, TimeTable::ramp(1.0), [end](const PlaceOfBodies& x) { return end * x(0); }});
    problem.prescribed.push_back({on, Dof::w3, TimeTable::ramp(end), {}});
  }
  problem.prescribed.push_back({fixed_node, Dof::u3, TimeTable::constant(0.0), {}});
  const std::vector<PlaceOfBodies> nodes = problem.mesh.nodes;
  const std::vector<int> top = problem.mesh.nodes_on("top");
  Solver<3> solver(std::move(problem), exact_of_bodies());
  EXPECT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_TRUE(report.converged) << report.message;
  const Eigen::VectorXd forces = solver.internal_forces();
  double sum = 0.0;
  for (const int node : top) {
    const PlaceOfBodies& x = nodes[static_cast<std::size_t>(node)];
    sum += x(0) * forces(entry_of<3>(node, Dof::u2)) - x(1) * forces(entry_of<3>(node, Dof::u1)) +
           forces(entry_of<3>(node, Dof::w3));
  }
  return sum;
}

/// Modified Bessel function of the first kind, by its series.
double bessel(int order, double x) {
  double term = 1.0;
  for (int k = 1; k <= order; ++k) term *= 0.5 * x / k;
  double sum = 0.0;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    sum += term;
    term *= 0.25 * x * x / (k * (k + order));
  }
  return sum;
}

/// Gauthier and Jahsman: torque over the classical one, R = 1.
double torsion_ratio(const Body& body) {
  const double gamma = 2.0 * body.length * body.length;
  const double alpha = body.alpha * gamma;
  const double beta = body.beta * gamma;
  const double sum = alpha + beta + gamma;
  const double decay = std::sqrt(4.0 * body.cosserat / sum);
  const double c =
      0.5 * (beta + gamma) / (sum * decay * bessel(0, decay) - (beta + gamma) * bessel(1, decay));
  const double classical = 0.5 * M_PI;
  return 1.0 +
         ((beta + gamma) * M_PI +
          2.0 * M_PI * c * (2.0 * body.cosserat * bessel(2, decay) / decay + alpha * bessel(1, decay))) /
             classical;
}

/// Error of the torque on an O-grid of 12 n^2 elements H20R.
double torsion_error(const Body& body, int n) {
  const double found = torque(cylinder({1.0, 1.0, 2 * n, n, 1}), body, "bottom_axis");
  return found / (0.5 * M_PI) / torsion_ratio(body) - 1.0;
}

TEST(RoundBar, ClosedFormAsPublished) {
  // lc over R, Gc over G, alpha, beta: to the eight digits of an independent derivation.
  const std::vector<std::pair<Body, double>> table{{{0.5, 0.1}, 1.05790397},
                                                   {{0.5, 0.3}, 1.48013751},
                                                   {{0.5, 1.0}, 5.38734872},
                                                   {{0.5, 0.1, 0.25, 0.5}, 1.08645801},
                                                   {{0.5, 1.0, 0.25, 0.5}, 7.99487794},
                                                   {{0.5, 0.3, 0.0, 1.0}, 1.91247739},
                                                   {{0.5, 1.0, -2.0 / 3.0, 1.0}, 4.20108446},
                                                   {{5.0, 0.3}, 1.52214354},
                                                   {{0.05, 1.0}, 5.04858340}};
  for (const auto& [body, expected] : table) EXPECT_NEAR(torsion_ratio(body) / expected, 1.0, 1e-8);
}

// An independent code has errors of 2e-3, 1e-4, 7e-6 with its O-grid of 12, 48 and 192 elements.
TEST(RoundBar, TorsionConvergesWithTheFourthOrder) {
  for (const Body& body : {Body{0.5, 0.3}, Body{0.5, 0.3, 0.25, 0.5}}) {
    const double coarse = std::abs(torsion_error(body, 1));
    const double middle = std::abs(torsion_error(body, 2));
    const double fine = std::abs(torsion_error(body, 4));
    std::cout << "[figure] round bar, lc/R 0.3, beta/gamma " << body.beta << ": error of the torque "
              << coarse << ", " << middle << ", " << fine << " with 12, 48, 192 elements\n";
    EXPECT_LT(coarse, 3e-3);
    EXPECT_LT(fine, 1.5e-5);
    EXPECT_GT(middle / fine, 10.0);
  }
}

/// Bodies of the table and between its rows and columns.
TEST(RoundBar, TorsionOfManyBodies) {
  double largest = 0.0;
  for (const Body& body : {Body{0.5, 0.1}, Body{0.5, 1.0}, Body{0.5, 0.1, 0.0, 1.0},
                           Body{0.5, 1.0, -2.0 / 3.0, 1.0}, Body{5.0, 0.1}, Body{5.0, 1.0}, Body{0.05, 0.3},
                           Body{0.2, 0.55, 0.1, 0.3}, Body{2.0, 0.2, -0.2, -0.1}})
    largest = std::max(largest, std::abs(torsion_error(body, 2)));
  std::cout << "[figure] round bars of 9 materials, 48 elements: largest error of the torque " << largest
            << '\n';
  EXPECT_LT(largest, 1e-3);
}

// Saint-Venant's constant of the square, and figures of an independent code with 12 x 12 elements.
TEST(SquareBar, TorsionAgreesWithAnIndependentCode) {
  constexpr double kClassical = 0.140577015;
  const std::vector<std::pair<Body, double>> table{{{0.5, 0.05}, 1.064282},
                                                   {{0.5, 0.1}, 1.235225},
                                                   {{0.5, 0.3}, 2.667615},
                                                   {{0.5, 1.0}, 15.91404},
                                                   {{0.5, 0.1, 0.0, 1.0}, 1.439745},
                                                   {{0.5, 1.0, 0.0, 1.0}, 30.16998},
                                                   {{0.5, 0.3, -2.0 / 3.0, 1.0}, 3.268470}};
  double largest = 0.0;
  for (const auto& [body, expected] : table) {
    Mesh<3> mesh = box({{1, 1, 1}, {8, 8, 1}, PlaceOfBodies(-0.5, -0.5, 0.0)});
    mesh.node_sets["middle"] = {};
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
      if (mesh.nodes[node].norm() < 1e-12) mesh.node_sets["middle"] = {static_cast<int>(node)};
    const double ratio = torque(std::move(mesh), body, "middle") / kClassical;
    largest = std::max(largest, std::abs(ratio / expected - 1.0));
  }
  std::cout << "[figure] square bars, lc/side 0.05 to 1, 8 x 8 elements: relative error of the torque "
            << largest << '\n';
  EXPECT_LT(largest, 1e-4);
}

/// An octant of a ball of radius 20 around a cavity of radius 1: three patches of n x n columns of elements, whose radii grow
/// in geometric steps.
Mesh<3> octant(int n, int steps) {
  const ElementType<3>& type = element_type<3>("H20R");
  const std::vector<GridPlace> places = elements_of_block(type).front();
  Mesh<3> mesh;
  std::map<std::array<long, 3>, int> numbers;
  const auto radius = [&](int half_step) {
    const auto at = [&](int step) { return std::pow(20.0, static_cast<double>(step) / steps); };
    return half_step % 2 == 0 ? at(half_step / 2) : 0.5 * (at(half_step / 2) + at(half_step / 2 + 1));
  };
  for (int patch = 0; patch < 3; ++patch)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < steps; ++k) {
          const int number = static_cast<int>(mesh.elements.size());
          Element<3>& added = mesh.elements.emplace_back(Element<3>{&type, {}});
          std::vector<GridPlace> at = places;
          for (std::size_t a = 0; a < at.size(); ++a) {
            // The patch nearest to an axis: the quadrilateral axis, edge middle, centre, edge middle of the octant's triangle.
            const double s = (at[a][0] + 2 * i) / (2.0 * n);
            const double t = (at[a][1] + 2 * j) / (2.0 * n);
            PlaceOfBodies direction = PlaceOfBodies::Zero();
            direction(patch) = 1.0;
            direction((patch + 1) % 3) = std::tan(0.25 * M_PI * s);
            direction((patch + 2) % 3) = std::tan(0.25 * M_PI * t);
            const PlaceOfBodies x = radius(at[a][2] + 2 * k) * direction.normalized();
            std::array<long, 3> key{};
            for (std::size_t d = 0; d < 3; ++d) key[d] = std::lround(1e9 * x(static_cast<Eigen::Index>(d)));
            const auto [found, is_new] = numbers.try_emplace(key, static_cast<int>(mesh.nodes.size()));
            if (is_new) mesh.nodes.push_back(x);
            added.nodes.push_back(found->second);
          }
          for (std::size_t side = 0; side < type.sides.size(); ++side) {
            const BoundarySide found{number, static_cast<int>(side)};
            if (std::ranges::all_of(mesh.side_nodes(found), [&](int node) {
                  return std::abs(mesh.nodes[static_cast<std::size_t>(node)].norm() - 20.0) < 1e-6;
                }))
              mesh.boundaries["outside"].push_back(found);
          }
        }
  const std::array<std::string, 3> planes{"x1", "x2", "x3"};
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
    for (int i = 0; i < 3; ++i)
      if (std::abs(mesh.nodes[static_cast<std::size_t>(node)](i)) < 1e-9)
        mesh.node_sets[planes[static_cast<std::size_t>(i)]].push_back(node);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) mesh.regions["all"].push_back(e);
  return mesh;
}

/// A load of each node: tension 1 along x3 far away, t = n3 e3.
void pull(Problem<3>& problem) {
  std::map<int, double> loads;
  const Mesh<3>& mesh = problem.mesh;
  for (const BoundarySide& side : mesh.boundaries.at("outside")) {
    const ElementType<2>& type = *mesh.side_of(side).type;
    const std::vector<int> nodes = mesh.side_nodes(side);
    for (const QuadraturePoint<2>& point : type.quadrature) {
      const ShapeFunctions<2> shape = type.shape_functions(point.position);
      Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
      for (std::size_t a = 0; a < nodes.size(); ++a)
        tangents += mesh.nodes[static_cast<std::size_t>(nodes[a])] *
                    shape.derivative.row(static_cast<Eigen::Index>(a));
      const double force = point.weight * tangents.col(0).cross(tangents.col(1))(2);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        loads[nodes[a]] += shape.value(static_cast<Eigen::Index>(a)) * force;
    }
  }
  for (const auto& [node, force] : loads) {
    const std::string name = "node" + std::to_string(node);
    problem.mesh.node_sets[name] = {node};
    problem.node_loads.push_back({name, Dof::u3, TimeTable::ramp(force)});
  }
}

struct Cavity {
  double equator;   ///< radial displacement
  double pole;      ///< radial displacement
  double rotation;  ///< largest component at 45 degrees
};

Cavity cavity(const Body& body, int n, int steps) {
  Problem<3> problem;
  problem.mesh = octant(n, steps);
  EXPECT_TRUE(distorted_elements(problem.mesh).empty());
  problem.materials["all"] = elastic_of_bodies(parameters_of(body));
  const std::array<Dof, 3> along{Dof::u1, Dof::u2, Dof::u3};
  const std::array<Dof, 3> about{Dof::w1, Dof::w2, Dof::w3};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string plane = "x" + std::to_string(i + 1);
    for (const Dof dof : {along[i], about[(i + 1) % 3], about[(i + 2) % 3]})
      problem.prescribed.push_back({plane, dof, TimeTable::constant(0.0), {}});
  }
  pull(problem);
  const std::vector<PlaceOfBodies> nodes = problem.mesh.nodes;
  const auto nearest = [&](const PlaceOfBodies& x) {
    const auto distance = [&x](const PlaceOfBodies& y) { return (x - y).norm(); };
    return static_cast<int>(std::ranges::min_element(nodes, {}, distance) - nodes.begin());
  };
  Solver<3> solver(std::move(problem), exact_of_bodies());
  EXPECT_TRUE(solver.equilibrate().converged);
  EXPECT_TRUE(solver.advance(1.0).converged);
  const Eigen::VectorXd& u = solver.state().displacement;
  const int slope = nearest(PlaceOfBodies(std::sqrt(0.5), 0.0, std::sqrt(0.5)));
  return {u(entry_of<3>(nearest(PlaceOfBodies::UnitX()), Dof::u1)),
          u(entry_of<3>(nearest(PlaceOfBodies::UnitZ()), Dof::u3)), std::abs(u(entry_of<3>(slope, Dof::w2)))};
}

// Two harmonics solved along the radius by an independent code. It has errors of 1.1, 0.33, 0.13 % (displacement) and 0.45,
// 0.21, 0.10 % (rotation) on its octants of 72, 216 and 480 elements.
TEST(SphericalCavity, DisplacementsAndRotationsOfTheWall) {
  const Body body{0.5, 0.3};
  std::vector<double> errors;
  for (const auto& [n, steps] : {std::pair(2, 6), std::pair(3, 8)}) {
    const Cavity found = cavity(body, n, steps);
    const double error =
        std::max(std::abs(found.equator / -0.1541222 - 1.0), std::abs(found.pole / 0.7121411 - 1.0));
    const double turned = std::abs(found.rotation / 0.1433698 - 1.0);
    std::cout << "[figure] spherical cavity, " << 3 * n * n * steps << " elements: relative error of u "
              << error << ", of w " << turned << '\n';
    errors.push_back(std::max(error, turned));
  }
  EXPECT_LT(errors[1], 5e-3);
  EXPECT_LT(errors[1], 0.5 * errors[0]);
}

/// A cylinder between smooth plates, pressed from its side to a plane strain of e in `steps` steps, the whole turned
/// meanwhile about its axis. @returns largest difference of a stress from that of the closed form, over the pressure
double pressed_cylinder(const std::string& element, CylinderSpecification of, double pressure, int steps) {
  Problem<3> problem;
  problem.mesh = cylinder(of, element);
  problem.deformation = Deformation::large;
  problem.materials["all"] = elastic_of_bodies(parameters_of({}));
  for (const char* plate : {"bottom", "top"})
    problem.prescribed.push_back({plate, Dof::u3, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"axis", Dof::u1, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"axis", Dof::u2, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"side_right", Dof::u2, TimeTable::constant(0.0), {}});
  problem.boundary_loads.push_back({.on = "side", .pressure = TimeTable::ramp(pressure)});
  const std::vector<PlaceOfBodies> nodes = problem.mesh.nodes;
  Solver<3> solver(std::move(problem), exact_of_bodies());
  EXPECT_TRUE(solver.equilibrate().converged);
  for (int k = 1; k <= steps; ++k) {
    const StepReport report = solver.advance(static_cast<double>(k) / steps);
    EXPECT_TRUE(report.converged) << report.message;
    EXPECT_LE(report.iterations, 6);
  }
  // Plane strain: s11 = s22 = -p, s33 = 2 nu s11; the law of a step takes the stretch s as 2 (s - 1)/(s + 1).
  double error = 0.0;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    Vector18 expected = Vector18::Zero();
    expected(0) = expected(4) = -pressure;
    expected(8) = -2.0 * kPoisson * pressure;
    error =
        std::max(error, (solver.state().responses[point].stress - expected).cwiseAbs().maxCoeff() / pressure);
  }
  const double young = 2.0 * (1.0 + kPoisson);
  const double strain = -pressure * (1.0 + kPoisson) * (1.0 - 2.0 * kPoisson) / young / steps;
  const double stretch = std::pow((2.0 + strain) / (2.0 - strain), steps);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const auto u = solver.state().displacement.segment<3>(entry_of<3>(static_cast<Eigen::Index>(node)));
    error = std::max(error, (u.head<2>() - (stretch - 1.0) * nodes[node].head<2>()).norm() / of.radius);
  }
  return error;
}

// A pressure on the area as it was would leave -p over the stretch, 20 % more.
TEST(PressedCylinder, APressureFollowsTheSide) {
  EXPECT_LT(pressed_cylinder("H20R", {2.0, 1.0, 2, 1, 1}, 0.9, 4), 1e-8);
  EXPECT_LT(pressed_cylinder("H20", {0.5, 3.0, 2, 2, 2}, 0.4, 1), 1e-8);
  EXPECT_LT(pressed_cylinder("H8", {1.0, 1.0, 4, 1, 1}, 0.6, 3), 1e-8);
}

}  // namespace
