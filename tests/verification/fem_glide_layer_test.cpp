// SPDX-License-Identifier: GPL-2.0-or-later
// Micropolar glide layer: mu = 2, mu_c = 3, beta = gamma = 0.6, no shear traction, w(0) = 0, w(1) = sinh 2.
// Exact: w = sinh 2y, u_x = 0.6 (1 - cosh 2y). In the notation of docs/theory.md, A.5: G = mu, Gc = mu_c, and
// the couple modulus 2 G lc^2 = beta + gamma.
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

TEST(glide_layer, has_the_published_displacement) {
  constexpr int kElements = 20;
  const TimeTable zero = TimeTable::constant(0.0);
  Problem<2> problem;
  problem.mesh = rectangle({{1.0 / kElements, 1.0}, {1, kElements}});
  const ElasticParameters<2> parameters{2 * 2.0 * 1.25, 0.25, 3.0, std::sqrt(0.3), Vector7::Zero()};
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(parameters));
  problem.prescribed = {{"all", Dof::u2, zero, {}},
                        {"bottom", Dof::u1, zero, {}},
                        {"bottom", Dof::w, zero, {}},
                        {"top", Dof::w, TimeTable::ramp(3.626860407847), {}}};
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const double error = solver.mean_displacement("top")(0) / -1.65731741465 - 1;
  double largest_rotation_error = 0.0;
  for (std::size_t node = 0; node < solver.problem().mesh.nodes.size(); ++node) {
    const double w = solver.state().displacement(3 * static_cast<Eigen::Index>(node) + 2);
    largest_rotation_error =
        std::max(largest_rotation_error, std::abs(w - std::sinh(2 * solver.problem().mesh.nodes[node](1))));
  }
  std::cout << "[figure] glide layer, 20 Q8R: relative error of u_x(1) " << error << ", largest error of w "
            << largest_rotation_error << '\n';
  EXPECT_LT(std::abs(error), 1e-6);           // as for the shear layer E.3 with 20 elements
  EXPECT_LT(largest_rotation_error, 3.6e-5);  // 1e-5 of the largest rotation
}

}  // namespace
