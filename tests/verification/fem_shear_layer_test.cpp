// SPDX-License-Identifier: GPL-2.0-or-later
// docs/theory.md, E.3: elastic layer sheared between plates that hold the micro-rotation.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kShearModulus = 4000.0;
constexpr double kCosseratModulus = 2000.0;
constexpr double kInternalLength = 6.0;
constexpr double kHeightOfShearLayer = 100.0;

struct Answer {
  double shear_stress;
  double largest_rotation_error;  ///< relative to the rotation at mid-height
};

enum class Sides {
  no_normal_displacement,  ///< u2 = 0 everywhere makes the problem one-dimensional
  tied                     ///< both sides move alike, the top is free to rise
};

Answer solve_layer(int elements, const std::string& element, Sides sides = Sides::no_normal_displacement,
                   int columns = 1) {
  const TimeTable zero = TimeTable::constant(0.0);
  const double width = kHeightOfShearLayer / elements;
  Problem<2> problem;
  problem.mesh = rectangle(
      {{width, kHeightOfShearLayer}, {columns, elements}, {0.0, -kHeightOfShearLayer / 2}}, element);
  const ElasticParameters<2> parameters{2.5 * kShearModulus, 0.25, kCosseratModulus, kInternalLength,
                                        Vector7::Zero()};
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(parameters));
  if (sides == Sides::tied) problem.ties = {{"left", "right"}};
  const std::string held = sides == Sides::tied ? "bottom" : "all";
  problem.prescribed = {{held, Dof::u2, zero, {}},
                        {"bottom", Dof::u1, zero, {}},
                        {"bottom", Dof::w, zero, {}},
                        {"top", Dof::u1, TimeTable::ramp(1.0), {}},
                        {"top", Dof::w, zero, {}}};
  Solver<2> solver(std::move(problem), {});
  EXPECT_TRUE(solver.equilibrate().converged);
  EXPECT_TRUE(solver.advance(1.0).converged);
  const double decay =
      kInternalLength * std::sqrt((kShearModulus + kCosseratModulus) / (2 * kCosseratModulus));
  Answer answer{solver.reaction("top")(0) / width, 0.0};
  const auto exact = [&](double y) {
    return -answer.shear_stress / (2 * kShearModulus) *
           (1 - std::cosh(y / decay) / std::cosh(kHeightOfShearLayer / 2 / decay));
  };
  for (std::size_t node = 0; node < solver.problem().mesh.nodes.size(); ++node) {
    const double w = solver.state().displacement(3 * static_cast<Eigen::Index>(node) + 2);
    answer.largest_rotation_error =
        std::max(answer.largest_rotation_error,
                 std::abs((w - exact(solver.problem().mesh.nodes[node](1))) / exact(0)));
  }
  return answer;
}

double exact_shear_stress() {
  const double decay =
      kInternalLength * std::sqrt((kShearModulus + kCosseratModulus) / (2 * kCosseratModulus));
  const double softer = kCosseratModulus / (kShearModulus + kCosseratModulus) * 2 * decay /
                        kHeightOfShearLayer * std::tanh(kHeightOfShearLayer / (2 * decay));
  return kShearModulus / (1 - softer) / kHeightOfShearLayer;
}

TEST(shear_layer, has_the_exact_stiffness) {
  // The number of docs/theory.md, to its digits; the closed form is evaluated above.
  EXPECT_NEAR(exact_shear_stress(), 42.060532, 5e-7);
  const double error = solve_layer(20, "Q8R").shear_stress / exact_shear_stress() - 1;
  std::cout << "[figure] E.3 Q8R 20 elements: relative error of the shear stress " << error << '\n';
  EXPECT_LT(std::abs(error), 1e-6);  // asked for; the 2x2 points are superconvergent and give 5e-10
}

TEST(shear_layer, fully_integrated_elements_converge_with_the_fourth_power_of_the_size) {
  for (const char* element : {"Q8", "T6"}) {
    const double coarse = solve_layer(10, element).shear_stress / exact_shear_stress() - 1;
    const double fine = solve_layer(20, element).shear_stress / exact_shear_stress() - 1;
    std::cout << "[figure] E.3 " << element
              << " relative error of the shear stress, 10 and 20 elements: " << coarse << ' ' << fine << '\n';
    EXPECT_LT(std::abs(fine), std::abs(coarse) / 12) << element;  // energy converges with order 4: 16
    EXPECT_LT(std::abs(fine), 2e-5) << element;                   // measured 1.1e-5 and 8.6e-7
  }
}

TEST(shear_layer, rotations_converge_with_the_third_power_of_the_size) {
  const double coarse = solve_layer(10, "Q8R").largest_rotation_error;
  const double middle = solve_layer(20, "Q8R").largest_rotation_error;
  const double fine = solve_layer(40, "Q8R").largest_rotation_error;
  std::cout << "[figure] E.3 largest rotation error, 10, 20, 40 elements: " << coarse << ' ' << middle << ' '
            << fine << '\n';
  // Quadratic elements: order 3 or better; docs/theory.md has 3e-3, 3e-4, 3e-5.
  EXPECT_LT(middle, coarse / 7);
  EXPECT_LT(fine, middle / 7);
  EXPECT_LT(coarse, 4e-3);
}

TEST(shear_layer, tied_sides_make_it_one_dimensional) {
  // Free sides would carry no shear stress. With eight nodes the two answers are one; the diagonals of triangles leave
  // a normal displacement of the size of the discretisation's own error (1e-6 of the stress at 20 elements).
  const Answer held = solve_layer(20, "Q8R");
  for (const int columns : {1, 3}) {
    const Answer tied = solve_layer(20, "Q8R", Sides::tied, columns);
    EXPECT_NEAR(tied.shear_stress, held.shear_stress, 1e-9 * held.shear_stress) << columns;
    EXPECT_NEAR(tied.largest_rotation_error, held.largest_rotation_error, 1e-9) << columns;
  }
  EXPECT_NEAR(solve_layer(20, "T6", Sides::tied, 2).shear_stress, exact_shear_stress(),
              2e-5 * exact_shear_stress());
}

}  // namespace
