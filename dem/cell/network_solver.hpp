// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "dem/cell/dense_elimination.hpp"
#include "dem/cell/elimination_plan.hpp"

namespace polargrain::dem {

/// What one contact adds to the equations of a network: unknowns and equations are those of its first, then
/// of its second grain, three each.
struct ContactEquations {
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> stiffness;
  Eigen::Matrix<double, 6, 8, Eigen::RowMajor> right_sides;  ///< columns beyond those in use: anything
};

/// Direct solution of the equations of a network of grains with three unknowns each, without symmetry:
/// multifrontal elimination (EliminationPlan) with dense kernels (dense_elimination.hpp). Pivots are
/// exchanged within a front only, so the solution of a bad network may be poor: whoever asks checks the
/// residual.
///
/// The solver keeps its memory for the next network and nothing else: the same contacts give the same bits.
class NetworkSolver {
 public:
  static constexpr int kMostRightSides = 8;

  /// @param set for tests; results do not depend on it
  explicit NetworkSolver(InstructionSet set = best_instruction_set()) : set_(set) {}

  /// @param grains contacts refer to 0 .. grains - 1
  /// @param equations equations(c) returns the ContactEquations of contacts[c]; asked once for each
  /// @param spring added to the diagonal
  /// @param last_right_side empty, or the last right-hand side: a value for each grain's third equation
  /// @returns false when a pivot vanishes or is not finite
  template <typename Equations>
  bool solve(std::span<const Contact> contacts, int grains, int right_sides, double spring,
             std::span<const double> last_right_side, const Equations& equations);

  /// Of the last solve(): three rows, in each the right-hand sides' values.
  [[nodiscard]] double* solution(int grain) { return solution_.data() + 3 * grain * kStride; }
  [[nodiscard]] const double* solution(int grain) const { return solution_.data() + 3 * grain * kStride; }
  static constexpr int kStride = kMostRightSides;  ///< of rows, one for each unknown

 private:
  struct Place {
    std::size_t factors = 0;  // of the first pivot's row, in factors_
    int stride = 0;
  };

  void start(std::span<const Contact> contacts, int grains, int right_sides);
  [[nodiscard]] FrontMatrix open(std::size_t front, double spring, std::span<const double> last_right_side);
  void add_contact(const FrontMatrix& matrix, const Contact& contact, const ContactEquations& added) const;
  void take_child(const FrontMatrix& matrix);
  bool close(std::size_t front, const FrontMatrix& matrix);
  void substitute();

  InstructionSet set_;
  int right_sides_ = 0;
  EliminationPlan plan_;
  std::vector<Place> places_;
  std::vector<double> factors_;       // fronts one after another, each cut down to the rows of its pivots
  std::vector<double> passed_;        // stack of what closed fronts leave to their parents
  std::vector<std::size_t> waiting_;  // closed fronts whose parent is not open yet
  std::size_t passed_end_ = 0;
  std::vector<int> local_;  // first row in the open front, by grain
  std::vector<double> known_;
  std::vector<double> solution_;
};

template <typename Equations>
bool NetworkSolver::solve(std::span<const Contact> contacts, int grains, int right_sides, double spring,
                          std::span<const double> last_right_side, const Equations& equations) {
  start(contacts, grains, right_sides);
  for (std::size_t k = 0; k < plan_.fronts().size(); ++k) {
    const EliminationPlan::Front& front = plan_.fronts()[k];
    const FrontMatrix matrix = open(k, spring, last_right_side);
    for (const int c : plan_.contacts().subspan(front.contacts_begin, front.contacts))
      add_contact(matrix, contacts[c], equations(c));
    for (int child = 0; child < front.children; ++child) take_child(matrix);
    if (!close(k, matrix)) return false;
  }
  substitute();
  return true;
}

}  // namespace polargrain::dem
