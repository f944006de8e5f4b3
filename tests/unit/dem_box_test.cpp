// SPDX-License-Identifier: GPL-2.0-or-later
// The periodic box and its way along an increment, of discs (2) and of spheres (3).
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <type_traits>

#include "common/error.hpp"
#include "dem/box/box_motion.hpp"
#include "dem/box/rotation.hpp"

namespace polargrain::dem {
namespace {

template <class Dimension>
class PeriodicBox : public ::testing::Test {
 protected:
  static constexpr int dim = Dimension::value;
  using Matrix = typename Box<dim>::Matrix;
  using Place = typename Box<dim>::Place;

  /// Of three dimensions or of the first two.
  static Matrix part(const Eigen::Matrix3d& whole) { return whole.topLeftCorner<dim, dim>(); }
  static Matrix base() {
    Eigen::Matrix3d whole;
    whole << 0.2, 0.03, -0.04, 0.05, 0.19, 0.06, -0.02, 0.01, 0.21;
    return part(whole);
  }
  static Matrix gradient() {
    Eigen::Matrix3d whole;
    whole << 0.01, 0.2, 0.05, -0.1, -0.02, 0.03, 0.06, -0.04, 0.02;
    return part(whole);
  }
  static Matrix laboratory(const Box<dim>& box) { return box.frame() * box.base; }
  static Box<dim> box() { return Box<dim>::from_base_vectors(base()); }
  const Matrix one = Matrix::Identity();
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PeriodicBox, Dimensions);

TYPED_TEST(PeriodicBox, HoldsAnyLatticeInAFrameOfItsOwn) {
  const auto box = this->box();
  EXPECT_LT((this->laboratory(box) - this->base()).norm(), 2e-16);
  EXPECT_LT((box.frame() * box.frame().transpose() - this->one).norm(), 1e-15);
  for (int column = 0; column < this->dim; ++column) {
    EXPECT_GT(box.base(column, column), 0.0);
    for (int row = column + 1; row < this->dim; ++row) EXPECT_EQ(box.base(row, column), 0.0);
  }
  EXPECT_NEAR(box.size(), this->base().determinant(), 1e-17);
  EXPECT_LT((box.inverse() * box.base - this->one).norm(), 1e-15);
}

TYPED_TEST(PeriodicBox, IsKeptAsNumbersToTheBit) {
  const auto box = this->box();
  const auto kept = Box<TestFixture::dim>::from_numbers(box.numbers());
  EXPECT_EQ(kept.base, box.base);
  EXPECT_EQ(kept.frame(), box.frame());
}

TYPED_TEST(PeriodicBox, ReducedIsTheSameLattice) {
  auto box = this->box();
  for (int column = 1; column < this->dim; ++column)
    for (int row = 0; row < column; ++row) box.base.col(column) += (row - 3.0) * box.base.col(row);
  const auto reduced = box.reduced();
  for (int column = 1; column < this->dim; ++column)
    for (int row = 0; row < column; ++row)
      EXPECT_LE(std::abs(reduced.base(row, column)), 0.5 * reduced.base(row, row));
  // Base vectors differ by whole numbers of those before them.
  const auto whole = (box.inverse() * reduced.base).eval();
  EXPECT_LT((whole.array() - whole.array().round()).abs().maxCoeff(), 1e-13);
}

TYPED_TEST(PeriodicBox, FoldsAPlaceToItsImage) {
  const auto box = this->box();
  typename TestFixture::Place share = TestFixture::Place::LinSpaced(0.3, 0.8);
  const typename TestFixture::Place place = box.base * share;
  share.array() += 2.0;
  share(0) -= 5.0;
  EXPECT_LT((box.folded(box.base * share) - place).norm(), 1e-15);
}

TYPED_TEST(PeriodicBox, EndsWhereTheDisplacementGradientLeads) {
  const BoxPath<TestFixture::dim> path(this->box(), this->gradient(), 37);
  EXPECT_LT((this->laboratory(path.at(0)) - this->base()).norm(), 2e-16);
  EXPECT_LT((this->laboratory(path.at(37)) - (this->one + this->gradient()) * this->base()).norm(), 1e-15);
  EXPECT_LT((path.deformation(37) - this->one - this->gradient()).norm(), 1e-15);
}

TYPED_TEST(PeriodicBox, CarriesAGrainWithTheLattice) {
  constexpr int dim = TestFixture::dim;
  const int steps = 25;
  const double time_step = 1e-3;
  const BoxPath<dim> path(this->box(), this->gradient(), steps);
  BoxMotion<dim> motion(path, std::nullopt, time_step);
  // A grain that gets what the box adds to its velocity and nothing else stays where it is in the lattice.
  const typename TestFixture::Place share = TestFixture::Place::LinSpaced(0.3, 0.8);
  typename TestFixture::Place place = motion.box().base * share;
  typename TestFixture::Place velocity = TestFixture::Place::Zero();
  typename TestFixture::Matrix frame = motion.box().frame();
  double fastest = 0.0;
  double first = 0.0;
  for (int step = 1; step <= steps + 3; ++step) {
    motion.advance();
    velocity += motion.change_of_gradient() * place;
    EXPECT_LT((velocity - motion.gradient_before() * place).norm(), 1e-14 / time_step);
    place += time_step * velocity;
    EXPECT_LT((velocity - motion.gradient() * place).norm(), 1e-14 / time_step);
    EXPECT_LT((place - motion.box().base * share).norm(), 1e-14);
    if (step <= steps) {
      if constexpr (dim == 2) {
        frame = rotation_by(motion.turn()(0)) * frame;
      } else {
        frame = rotation_by(motion.turn()) * frame;
      }
    }
    fastest = std::max(fastest, motion.rate().norm());
    if (step == 1) first = motion.rate().norm();
  }
  EXPECT_LT((frame - path.at(steps).frame()).norm(), 1e-14);  // 25 products
  EXPECT_LT(velocity.norm(), 1e-14 / time_step);
  EXPECT_FALSE(motion.moving());
  // It starts at rest: the first step moves little (sine squared: (pi/steps)^2 / 3 of the mean).
  EXPECT_LT(first, 0.02 * fastest);
}

TYPED_TEST(PeriodicBox, PureRotationOnlyTurnsTheFrame) {
  constexpr int dim = TestFixture::dim;
  using Matrix = typename TestFixture::Matrix;
  Matrix turn, half;
  if constexpr (dim == 2) {
    turn = rotation_by(0.3);
    half = rotation_by(0.15);
  } else {
    const Eigen::Vector3d vector(0.2, -0.1, 0.3);
    turn = rotation_by(vector);
    half = rotation_by(Eigen::Vector3d(0.5 * vector));
  }
  const auto start = this->box();
  const BoxPath<dim> path(start, turn - this->one, 10);
  // All the way, not only at its end.
  for (int step = 0; step <= 10; ++step) EXPECT_LT((path.at(step).base - start.base).norm(), 1e-15) << step;
  EXPECT_LT((path.at(5).frame() - half * start.frame()).norm(), 2e-15);  // half of a smooth way
  EXPECT_LT((path.at(10).frame() - turn * start.frame()).norm(), 2e-15);
}

TYPED_TEST(PeriodicBox, GrainsThatTurnAsTheContinuumDoHaveNoSpinOfTheirOwn) {
  constexpr int dim = TestFixture::dim;
  // A rigid turn of the box, with the same rotation prescribed: seen from the frame, nothing happens.
  RotationLoading<dim> loading;
  loading.rotation(loading.rotation.size() - 1) = 0.3;
  typename TestFixture::Matrix turn;
  if constexpr (dim == 2) {
    turn = rotation_by(0.3);
  } else {
    turn = rotation_by(loading.rotation);
  }
  const BoxPath<dim> path(this->box(), turn - this->one, 10);
  BoxMotion<dim> motion(path, loading, 1e-3);
  for (int step = 1; step <= 12; ++step) {
    motion.advance();
    EXPECT_LT(motion.spin().norm(), 1e-12) << step;  // rad/s: 1e-15 rad in a step of 1 ms
  }
}

TYPED_TEST(PeriodicBox, RefusesToFold) {
  const typename TestFixture::Matrix gradient = -1.5 * this->one;
  EXPECT_THROW(BoxPath<TestFixture::dim>(this->box(), gradient, 10), RunError);
}

}  // namespace
}  // namespace polargrain::dem
