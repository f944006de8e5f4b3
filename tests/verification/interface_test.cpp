// SPDX-License-Identifier: GPL-2.0-or-later
// Interfaces in a body: against closed forms, and figures of an independent code where the mesh has a share in them.
#include "fem/interface/interface.hpp"

#include "tests/support/structures.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kDegreeOfInterface = 3.14159265358979323846 / 180.0;

InterfaceParameters rough(double normal_stiffness, double shear_stiffness, double friction) {
  return {.normal_stiffness = normal_stiffness,
          .shear_stiffness = shear_stiffness,
          .tan_friction = std::tan(friction * kDegreeOfInterface)};
}

/// Supports that hold a body in space or the plane and no more: three corners of a side that carry no reaction.
template <int dim>
void expect_converged(Solver<dim>& solver, double time) {
  const StepReport report = solver.advance(time);
  ASSERT_TRUE(report.converged) << report.message;
}

class InPlane : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, InPlane, ::testing::ValuesIn(element_names<2>()));

// Uniform stress with 30 kPa of shear and 100 kPa of pressure on the joint, on a distorted mesh.
TEST_P(InPlane, a_uniform_stress_passes_the_joint) {
  Problem<2> problem;
  problem.mesh = rectangle({{3.0, 2.0}, {3, 4}}, GetParam());
  distort<2>(problem.mesh, [](const Eigen::Vector2d& x) {
    const bool inner = x(0) > 0.0 && x(0) < 3.0 && x(1) > 0.0 && x(1) < 2.0;
    return Eigen::Vector2d(inner ? 0.15 * std::sin(5 * x(0)) : 0.0,
                           inner && x(1) != 1.0 ? 0.08 * std::cos(3 * x(0) + x(1)) : 0.0);
  });
  name_nodes(problem.mesh, "joint", [](const auto& x) { return x(1) == 1.0; });
  problem.materials["all"] = elastic_ground<2>(20e6);
  const auto interface = add_interface<2>(problem, "joint", glue(3e8, 1e8));
  problem.prescribed = {{"bottom_left", Dof::u1, kZero, {}},
                        {"bottom_left", Dof::u2, kZero, {}},
                        {"bottom_right", Dof::u2, kZero, {}}};
  const auto load = [&](const std::string& on, double t1, double t2) {
    BoundaryLoad<2> item{.on = on};
    item.traction = {TimeTable::constant(t1), TimeTable::constant(t2)};
    problem.boundary_loads.push_back(item);
  };
  load("top", 30e3, -100e3);
  load("bottom", -30e3, 100e3);
  load("right", 0.0, 30e3);
  load("left", 0.0, -30e3);
  Solver<2> solver(std::move(problem), {.force_tolerance = 1e-11, .moment_tolerance = 1e-11});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (const InterfacePointResult<2>& point : interface->results()) {
    // The normal points up or down, as the first side has it; both components turn with it.
    EXPECT_NEAR(point.traction(1), -100e3, 1e-12 * 100e3) << point.geometry.place.transpose();
    EXPECT_NEAR(std::abs(point.traction(0)), 30e3, 1e-12 * 100e3);
    EXPECT_NEAR(point.jump(1), -100e3 / 3e8, 1e-12 * 100e3 / 3e8);
  }
}

