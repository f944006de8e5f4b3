// SPDX-License-Identifier: GPL-2.0-or-later
// The law of an interface at one point, against closed forms and differences.
#include <gtest/gtest.h>

#include <random>

#include "fem/interface/interface_law.hpp"

using namespace polargrain::fem;

namespace {

constexpr double kDegreeOfInterfaceLaw = 3.14159265358979323846 / 180.0;

/// The joint of Goodman's shear test in the tests: friction 30, dilation 10 degrees, cohesion 5 kPa.
InterfaceParameters joint() {
  return {.normal_stiffness = 1e8,
          .shear_stiffness = 4e7,
          .tan_friction = std::tan(30 * kDegreeOfInterfaceLaw),
          .tan_dilation = std::tan(10 * kDegreeOfInterfaceLaw),
          .cohesion = 5e3};
}

/// A point under a constant normal stress: the normal jump follows the tangential one.
class ShearBox {
 public:
  explicit ShearBox(const InterfaceParameters& parameters, double normal_stress)
      : parameters_(parameters),
        normal_stress_(normal_stress),
        normal_jump_(normal_stress / parameters.normal_stiffness) {}

  /// @returns the shear stress
  double shear_to(double u) {
    FaceVector<2> jump(u, normal_jump_);
    for (int iteration = 0; iteration < 50; ++iteration) {
      answer_ = respond<2>(parameters_, state_, jump);
      const double missing = normal_stress_ - answer_.traction(1);
      if (std::abs(missing) < 1e-9 * std::abs(normal_stress_)) break;
      jump(1) += missing / answer_.tangent(1, 1);
    }
    normal_jump_ = jump(1);
    state_ = answer_.state;
    return answer_.traction(0);
  }
  /// Normal jump beyond the elastic one.
  [[nodiscard]] double dilation() const {
    return normal_jump_ - normal_stress_ / parameters_.normal_stiffness;
  }

 private:
  InterfaceParameters parameters_;
  double normal_stress_;
  double normal_jump_;
  InterfaceState<2> state_;
  InterfaceAnswer<2> answer_;
};

// Closed form: limit c + 50 kPa tan 30 = 33867.513459 Pa at u = limit / kt; then dilation tan 10 (u - u_limit).
TEST(interface_law, passes_the_shear_test_of_goodman) {
  ShearBox box(joint(), -50e3);
  const double limit = 5e3 + 50e3 * std::tan(30 * kDegreeOfInterfaceLaw);
  EXPECT_NEAR(limit, 33867.513459, 1e-6);
  EXPECT_NEAR(box.shear_to(8e-4), 32000.0, 1e-6);
  EXPECT_NEAR(box.shear_to(1.6e-3), limit, 1e-6);
  EXPECT_NEAR(box.dilation(), 1.328292593e-4, 1e-13);
  EXPECT_NEAR(box.shear_to(3.2e-3), limit, 1e-6);
  EXPECT_NEAR(box.dilation(), 4.149524285e-4, 1e-13);
  EXPECT_NEAR(box.shear_to(1.6e-3), -30132.486541, 1e-6);
  EXPECT_NEAR(box.shear_to(0.0), -limit, 1e-6);
  EXPECT_NEAR(box.dilation(), 6.806109471e-4, 1e-13);
}

TEST(interface_law, dilation_ends_at_the_slip_given) {
  InterfaceParameters parameters = joint();
  parameters.dilation_until = 1e-3;
  ShearBox box(parameters, -50e3);
  for (int i = 1; i <= 400; ++i) box.shear_to(1e-5 * i);
  const double slip = 4e-3 - (5e3 + 50e3 * std::tan(30 * kDegreeOfInterfaceLaw)) / 4e7;
  ASSERT_GT(slip, 1e-3);
  EXPECT_NEAR(box.dilation(), 1e-3 * std::tan(10 * kDegreeOfInterfaceLaw),
              1e-5 * std::tan(10 * kDegreeOfInterfaceLaw))
      << "to one step of slip";
}

/// A random law and a random committed state.
struct Drawn {
  InterfaceParameters parameters;
  template <int dim>
  static FaceVector<dim> vector(std::mt19937& random, double scale) {
    std::uniform_real_distribution<double> uniform(-scale, scale);
    FaceVector<dim> drawn;
    for (double& x : drawn) x = uniform(random);
    return drawn;
  }
  /// @param over_slip with friction and dilation that change over the slip
  explicit Drawn(std::mt19937& random, bool over_slip = false) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    parameters.normal_stiffness = 1e8 * (0.1 + share(random));
    parameters.shear_stiffness = 1e8 * (0.1 + share(random));
    parameters.tan_friction = share(random);
    parameters.tan_dilation = parameters.tan_friction * share(random);
    parameters.cohesion = 2e4 * share(random);
    parameters.tension = std::min(1e5, parameters.cohesion / parameters.tan_friction) *
                         (share(random) < 0.5 ? 0.0 : share(random));
    if (!over_slip) return;
    // Up to a peak and down again, within the slips that are drawn; opening too.
    std::vector<FrictionCurve::Measured> points{{0.0, 0.2 * share(random), 0.0}};
    for (int k = 1; k < 6; ++k)
      points.push_back({points.back().slip + 4e-4 * (0.1 + share(random)), 0.1 + 0.8 * share(random),
                        points.back().opening + 1e-4 * share(random)});
    parameters.over_slip = std::make_shared<FrictionCurve>(points);
    parameters.tension = 0.0;
  }
};

