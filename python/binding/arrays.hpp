// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <pybind11/numpy.h>

#include <Eigen/Core>

namespace polargrain::python {

/// A list of doubles, or a table of them, as NumPy holds it: rows one after the other.
using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// A copy as a NumPy array of two dimensions.
template <class Matrix>
Array array_of(const Matrix& matrix) {
  Array array({matrix.rows(), matrix.cols()});
  auto values = array.template mutable_unchecked<2>();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) values(row, column) = matrix(row, column);
  return array;
}

/// The matrix of an array that polargrain/*.py has brought to its shape.
template <class Matrix>
Matrix matrix_of(const Array& array) {
  Matrix matrix;
  if (array.size() != matrix.size()) throw pybind11::value_error("an array has another size than its matrix");
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      matrix(row, column) = array.data()[row * matrix.cols() + column];
  return matrix;
}

}  // namespace polargrain::python