// A block on an incline: T/N is tan(alpha) while it sticks, tan(30 deg) where a soft spring alone keeps it from sliding away.
TEST_P(InPlane, a_block_on_an_incline_sticks_and_slides) {
  for (const double slope : {10.0, 25.0, 29.9, 30.1, 35.0, 50.0}) {
    Problem<2> problem;
    problem.mesh = rectangle({{1.0, 0.5}, {4, 2}}, GetParam());
    problem.materials["all"] = elastic_ground<2>(100e6);
    const auto body = add_body<2>(problem, "bottom", rough(1e9, 1e9, 30.0));
    problem.prescribed.push_back({"body", Dof::u1, kZero, {}});
    problem.prescribed.push_back({"body", Dof::u2, kZero, {}});
    const double angle = slope * kDegreeOfInterface;
    problem.body_loads = {{[=](const Eigen::Vector2d&) {
      return Eigen::Vector3d(20e3 * std::sin(angle), -20e3 * std::cos(angle), 0.0);
    }}};
    const bool slides = slope > 30.0;
    std::shared_ptr<Anchor<2>> spring;
    if (slides) {
      // Along the base and through its level, so that N stays where the base can carry it.
      spring = std::make_shared<Anchor<2>>(
          problem.mesh,
          AnchorSettings<2>{"spring", problem.mesh.nodes_on("bottom_left").front(), {}, {-1.0, 0.0}, 1e4});
      problem.contributions.push_back(spring);
    }
    Solver<2> solver(std::move(problem), {.force_tolerance = 1e-11, .moment_tolerance = 1e-10});
    const StepReport report = solver.equilibrate();
    ASSERT_TRUE(report.converged) << slope << report.message;
    const Eigen::Vector2d force = body.interface->force();
    const double weight = 20e3 * 0.5;
    EXPECT_NEAR(-force(1), weight * std::cos(angle), 1e-10 * weight);
    EXPECT_NEAR(std::abs(force(0) / force(1)), std::tan((slides ? 30.0 : slope) * kDegreeOfInterface), 1e-9)
        << slope;
    if (slides) {
      EXPECT_NEAR(spring->force(),
                  weight * (std::sin(angle) - std::cos(angle) * std::tan(30.0 * kDegreeOfInterface)),
                  1e-9 * weight);
    }
  }
}

// The law's shear test through a body: the block moves without strain, so its reaction is the shear stress of the base.
TEST_P(InPlane, the_shear_test_of_goodman) {
  InterfaceParameters joint = rough(1e8, 4e7, 30.0);
  joint.tan_dilation = std::tan(10.0 * kDegreeOfInterface);
  joint.cohesion = 5e3;
  Problem<2> problem;
  problem.mesh = rectangle({{1.0, 0.1}, {4, 1}}, GetParam());
  problem.materials["all"] = elastic_ground<2>(1e9, 0.0);
  name_nodes(problem.mesh, "block", [](const auto&) { return true; });
  name_nodes(problem.mesh, "base", [](const auto& x) { return x(1) == 0.0; });
  const auto body = add_body<2>(problem, "bottom", joint);
  problem.prescribed.push_back({"body", Dof::u1, kZero, {}});
  problem.prescribed.push_back({"body", Dof::u2, kZero, {}});
  problem.prescribed.push_back(
      {"block",
       Dof::u1,
       TimeTable({{0.0, 0.0}, {1.0, 8e-4}, {2.0, 1.6e-3}, {3.0, 3.2e-3}, {4.0, 1.6e-3}, {5.0, 0.0}}),
       {}});
  problem.prescribed.push_back({"block", Dof::w, kZero, {}});
  problem.boundary_loads = {{.on = "top", .pressure = TimeTable::constant(50e3)}};
  Solver<2> solver(std::move(problem), {.force_tolerance = 1e-11, .moment_tolerance = 1e-10});
  ASSERT_TRUE(solver.equilibrate().converged);
  const auto dilation = [&] { return solver.mean_displacement("base")(1) + 50e3 / 1e8; };
  const double limit = 33867.513459;
  for (const auto& [time, shear, opening] :
       {std::tuple(1.0, 32000.0, 0.0), std::tuple(2.0, limit, 1.328292593e-4),
        std::tuple(3.0, limit, 4.149524285e-4), std::tuple(4.0, -30132.486541, 4.149524285e-4),
        std::tuple(5.0, -limit, 6.806109471e-4)}) {
    expect_converged(solver, time);
    EXPECT_NEAR(solver.reaction("block")(0), shear, 2e-6) << time;
    EXPECT_NEAR(dilation(), opening, 2e-13) << time;
  }
}