template <int dim>
void check_tangents(int states, bool over_slip = false) {
  std::mt19937 random(20240 + dim);
  int of_kind[3] = {0, 0, 0};
  for (int i = 0; i < states; ++i) {
    const Drawn drawn(random, over_slip);
    InterfaceState<dim> state;
    if (over_slip) state.slip = 2e-5 * (i % 50);
    state.initial_traction = Drawn::vector<dim>(random, 1e5);
    state.plastic_jump = Drawn::vector<dim>(random, 1e-3);
    const FaceVector<dim> jump = Drawn::vector<dim>(random, 2e-3);
    const InterfaceAnswer<dim> answer = respond<dim>(drawn.parameters, state, jump);
    ++of_kind[static_cast<int>(answer.contact)];
    const double step = 1e-9;
    for (int j = 0; j < dim; ++j) {
      FaceVector<dim> plus = jump;
      FaceVector<dim> minus = jump;
      plus(j) += step;
      minus(j) -= step;
      const auto ahead = respond<dim>(drawn.parameters, state, plus);
      const auto behind = respond<dim>(drawn.parameters, state, minus);
      if (ahead.contact != behind.contact) continue;  // a kink between them
      if (over_slip && drawn.parameters.over_slip->piece_at(ahead.state.slip) !=
                           drawn.parameters.over_slip->piece_at(behind.state.slip))
        continue;
      const FaceVector<dim> slope = (ahead.traction - behind.traction) / (2 * step);
      EXPECT_LT((slope - answer.tangent.col(j)).norm(), 1e-7 * drawn.parameters.normal_stiffness + 1.0)
          << "state " << i << ", column " << j;
    }
  }
  for (const int kind : of_kind) EXPECT_GT(kind, states / 20);
}

// Differences over 1e-9 m of stresses near 1e5 Pa round to 1e-2 Pa/m / 1e-9: far below 1e-7 of the stiffness.
TEST(interface_law, tangent_is_the_slope_in_the_plane) {
  check_tangents<2>(300);
}
TEST(interface_law, tangent_is_the_slope_in_space) {
  check_tangents<3>(300);
}

TEST(interface_law, tangent_is_the_slope_where_friction_changes_over_the_slip) {
  check_tangents<2>(300, true);
  check_tangents<3>(300, true);
}

// Under a constant normal stress the shear stress follows the curve, however long the steps are: slip = u - shear / kt.
TEST(interface_law, shear_follows_the_measured_curve_in_steps_of_any_length) {
  const auto curve = std::make_shared<FrictionCurve>(std::vector<FrictionCurve::Measured>{
      {0.0, 0.1, 0.0}, {1e-3, 0.5, 1e-4}, {3e-3, 0.3, 4e-4}, {4e-3, 0.3, 3e-4}});
  const InterfaceParameters parameters{.normal_stiffness = 1e7, .shear_stiffness = 1e9, .over_slip = curve};
  // Soft against the normal jump, so that an opening changes the stress by less than it is and the box's Newton iteration stays closed;
  // that ends at 1e-4 Pa.
  // tan(delta) and opening at slips of 0.5, 2 and 5 mm, by hand; an opening that falls stays.
  const double slips[] = {0.5e-3, 2e-3, 5e-3};
  const double frictions[] = {0.3, 0.4, 0.3};
  const double openings[] = {0.5e-4, 2.5e-4, 4e-4};
  for (const int parts : {1, 7}) {
    ShearBox box(parameters, -100e3);
    double before = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double after = slips[i] + frictions[i] * 100e3 / 1e9;
      double shear = 0.0;
      for (int part = 1; part <= parts; ++part)
        shear = box.shear_to(before + (after - before) * part / parts);
      EXPECT_NEAR(shear, 100e3 * frictions[i], 1e-3) << slips[i] << " in " << parts;
      EXPECT_NEAR(box.dilation(), openings[i], 1e-10) << slips[i] << " in " << parts;
      before = after;
    }
  }
}

