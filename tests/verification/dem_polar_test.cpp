// SPDX-License-Identifier: GPL-2.0-or-later
// Discs of unequal radii (docs/theory/grains.md, C.8): a curvature slides them on each other, and their tangential
// forces have a share in the couple stress. Checked on square lattices of two radii, one beside the other: each
// disc is a centre of inversion, so the lattice that is bent for real, row by row, has a couple modulus of its own.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "dem/cell/condensed_tangent.hpp"
#include "tests/support/lattice_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

struct TwoRadii {
  double small = 0.0, large = 0.0;                       // m
  double normal = 1e6, tangential = 4e5, rolling = 0.0;  // N/m, N/m, N m

  [[nodiscard]] double radius(int column, int row) const { return (column + row) % 2 == 0 ? small : large; }
  [[nodiscard]] double spacing() const { return small + large; }
};

void PrintTo(const TwoRadii& radii, std::ostream* out) {
  *out << radii.small << ", " << radii.large << ", ks/kn " << radii.tangential / radii.normal << ", kth "
       << radii.rolling;
}

/// Bending stiffness of a strip of so many rows, per unit of its length and thickness, N m: u1 = -k x y, u2 = k x^2 / 2,
/// w = k x on top of which every disc of two columns is free. Nothing of a cell is used.
double bending_stiffness(const TwoRadii& lattice, int rows) {
  const double l = lattice.spacing();
  const int discs = 2 * rows;
  std::vector<Eigen::RowVectorXd> openings;
  std::vector<double> imposed;
  const auto add_contact = [&](int column, int row, int to_column, int to_row) {
    const Eigen::Vector2d from(column * l, (row - 0.5 * (rows - 1)) * l);
    const Eigen::Vector2d to(to_column * l, (to_row - 0.5 * (rows - 1)) * l);
    const Eigen::Vector2d n = (to - from) / l;
    const Eigen::Vector2d t(-n.y(), n.x());
    const auto bent = [](const Eigen::Vector2d& x) {
      return Eigen::Vector2d(-x.x() * x.y(), 0.5 * x.x() * x.x());
    };
    const Eigen::Vector2d apart = bent(to) - bent(from);
    const double first = lattice.radius(column, row);
    const double second = lattice.radius(to_column, to_row);
    const int a = 3 * (column % 2 * rows + row);
    const int b = 3 * (to_column % 2 * rows + to_row);
    const auto spring = [&](double stiffness, const Eigen::Vector2d& along, double turn_first,
                            double turn_second, double of_bending) {
      Eigen::RowVectorXd opening = Eigen::RowVectorXd::Zero(3 * discs);
      opening.segment<2>(b) += along;
      opening.segment<2>(a) -= along;
      opening(a + 2) += turn_first;
      opening(b + 2) += turn_second;
      openings.push_back(std::sqrt(stiffness) * opening);
      imposed.push_back(std::sqrt(stiffness) * of_bending);
    };
    spring(lattice.normal, n, 0.0, 0.0, apart.dot(n));
    spring(lattice.tangential, t, -first, -second, apart.dot(t) - first * from.x() - second * to.x());
    spring(lattice.rolling, Eigen::Vector2d::Zero(), -1.0, 1.0, to.x() - from.x());
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < 2; ++column) {
      add_contact(column, row, column + 1, row);
      if (row + 1 < rows) add_contact(column, row, column, row + 1);
    }
  Eigen::MatrixXd matrix(openings.size(), 3 * discs);
  Eigen::VectorXd given(openings.size());
  for (std::size_t k = 0; k < openings.size(); ++k) {
    matrix.row(static_cast<Eigen::Index>(k)) = openings[k];
    given(static_cast<Eigen::Index>(k)) = imposed[k];
  }
  const Eigen::VectorXd motion = matrix.completeOrthogonalDecomposition().solve(-given);
  return (matrix * motion + given).squaredNorm() / (2.0 * l);
}

/// The bending stiffness that one more row adds beyond its stretching: B times the height of a row. The ends of the
/// column disturb a few rows, the same ones for any number.
double bent_couple_modulus(const TwoRadii& lattice) {
  const double l = lattice.spacing();
  const auto beyond_stretching = [&](int rows) {
    double squares = 0.0;
    for (int row = 0; row < rows; ++row) squares += std::pow((row - 0.5 * (rows - 1)) * l, 2);
    return bending_stiffness(lattice, rows) - lattice.normal * l * squares;
  };
  return (beyond_stretching(44) - beyond_stretching(36)) / (8.0 * l);
}

/// The contacts of a periodic cell of columns x rows discs, both even.
std::vector<Contact> contacts_of(const TwoRadii& lattice, int columns, int rows) {
  std::vector<Contact> contacts;
  const auto number = [&](int column, int row) { return column % columns * rows + row % rows; };
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row)
      for (const Eigen::Vector2i& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(0, 1)}) {
        Contact contact;
        contact.first = number(column, row);
        contact.second = number(column + step.x(), row + step.y());
        contact.branch.head<2>() = lattice.spacing() * step.cast<double>();
        contact.normal_stiffness = lattice.normal;
        contact.tangential_stiffness = lattice.tangential;
        contact.rolling_stiffness = lattice.rolling;
        contact.arm_first = lattice.radius(column, row);
        contact.arm_second = lattice.radius(column + step.x(), row + step.y());
        contacts.push_back(contact);
      }
  return contacts;
}