// A block that slides over a wall whose grains roll: free grains of the ground turn with them, by the slip times the turning, in
// the sense of a wheel on a floor.
TEST_P(InPlane, grains_roll_along_a_wall) {
  InterfaceParameters joint = rough(1e8, 4e7, 30.0);
  constexpr double kTurning = 3.0;  // rad/m
  Problem<2> problem;
  problem.mesh = rectangle({{1.0, 0.1}, {4, 1}}, GetParam());
  // Skew stress that is nothing beside the others leaves the rotation to the wall.
  ElasticParameters<2> ground;
  ground.young_modulus = 1e7;
  ground.cosserat_shear_modulus = 10.0;
  ground.internal_length = 0.1;
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(ground));
  name_nodes(problem.mesh, "block", [](const auto&) { return true; });
  const auto faces = faces_along(problem.mesh, "bottom");
  const OwnNodes<2> own = add_own_nodes(problem.mesh, faces);
  problem.mesh.node_sets["body"] = own.nodes;
  std::vector<InterfaceFace<2>> of_interface;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    InterfaceFace<2>& face = of_interface.emplace_back(InterfaceFace<2>{
        faces[f].type, faces[f].first_nodes, own.face_nodes[f], {faces[f].first.element}, {}});
    for (const int node : face.nodes_b) face.rotation_b.push_back(entry_of<2>(node, Dof::w));
  }
  InterfaceSettings settings{"wall", joint, {}};
  settings.turning = kTurning;
  const auto interface = std::make_shared<Interface<2>>(problem.mesh, settings, std::move(of_interface));
  problem.contributions.push_back(interface);
  for (const Dof dof : {Dof::u1, Dof::u2, Dof::w}) problem.prescribed.push_back({"body", dof, kZero, {}});
  problem.prescribed.push_back({"block", Dof::u1, TimeTable::ramp(5e-3), {}});
  problem.boundary_loads = {{.on = "top", .pressure = TimeTable::constant(50e3)}};
  Solver<2> solver(std::move(problem), {.force_tolerance = 1e-10, .moment_tolerance = 1e-9});
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  ASSERT_TRUE(report.converged) << report.message;
  // Newton's method with the exact tangent: the first iterations slip, the others finish.
  EXPECT_LE(report.iterations, 6);
  const double slip = 5e-3 - 50e3 * joint.tan_friction / 4e7;
  // 2 Gc w = 0.3 Pa of skew stress over kt.
  EXPECT_NEAR(interface->results().front().slip, slip, 1e-8);
  // Over the wall's penalty, kt times the square of a face, it is 1e-7.
  EXPECT_NEAR(solver.mean_displacement("bottom")(2), -kTurning * slip, 1e-5 * kTurning * slip);
}

/// A stiff strip of length 1 that presses on a bed with an eccentric force; the bed takes no tension.
std::vector<InterfacePointResult<2>> pressed_strip(int elements, double eccentricity) {
  Problem<2> problem;
  problem.mesh = rectangle({{1.0, 0.1}, {elements, 1}}, "Q8R");
  problem.materials["all"] = elastic_ground<2>(1e9);
  hold_all(problem);
  const auto body =
      add_body<2>(problem, "top", {.normal_stiffness = 1e8, .shear_stiffness = 1e8, .tan_friction = 0.5});
  add_beam(problem, {1e12, 1e12, 1e12}, body.faces, body.own.face_nodes);
  name_node<2>(problem.mesh, "one end", {0.0, 0.1}, "body");
  name_node<2>(problem.mesh, "other end", {1.0, 0.1}, "body");
  problem.node_loads = {{"one end", Dof::u2, TimeTable::ramp(-1e5 * (0.5 - eccentricity))},
                        {"other end", Dof::u2, TimeTable::ramp(-1e5 * (0.5 + eccentricity))}};
  Solver<2> solver(std::move(problem), {.force_tolerance = 1e-7, .moment_tolerance = 1e-6});
  EXPECT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_TRUE(report.converged) << report.message;
  return body.interface->results();
}

