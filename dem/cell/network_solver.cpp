// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/network_solver.hpp"

#include <algorithm>

namespace polargrain::dem {

namespace {

/// Memory is only ever made larger; fresh pages cost as much as the arithmetic.
template <typename Number>
void make_room(std::vector<Number>& values, std::size_t size) {
  if (values.size() < size) values.resize(size);
}

/// Rows begin with a cache line.
template <typename Number>
int stride_of(int columns) {
  constexpr int kLine = kRowSlackOf<Number>;
  return (columns + 2 * kLine - 1) / kLine * kLine;
}

}  // namespace

/// Plans the elimination and makes room for all that it will write.
template <int Motions, int MostRightSides, typename Number>
void NetworkSolver<Motions, MostRightSides, Number>::start(std::span<const Contact> contacts, int grains,
                                                           int right_sides) {
  right_sides_ = right_sides;
  plan_.make(contacts, grains);
  places_.clear();
  waiting_.clear();
  passed_end_ = 0;
  std::size_t factors = 0;
  std::size_t most_factors = 0;
  std::size_t passed = 0;
  std::size_t most_passed = 0;
  std::size_t most_border = 0;
  std::vector<std::size_t>& sizes = waiting_;
  for (const EliminationPlan::Front& front : plan_.fronts()) {
    const std::size_t rows = Motions * (front.pivots + front.border);
    const std::size_t border = Motions * front.border;
    const int stride = stride_of<Number>(static_cast<int>(rows) + right_sides);
    places_.push_back({factors, stride});
    most_factors = std::max(most_factors, factors + rows * stride);
    factors += Motions * front.pivots * static_cast<std::size_t>(stride);
    for (int child = 0; child < front.children; ++child) {
      passed -= sizes.back();
      sizes.pop_back();
    }
    if (border > 0) sizes.push_back(border * (border + right_sides));
    if (border > 0) passed += sizes.back();
    most_passed = std::max(most_passed, passed);
    most_border = std::max(most_border, border);
  }
  waiting_.clear();
  make_room(factors_, most_factors);
  make_room(passed_, most_passed);
  make_room(known_, most_border * kKnownStride);
  make_room(solution_, Motions * static_cast<std::size_t>(grains) * kStride);
  local_.resize(grains);
}

/// The equations of a front with what its grains have without contacts.
template <int Motions, int MostRightSides, typename Number>
FrontMatrixOf<Number> NetworkSolver<Motions, MostRightSides, Number>::open(std::size_t front, double spring,
                                                                           std::span<const double> torques) {
  const auto& [pivots_begin, pivots, border_begin, border, contacts_begin, contacts, children] =
      plan_.fronts()[front];
  const int rows = Motions * (pivots + border);
  const Matrix matrix{factors_.data() + places_[front].factors, rows, rows + right_sides_,
                      places_[front].stride, Motions * pivots};
  std::fill_n(matrix.values, static_cast<std::size_t>(rows) * matrix.stride, 0.0);
  int row = 0;
  for (const int grain : plan_.order().subspan(pivots_begin, pivots)) {
    local_[grain] = row;
    for (int k = 0; k < Motions; ++k) matrix.values[(row + k) * (matrix.stride + 1)] = spring;
    for (int axis = 0; axis < kRotations && !torques.empty(); ++axis)
      matrix.values[(row + kFirstRotation + axis) * matrix.stride + matrix.columns - kRotations + axis] =
          torques[grain];
    row += Motions;
  }
  for (const int grain : plan_.borders().subspan(border_begin, border)) {
    local_[grain] = row;
    row += Motions;
  }
  return matrix;
}

template <int Motions, int MostRightSides, typename Number>
void NetworkSolver<Motions, MostRightSides, Number>::add_contact(const Matrix& matrix, const Contact& contact,
                                                                 const Equations& added) const {
  const int grains[2] = {local_[contact.first], local_[contact.second]};
  for (int row = 0; row < 2 * Motions; ++row) {
    Number* to = matrix.values + (grains[row / Motions] + row % Motions) * matrix.stride;
    for (int side = 0; side < 2; ++side)
      for (int k = 0; k < Motions; ++k) to[grains[side] + k] += added.stiffness(row, Motions * side + k);
    for (int k = 0; k < right_sides_; ++k) to[matrix.rows + k] += added.right_sides(row, k);
  }
}

/// Adds what the front closed last, of those still waiting, has left.
template <int Motions, int MostRightSides, typename Number>
void NetworkSolver<Motions, MostRightSides, Number>::take_child(const Matrix& matrix) {
  const EliminationPlan::Front& child = plan_.fronts()[waiting_.back()];
  waiting_.pop_back();
  const auto border = plan_.borders().subspan(child.border_begin, child.border);
  const int width = Motions * child.border + right_sides_;
  passed_end_ -= Motions * static_cast<std::size_t>(child.border) * width;
  const Number* from = passed_.data() + passed_end_;
  // Grains that stand side by side in both fronts are one piece.
  pieces_.clear();
  for (const int grain : border) {
    if (pieces_.empty() || pieces_.back().begin + pieces_.back().length != local_[grain])
      pieces_.push_back({local_[grain], 0});
    pieces_.back().length += Motions;
  }
  for (const int grain : border)
    for (int k = 0; k < Motions; ++k) {
      Number* to = matrix.values + (local_[grain] + k) * matrix.stride;
      for (const Piece& piece : pieces_) {
        Number* const place = to + piece.begin;
        for (int column = 0; column < piece.length; ++column) place[column] += from[column];
        from += piece.length;
      }
      for (int side = 0; side < right_sides_; ++side) to[matrix.rows + side] += *from++;
    }
}

template <int Motions, int MostRightSides, typename Number>
bool NetworkSolver<Motions, MostRightSides, Number>::close(std::size_t front, const Matrix& matrix) {
  if (!eliminate(matrix, set_)) return false;
  if (matrix.rows == matrix.pivots) return true;
  const int width = matrix.columns - matrix.pivots;
  for (int row = matrix.pivots; row < matrix.rows; ++row) {
    std::copy_n(matrix.values + row * matrix.stride + matrix.pivots, width, passed_.data() + passed_end_);
    passed_end_ += width;
  }
  waiting_.push_back(front);
  return true;
}

template <int Motions, int MostRightSides, typename Number>
void NetworkSolver<Motions, MostRightSides, Number>::substitute() {
  for (std::size_t k = plan_.fronts().size(); k-- > 0;) {
    const EliminationPlan::Front& front = plan_.fronts()[k];
    Number* known = known_.data();
    for (const int grain : plan_.borders().subspan(front.border_begin, front.border))
      for (int unknown = 0; unknown < Motions; ++unknown, known += kKnownStride)
        std::copy_n(solution(grain) + unknown * kStride, right_sides_, known);
    const int rows = Motions * (front.pivots + front.border);
    const Matrix factors{factors_.data() + places_[k].factors, rows, rows + right_sides_, places_[k].stride,
                         Motions * front.pivots};
    substitute_back(factors, static_cast<const Number*>(known_.data()), kKnownStride, set_);
    const Number* solved = factors.values + factors.rows;
    for (const int grain : plan_.order().subspan(front.pivots_begin, front.pivots))
      for (int unknown = 0; unknown < Motions; ++unknown, solved += factors.stride)
        std::copy_n(solved, right_sides_, solution_.data() + (Motions * grain + unknown) * kStride);
  }
}

template class NetworkSolver<kPlaneMotions, 8>;
template class NetworkSolver<kSpaceMotions, 24>;
template class NetworkSolver<kSpaceMotions, 24, float>;

}  // namespace polargrain::dem