// A spring of 1 MPa/m does not follow a fall of 100 MPa/m: the joint slips behind it, to where the friction carries the shear.
TEST(interface_law, a_fall_steeper_than_the_stiffness_is_passed) {
  const auto curve = std::make_shared<FrictionCurve>(
      std::vector<FrictionCurve::Measured>{{0.0, 0.5, 0.0}, {1e-4, 0.4, 0.0}});
  const InterfaceParameters parameters{.normal_stiffness = 1e9, .shear_stiffness = 1e6, .over_slip = curve};
  ShearBox box(parameters, -100e3);
  EXPECT_NEAR(box.shear_to(0.0499), 49.9e3, 1e-6);
  EXPECT_NEAR(box.shear_to(0.0501), 40e3, 1e-6);
}

TEST(interface_law, stress_obeys_the_limits_at_random_states) {
  std::mt19937 random(7);
  for (int i = 0; i < 500; ++i) {
    const Drawn drawn(random);
    InterfaceState<3> state;
    state.initial_traction = Drawn::vector<3>(random, 1e5);
    const auto answer = respond<3>(drawn.parameters, state, Drawn::vector<3>(random, 2e-3));
    const double shear = answer.traction.head<2>().norm();
    EXPECT_LE(shear + answer.traction(2) * drawn.parameters.tan_friction - drawn.parameters.cohesion, 1e-6);
    EXPECT_LE(answer.traction(2), drawn.parameters.tension + 1e-6);
    if (answer.contact == Contact::open) {
      EXPECT_EQ(answer.traction.norm(), 0.0);
    }
  }
}

// In space the plane's law holds in the plane of sliding, whatever direction that has in the face.
TEST(interface_law, in_space_it_is_the_law_of_the_plane_in_any_direction) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const Drawn drawn(random);
    const FaceVector<2> jump = Drawn::vector<2>(random, 2e-3);
    const double angle = 0.1 * i;
    const FaceVector<3> turned(jump(0) * std::cos(angle), jump(0) * std::sin(angle), jump(1));
    const auto plane = respond<2>(drawn.parameters, {}, jump);
    const auto space = respond<3>(drawn.parameters, {}, turned);
    EXPECT_EQ(static_cast<int>(plane.contact), static_cast<int>(space.contact));
    EXPECT_NEAR(space.traction(2), plane.traction(1), 1e-7);
    EXPECT_NEAR(space.traction(0), plane.traction(0) * std::cos(angle), 1e-7);
    EXPECT_NEAR(space.traction(1), plane.traction(0) * std::sin(angle), 1e-7);
  }
}

// The vertex of the cone: tension there and no shear, on either side of it.
TEST(interface_law, the_vertex_is_open) {
  InterfaceParameters parameters = joint();
  parameters.tan_dilation = parameters.tan_friction;
  parameters.tension = parameters.cohesion / parameters.tan_friction;
  const double vertex = parameters.tension / parameters.normal_stiffness;
  EXPECT_EQ(respond<2>(parameters, {}, {0.0, 0.999 * vertex}).contact, Contact::sticks);
  const auto beyond = respond<2>(parameters, {}, {0.0, 1.001 * vertex});
  EXPECT_EQ(beyond.contact, Contact::open);
  EXPECT_EQ(beyond.traction.norm(), 0.0);
}

TEST(interface_law, a_gap_closes_where_it_opened_and_without_shear) {
  InterfaceParameters parameters = joint();
  parameters.tan_dilation = 0.0;
  parameters.tension = 2e3;
  InterfaceState<2> state;
  const auto go_to = [&](const FaceVector<2>& jump) {
    const auto answer = respond<2>(parameters, state, jump);
    state = answer.state;
    return answer;
  };
  EXPECT_NEAR(go_to({0.0, 1e-5}).traction(1), 1e3, 1e-9) << "below the tensile strength";
  const auto open = go_to({3e-3, 2e-3});
  EXPECT_EQ(open.contact, Contact::open);
  EXPECT_NEAR(gap<2>(parameters, open, {3e-3, 2e-3}), 2e-3, 1e-18);
  EXPECT_EQ(mobilised_share<2>(parameters, open), 0.0);
  // A tension of 1 kPa does not come back, and neither does the cohesion.
  EXPECT_EQ(go_to({3e-3, 1e-5}).contact, Contact::open);
  const auto closed = go_to({3e-3, -1e-4});
  EXPECT_EQ(closed.contact, Contact::sticks);
  EXPECT_NEAR(closed.traction(1), -1e4, 1e-9);
  EXPECT_NEAR(closed.traction(0), 0.0, 1e-9);
  EXPECT_EQ(gap<2>(parameters, closed, {3e-3, -1e-4}), 0.0);
  const auto slips = go_to({5e-3, -1e-4});
  EXPECT_EQ(slips.contact, Contact::slips);
  EXPECT_NEAR(slips.traction(0), 1e4 * parameters.tan_friction, 1e-9);
  EXPECT_EQ(mobilised_share<2>(parameters, slips), 1.0);
  parameters.cohesion_lasts = true;
  EXPECT_NEAR(go_to({7e-3, -1e-4}).traction(0), 5e3 + 1e4 * parameters.tan_friction, 1e-9);
}

}  // namespace