Matrix7 condensed(const TwoRadii& lattice, int size) {
  const std::vector<Contact> contacts = contacts_of(lattice, size, size);
  const int discs = size * size;
  const std::vector<double> weights(static_cast<std::size_t>(discs), 1.0 / discs);
  const double area = discs * lattice.spacing() * lattice.spacing();
  const ContactNetwork network{contacts, discs, Eigen::Matrix2d::Identity(), area, 1e-10};
  return CondensedTangent().cosserat(network, weights).value();
}

class Polar : public ::testing::TestWithParam<TwoRadii> {};

TEST_P(Polar, CellsAreAsStiffAgainstCurvatureAsLatticesThatAreBent) {
  const double bent = bent_couple_modulus(GetParam());
  const double scale = GetParam().tangential * GetParam().spacing() * GetParam().spacing();
  // Either kind of disc shifts against the other, which takes a share of the slip over into normal springs.
  const double difference = GetParam().large - GetParam().small;
  const double relaxed = GetParam().normal / (GetParam().normal + GetParam().tangential);
  EXPECT_NEAR(bent, GetParam().rolling + 0.25 * difference * difference * GetParam().tangential * relaxed,
              1e-8 * scale);
  for (const int size : {2, 4, 8}) {
    const Matrix7 tangent = condensed(GetParam(), size);
    // The hold and rounding of a condition number of 1e10.
    EXPECT_NEAR(tangent(kCurvature1, kCurvature1), bent, 1e-8 * scale) << size;
    EXPECT_NEAR(tangent(kCurvature2, kCurvature2), bent, 1e-8 * scale) << size;
  }
  std::printf("[figure] couple modulus %.6g N, bent %.6g N; polar part before relaxation %.6g N\n",
              condensed(GetParam(), 4)(kCurvature1, kCurvature1), bent,
              0.25 * difference * difference * GetParam().tangential);
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, Polar,
    ::testing::Values(TwoRadii{5e-3, 5e-3, 1e6, 4e5, 2.0}, TwoRadii{5e-3, 5e-3, 1e6, 4e5, 0.0},
                      TwoRadii{3e-3, 7e-3, 1e6, 4e5, 0.0}, TwoRadii{3e-3, 7e-3, 1e6, 4e5, 2.0},
                      TwoRadii{2e-3, 8e-3, 1e6, 1e6, 0.0}, TwoRadii{4e-3, 5e-3, 1e6, 2e5, 0.5},
                      TwoRadii{1e-3, 9e-3, 1e6, 1e5, 0.0}, TwoRadii{2e-3, 3e-3, 1e5, 9e4, 0.02}));

/// The same lattice as a packing, pressed together a little.
CellDefinition packed(const TwoRadii& radii, int size, const std::string& models) {
  CellDefinition definition = test::lattice(2, 2, CellRotations::controlled);
  const std::string former = "hooke/stiffness tangential history rolling_friction li_chu";
  definition.script.replace(definition.script.find(former), former.size(), models);
  const double spacing = radii.spacing() * (1.0 - test::kOverlap);
  definition.packing.box << size * spacing, 0.0, 0.0, size * spacing;
  definition.packing.grains.clear();
  for (int column = 0; column < size; ++column)
    for (int row = 0; row < size; ++row) {
      Grain grain;
      grain.id = column * size + row;
      grain.position = {(column + 0.25) * spacing, (row + 0.25) * spacing};
      grain.radius = radii.radius(column, row);
      grain.mass = test::kDensity * std::numbers::pi * grain.radius * grain.radius * test::kThickness;
      grain.moment_of_inertia = 0.5 * grain.mass * grain.radius * grain.radius;
      definition.packing.grains.push_back(grain);
    }
  return definition;
}

TEST(PolarCells, TheGrainsAnswerToACurvatureAsTheLatticeDoes) {
  // hooke/stiffness: springs as in the lattice above; the rolling spring of the fixture is 0.8 k_t R*^2.
  TwoRadii radii{3e-3, 7e-3, test::kNormal, test::kTangential, 0.0};
  const double reduced = radii.small * radii.large / radii.spacing();
  for (const auto& [models, rolling] :
       {std::pair<std::string, double>("hooke/stiffness tangential history", 0.0),
        std::pair<std::string, double>("hooke/stiffness tangential li_chu", 0.0),
        std::pair<std::string, double>("hooke/stiffness tangential history rolling_friction li_chu",
                                       0.8 * radii.tangential * reduced * reduced)}) {
    SCOPED_TRACE(models);
    radii.rolling = rolling;
    const double exact = bent_couple_modulus(radii) / test::kThickness;
    for (const CellLoop loop : {CellLoop::automatic, CellLoop::plain, CellLoop::engine}) {
      CellDefinition definition = packed(radii, 4, models);
      definition.control.loop = loop;
      const auto cell = make_plane_cell(definition);
      PlaneRequest request;
      request.increment.curvature << 2e-3, 0.0;
      const PlaneReply reply = cell->evaluate(request);
      ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
      const double modulus = reply.response.stress(kCurvature1) / request.increment.curvature.x();
      std::printf("[figure] %s: couple modulus %.6g of the exact one, tangent %.6g\n", models.c_str(),
                  modulus / exact, reply.response.tangent(kCurvature1, kCurvature1) / exact);
      // The overlap shortens branches and arms, by as much as it is.
      EXPECT_NEAR(modulus, exact, 1e-3 * exact);
      EXPECT_NEAR(reply.response.tangent(kCurvature1, kCurvature1), exact, 1e-3 * exact);
      EXPECT_NEAR(reply.response.stress(kCurvature2), 0.0, 1e-3 * exact * request.increment.curvature.x());
    }
  }
}

}  // namespace
}  // namespace polargrain::dem
