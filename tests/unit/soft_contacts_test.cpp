// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/soft_contacts.hpp"

#include <gtest/gtest.h>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

/// Does not answer to strain, and shows overlaps as cells do.
struct OverlappingLaw {
  struct State {};
  double overlap;
  State initial_state() const { return {}; }
  Response<2> integrate(const State&, const Increment<2>&, State&) const { return {}; }
  static std::vector<std::string> field_names() { return {"void_ratio", "mean_overlap", "largest_overlap"}; }
  void fields(const State&, std::span<double> values) const {
    values[0] = 0.2;
    values[1] = overlap;
    values[2] = 4.0 * overlap;
  }
};

std::shared_ptr<Material<2>> overlapping(double overlap) {
  return std::make_shared<LocalMaterial<OverlappingLaw>>(OverlappingLaw{overlap});
}

/// Of two materials, one above the other.
std::string said(std::shared_ptr<Material<2>> below, std::shared_ptr<Material<2>> above) {
  Problem<2> problem;
  problem.mesh = rectangle({{0.04, 0.08}, {1, 2}});
  problem.mesh.regions = {{"below", {0}}, {"above", {1}}};
  problem.materials["below"] = std::move(below);
  problem.materials["above"] = std::move(above);
  problem.prescribed = {{"bottom", Dof::u2, TimeTable::constant(0.0), {}},
                        {"bottom_left", Dof::u1, TimeTable::constant(0.0), {}}};
  return app::soft_contacts(Solver<2>(std::move(problem), {}));
}

}  // namespace

TEST(soft_contacts, names_the_element_of_the_worst_point) {
  const std::string text = said(overlapping(0.051), overlapping(0.064));
  EXPECT_NE(text.find("element 1 overlap by 6.4 % of their radius on average, 25.6 % at most"),
            std::string::npos)
      << text;
}

TEST(soft_contacts, says_nothing_up_to_five_percent_and_of_materials_without_grains) {
  const auto elastic =
      std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>({40e6, 0.3, 10e6, 3e-3, Vector7::Zero()}));
  EXPECT_EQ(said(overlapping(0.05), elastic), "");
}