double largest_pressure(const std::vector<InterfacePointResult<2>>& points) {
  double largest = 0.0;
  for (const auto& point : points) largest = std::max(largest, -point.traction(1));
  return largest;
}

// Contact over 3 (L/2 - e), the largest pressure 2 N over it. Stiff: 1e5 times the bed, so 1e-4.
// An iteration in which all points slip sends the block out of sight, where any imbalance is within rounding: that is no balance.
TEST(interface, a_block_that_nothing_holds_finds_no_balance) {
  Problem<2> problem;
  problem.mesh = rectangle({{2.0, 1.0}, {4, 2}}, "Q8R");
  problem.materials["all"] = elastic_ground<2>(50e6);
  const auto body = add_body<2>(problem, "bottom", rough(4e9, 4e9, 8.0));
  problem.prescribed.push_back({"body", Dof::u1, kZero, {}});
  problem.prescribed.push_back({"body", Dof::u2, kZero, {}});
  BoundaryLoad<2> load;
  load.on = "top";
  load.traction[1] = TimeTable::constant(-80e3);
  problem.boundary_loads.push_back(load);
  problem.body_loads = {
      {[](const Eigen::Vector2d&) { return Eigen::Vector3d(0.0, -20e3, 0.0); }},
      {[](const Eigen::Vector2d&) { return Eigen::Vector3d(18.2e3, 0.0, 0.0); }, TimeTable::ramp(1.0)}};
  Solver<2> solver(std::move(problem), {.force_tolerance = 1e-6, .moment_tolerance = 1e-6});
  ASSERT_TRUE(solver.equilibrate().converged);
  const double strength = 200e3 * std::tan(8.0 * kDegreeOfInterface);
  for (const double time : {0.25, 0.5, 0.75}) {
    const StepReport report = solver.advance(time);
    ASSERT_TRUE(report.converged) << time << report.message;
    EXPECT_NEAR(std::abs(body.interface->force()(0)), 36.4e3 * time, 1.0) << time;
  }
  EXPECT_FALSE(solver.advance(1.0).converged);
  EXPECT_LE(std::abs(body.interface->force()(0)), strength * (1.0 + 1e-5));
  EXPECT_GE(std::abs(body.interface->force()(0)), strength * 0.97);
}

TEST(interface, opens_under_a_moment) {
  for (const int elements : {4, 8}) {
    const auto points = pressed_strip(elements, 0.25);
    EXPECT_NEAR(largest_pressure(points), 266666.667, 30.0);
    double lift = 0.0;
    for (const auto& point : points) lift = std::max(lift, point.gap);
    EXPECT_NEAR(lift, 8.888889e-4, 1e-7);
  }
  // The zero is between nodes: figures of the independent code.
  EXPECT_NEAR(largest_pressure(pressed_strip(8, 0.2)), 222325.0, 30.0);
  EXPECT_NEAR(largest_pressure(pressed_strip(16, 0.2)), 222189.0, 30.0);
  EXPECT_NEAR(largest_pressure(pressed_strip(32, 0.2)), 222230.0, 30.0);
}

