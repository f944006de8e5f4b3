// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/box/box.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "dem/box/rotation.hpp"

namespace polargrain::dem {

template <int dim>
Box<dim> Box<dim>::from_base_vectors(const Matrix& base_vectors) {
  if constexpr (dim == 2) {
    const Eigen::Vector2d first = base_vectors.col(0);
    const double length = first.norm();
    Box box;
    box.base << length, first.dot(base_vectors.col(1)) / length, 0.0, base_vectors.determinant() / length;
    box.orientation = arc_tangent(first.y(), first.x());
    return box;
  } else {
    const TriangularParts parts = triangular_parts(base_vectors);
    return {parts.triangular, parts.rotation};
  }
}

template <int dim>
typename Box<dim>::Matrix Box<dim>::frame() const {
  if constexpr (dim == 2) {
    return rotation_by(orientation);
  } else {
    return orientation;
  }
}

template <int dim>
typename Box<dim>::Matrix Box<dim>::inverse() const {
  Matrix made = Matrix::Zero();
  for (int axis = 0; axis < dim; ++axis) made(axis, axis) = 1.0 / base(axis, axis);
  if constexpr (dim == 2) {
    made(0, 1) = -base(0, 1) / (base(0, 0) * base(1, 1));
  } else {
    made(0, 1) = -base(0, 1) * made(0, 0) * made(1, 1);
    made(1, 2) = -base(1, 2) * made(1, 1) * made(2, 2);
    made(0, 2) = (base(0, 1) * base(1, 2) - base(0, 2) * base(1, 1)) * made(0, 0) * made(1, 1) * made(2, 2);
  }
  return made;
}

template <int dim>
double Box<dim>::size() const {
  double product = base(0, 0);
  for (int axis = 1; axis < dim; ++axis) product *= base(axis, axis);
  return product;
}

template <int dim>
Box<dim> Box<dim>::reduced() const {
  Box box = *this;
  // The tilt against the later base vector first: taking it off changes the one against the earlier.
  for (int column = dim - 1; column > 0; --column)
    for (int row = column - 1; row >= 0; --row)
      box.base.col(column) -= std::round(box.base(row, column) / box.base(row, row)) * box.base.col(row);
  return box;
}

template <int dim>
typename Box<dim>::Place Box<dim>::folded(Place place) const {
  // Along the last base vector first: the others have nothing of what it folds.
  for (int axis = dim - 1; axis >= 0; --axis) {
    const Place part = inverse() * place;
    place -= std::floor(part(axis)) * base.col(axis);
  }
  return place;
}

template <int dim>
typename Box<dim>::Numbers Box<dim>::numbers() const {
  if constexpr (dim == 2) {
    return {base(0, 0), base(1, 1), base(0, 1), orientation};
  } else {
    Numbers numbers;
    auto* place = numbers.data();
    for (int column = 0; column < 3; ++column)
      place = std::copy_n(base.col(column).data(), column + 1, place);
    std::copy_n(orientation.data(), 9, place);
    return numbers;
  }
}

template <int dim>
Box<dim> Box<dim>::from_numbers(const Numbers& numbers) {
  Box box;
  if constexpr (dim == 2) {
    box.base << numbers[0], numbers[2], 0.0, numbers[1];
    box.orientation = numbers[3];
  } else {
    const auto* place = numbers.data();
    for (int column = 0; column < 3; ++column) {
      std::copy_n(place, column + 1, box.base.col(column).data());
      place += column + 1;
    }
    std::copy_n(place, 9, box.orientation.data());
  }
  return box;
}

template <int dim>
BoxPath<dim>::BoxPath(const Box<dim>& start, const Matrix& displacement_gradient, int steps, Pace pace)
    : start_(start), steps_(steps), pace_(pace) {
  const Matrix whole = Matrix::Identity() + displacement_gradient;
  // The determinant is a polynomial in the fraction; a fold shows at the end or on the way.
  for (int part = 1; part <= 16; ++part) {
    const Matrix now = Matrix::Identity() + part / 16.0 * displacement_gradient;
    if (!(now.determinant() > 1e-3))
      throw RunError(dim == 2 ? "the increment folds the cell: its box would lose its area"
                              : "the increment folds the cell: its box would lose its volume");
  }
  if constexpr (dim == 2) {
    // In the plane R has the direction of the part of I + h that is a rotation times a number.
    rotation_(0) = arc_tangent(whole(1, 0) - whole(0, 1), whole.trace());
    stretch_ = rotation_by(-rotation_(0)) * whole - Matrix::Identity();
  } else {
    const Matrix turn = rotation_of(whole);
    rotation_ = rotation_vector(turn);
    const Matrix stretch = turn.transpose() * whole - Matrix::Identity();
    stretch_ = 0.5 * (stretch + stretch.transpose());
    growth_ = start.frame().transpose() * stretch_ * start.frame() * start.base;
  }
}

template <int dim>
BoxPath<dim> BoxPath<dim>::straight(const Box<dim>& start, const Matrix& gradient, int steps) {
  BoxPath path;
  path.start_ = start;
  path.growth_ = gradient * start.base;
  path.steps_ = steps;
  path.straight_ = true;
  return path;
}

template <int dim>
double BoxPath<dim>::fraction(int step) const {
  if (step <= 0) return 0.0;
  if (step >= steps_) return 1.0;
  const double time = static_cast<double>(step) / steps_;
  if (pace_ == Pace::even) return time;
  return time - sine(2.0 * std::numbers::pi * time) / (2.0 * std::numbers::pi);
}

template <int dim>
double BoxPath<dim>::share(int step) const {
  return step < 1 || step > steps_ ? 0.0 : fraction(step) - fraction(step - 1);
}

template <int dim>
typename BoxPath<dim>::Matrix BoxPath<dim>::deformation(int step) const {
  return turned(step) * (Matrix::Identity() + fraction(step) * stretch_);
}

template <int dim>
typename BoxPath<dim>::Matrix BoxPath<dim>::turned(int step) const {
  if constexpr (dim == 2) {
    return rotation_by(fraction(step) * rotation_(0));
  } else {
    return rotation_by(Rotation(fraction(step) * rotation_));
  }
}

template <int dim>
Box<dim> BoxPath<dim>::at(int step) const {
  if (step <= 0 || steps_ == 0) return start_;
  const double part = fraction(step);
  if (straight_) return {start_.base + part * growth_, start_.orientation};
  if constexpr (dim == 2) {
    const Matrix base = start_.base;
    Box<dim> box = Box<dim>::from_base_vectors(
        base + part * (start_.frame().transpose() * stretch_ * start_.frame() * base));
    box.orientation += start_.orientation + part * rotation_(0);
    return box;
  } else {
    const auto stretched = Box<dim>::from_base_vectors(start_.base + part * growth_);
    return {stretched.base, turned(step) * start_.orientation * stretched.orientation};
  }
}

template <int dim>
double largest_principal_strain(const BoxPath<dim>& path) {
  return Eigen::SelfAdjointEigenSolver<typename BoxPath<dim>::Matrix>(path.strain(), Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

template struct Box<2>;
template struct Box<3>;
template class BoxPath<2>;
template class BoxPath<3>;
template double largest_principal_strain(const BoxPath<2>&);
template double largest_principal_strain(const BoxPath<3>&);

}  // namespace polargrain::dem