/// An elastic bar in a rigid bed, pulled at one end. @returns its displacements at both ends
std::pair<double, double> pulled_bar(int elements, const std::string& type) {
  Problem<2> problem;
  problem.mesh = rectangle({{4.0, 2.0}, {elements, 2}}, type);
  name_nodes(problem.mesh, "bar", [](const auto& x) { return x(1) == 1.0; });
  problem.materials["all"] = elastic_ground<2>(1e9);
  const auto originals = faces_along(problem.mesh, "bar");
  std::vector<std::vector<TwoSidedFace<2>>> curves{originals};
  split_along(problem.mesh, curves);
  hold_all(problem);
  const OwnNodes<2> own = add_own_nodes(problem.mesh, originals);
  problem.mesh.node_sets["body"] = own.nodes;
  std::vector<InterfaceFace<2>> faces;
  for (std::size_t f = 0; f < originals.size(); ++f) {
    faces.push_back(
        {originals[f].type, curves[0][f].first_nodes, own.face_nodes[f], {curves[0][f].first.element}, {}});
    const TwoSidedFace<2> turned = originals[f].seen_from_second(problem.mesh);
    std::vector<int> nodes = own.face_nodes[f];
    std::swap(nodes[0], nodes[1]);
    faces.push_back({turned.type, turned.first_nodes, nodes, {turned.first.element}, {}});
  }
  problem.contributions.push_back(std::make_shared<Interface<2>>(
      problem.mesh, InterfaceSettings{"bar", glue(1e9, 5e7), {}}, std::move(faces)));
  problem.prescribed.push_back({"body", Dof::w, kZero, {}});
  add_beam(problem, {1e8, 1e5, 1e8}, originals, own.face_nodes);
  name_node<2>(problem.mesh, "free end", {0.0, 1.0}, "body");
  name_node<2>(problem.mesh, "pulled end", {4.0, 1.0}, "body");
  problem.node_loads = {{"pulled end", Dof::u1, TimeTable::ramp(1e5)}};
  Solver<2> solver(std::move(problem), {.force_tolerance = 1e-12, .moment_tolerance = 1e-10});
  EXPECT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_TRUE(report.converged) << report.message;
  return {solver.mean_displacement("pulled end")(0), solver.mean_displacement("free end")(0)};
}

// u(L) = P / (EA b tanh bL), b^2 = 2 kt / EA. Errors of the independent code: quadratic bars in its second row.
TEST(interface, pull_out_of_an_elastic_bar) {
  const double b = std::sqrt(2 * 5e7 / 1e8);
  const double at_end = 1e5 / (1e8 * b * std::tanh(4 * b));
  EXPECT_NEAR(at_end, 1.000671150e-3, 1e-12);
  double before = 0.0;
  for (const auto& [elements, error] :
       {std::pair(4, -1.5e-3), std::pair(8, -1.1e-4), std::pair(16, -6.7e-6), std::pair(32, -4.2e-7)}) {
    const double found = pulled_bar(elements, "Q8R").first / at_end - 1.0;
    EXPECT_NEAR(found / error, 1.0, 0.05) << elements << " sides: " << found;
    before = found;
  }
  EXPECT_NEAR(pulled_bar(32, "Q8R").second, 1e5 / (1e8 * b * std::sinh(4 * b)), 1e-9);
  // Linear sides: second order.
  const double coarse = pulled_bar(16, "Q4").first / at_end - 1.0;
  const double fine = pulled_bar(32, "Q4").first / at_end - 1.0;
  EXPECT_NEAR(std::abs(coarse / fine), 4.0, 0.4);
  (void)before;
}

class InSpace : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, InSpace, ::testing::ValuesIn(element_names<3>()));

TEST_P(InSpace, a_uniform_stress_passes_the_joint) {
  Problem<3> problem;
  problem.mesh = box({{2.0, 2.0, 2.0}, {2, 2, 2}}, GetParam());
  distort<3>(problem.mesh, [](const Eigen::Vector3d& x) {
    const bool inner = (x.array() > 0.0).all() && (x.array() < 2.0).all();
    return Eigen::Vector3d(inner ? 0.15 : 0.0, inner ? -0.1 : 0.0, 0.0);
  });
  name_nodes(problem.mesh, "joint", [](const auto& x) { return x(2) == 1.0; });
  problem.materials["all"] = elastic_ground<3>(20e6);
  const auto interface = add_interface<3>(problem, "joint", glue(3e8, 1e8));
  const auto hold = [&](const std::string& on, Dof dof) {
    problem.prescribed.push_back({on, dof, kZero, {}});
  };
  for (const Dof dof : {Dof::u1, Dof::u2, Dof::u3}) hold("bottom_front_left", dof);
  hold("bottom_front_right", Dof::u2);
  hold("bottom_front_right", Dof::u3);
  hold("bottom_back_left", Dof::u3);
  Eigen::Matrix3d stress;
  stress << -40e3, 10e3, 30e3, 10e3, -60e3, -20e3, 30e3, -20e3, -100e3;
  const std::map<std::string, Eigen::Vector3d> normals{{"left", {-1, 0, 0}},   {"right", {1, 0, 0}},
                                                       {"front", {0, -1, 0}},  {"back", {0, 1, 0}},
                                                       {"bottom", {0, 0, -1}}, {"top", {0, 0, 1}}};
  for (const auto& [on, normal] : normals) {
    BoundaryLoad<3> load{.on = on};
    const Eigen::Vector3d t = stress * normal;
    for (std::size_t i = 0; i < 3; ++i)
      load.traction[i] = TimeTable::constant(t(static_cast<Eigen::Index>(i)));
    problem.boundary_loads.push_back(load);
  }
  Solver<3> solver(std::move(problem), {.force_tolerance = 1e-11, .moment_tolerance = 1e-11});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (const InterfacePointResult<3>& point : interface->results()) {
    EXPECT_NEAR(point.traction(2), -100e3, 1e-11 * 100e3) << point.geometry.place.transpose();
    const Eigen::Vector3d on_first = point.geometry.axes.transpose() * point.traction;
    const Eigen::Vector3d expected = stress * point.geometry.axes.row(2).transpose();
    EXPECT_LT((on_first - expected).norm(), 1e-11 * 100e3);
  }
}

TEST_P(InSpace, a_block_on_an_incline_sticks_and_slides_in_any_direction) {
  for (const auto& [slope, direction] : {std::pair(25.0, 20.0), std::pair(40.0, 70.0)}) {
    Problem<3> problem;
    problem.mesh = box({{1.0, 1.0, 0.4}, {2, 2, 1}}, GetParam());
    problem.materials["all"] = elastic_ground<3>(100e6);
    const auto body = add_body<3>(problem, "bottom", rough(1e9, 1e9, 30.0));
    for (const Dof dof : {Dof::u1, Dof::u2, Dof::u3}) problem.prescribed.push_back({"body", dof, kZero, {}});
    const double angle = slope * kDegreeOfInterface;
    const Eigen::Vector3d down(std::cos(direction * kDegreeOfInterface),
                               std::sin(direction * kDegreeOfInterface), 0.0);
    Eigen::Matrix<double, 6, 1> density = Eigen::Matrix<double, 6, 1>::Zero();
    density.head<3>() = 20e3 * (std::sin(angle) * down - std::cos(angle) * Eigen::Vector3d::UnitZ());
    problem.body_loads = {{[=](const Eigen::Vector3d&) { return density; }}};
    const bool slides = slope > 30.0;
    if (slides) {
      // Four springs, from the corners of the base, each along the way down: no turning.
      for (const std::string corner :
           {"bottom_front_left", "bottom_back_right", "bottom_front_right", "bottom_back_left"}) {
        const int node = problem.mesh.nodes_on(corner).front();
        const Eigen::Vector3d end = problem.mesh.nodes[static_cast<std::size_t>(node)] - down;
        problem.contributions.push_back(
            std::make_shared<Anchor<3>>(problem.mesh, AnchorSettings<3>{corner, node, {}, end, 1e4}));
      }
    }
    Solver<3> solver(std::move(problem), {.force_tolerance = 1e-11, .moment_tolerance = 1e-9});
    const StepReport report = solver.equilibrate();
    ASSERT_TRUE(report.converged) << slope << report.message;
    const Eigen::Vector3d force = body.interface->force();
    EXPECT_NEAR(force.head<2>().norm() / std::abs(force(2)),
                std::tan((slides ? 30.0 : slope) * kDegreeOfInterface), slides ? 1e-7 : 1e-9)
        << "directions of slip differ by the strain of the block over its way";
    EXPECT_NEAR(std::abs(force.head<2>().normalized().dot(down.head<2>())), 1.0, slides ? 1e-4 : 1e-9);
  }
}

}  // namespace
