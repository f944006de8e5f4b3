// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>
#include <type_traits>
#include <vector>

#include "dem/cell/dense_elimination.hpp"
#include "dem/cell/elimination_plan.hpp"

namespace polargrain::dem {

/// Unknowns of a grain: two displacements and a rotation in the plane, three of both in space.
inline constexpr int kPlaneMotions = 3;
inline constexpr int kSpaceMotions = 6;

/// The share of one contact in the equations of a network: unknowns and equations are those of its first, then
/// of its second grain.
template <int Motions, int MostRightSides>
struct ContactEquations {
  Eigen::Matrix<double, 2 * Motions, 2 * Motions, Eigen::RowMajor> stiffness;
  /// Columns beyond those in use: anything.
  Eigen::Matrix<double, 2 * Motions, MostRightSides, Eigen::RowMajor> right_sides;
};

/// Direct solution of the equations of a network of grains with `Motions` unknowns each, without symmetry:
/// multifrontal elimination (EliminationPlan) with dense kernels (dense_elimination.hpp). Pivots are
/// exchanged within a front only, so the solution of a bad network may be poor: whoever asks checks the
/// residual.
///
/// The solver keeps its memory for the next network and nothing else: the same contacts give the same bits.
///
/// @tparam Motions kPlaneMotions or kSpaceMotions @tparam MostRightSides a multiple of eight
/// @tparam Number double, or float: the elimination then takes half of the time and has a relative error of some 1e-5
template <int Motions, int MostRightSides, typename Number = double>
class NetworkSolver {
 public:
  using Equations = ContactEquations<Motions, MostRightSides>;
  static constexpr int kMostRightSides = MostRightSides;
  static constexpr int kRotations = Motions == kPlaneMotions ? 1 : 3;
  static constexpr int kFirstRotation = Motions - kRotations;

  /// @param set for tests; results do not depend on it
  explicit NetworkSolver(InstructionSet set = best_instruction_set()) : set_(set) {}

  /// @param grains contacts refer to 0 .. grains - 1
  /// @param equations equations(c) returns the Equations of contacts[c]; asked once for each
  /// @param spring added to the diagonal
  /// @param torques empty, or a value for each grain: the last kRotations right-hand sides, each with these in the
  /// equations of one rotation
  /// @returns false when a pivot vanishes or is not finite
  template <typename EquationsOf>
  bool solve(std::span<const Contact> contacts, int grains, int right_sides, double spring,
             std::span<const double> torques, const EquationsOf& equations);

  /// Of the last solve(): a row for each motion, in each the right-hand sides' values.
  [[nodiscard]] double* solution(int grain) {
    return solution_.data() + static_cast<std::ptrdiff_t>(Motions) * grain * kStride;
  }
  [[nodiscard]] const double* solution(int grain) const {
    return solution_.data() + static_cast<std::ptrdiff_t>(Motions) * grain * kStride;
  }
  static constexpr int kStride = kMostRightSides;  ///< of rows, one for each unknown
  /// The largest force that may stay unbalanced on a grain, over the largest affine force of a contact.
  static constexpr double kLargestUnbalance = std::is_same_v<Number, double> ? 1e-9 : 1e-3;

 private:
  using Matrix = FrontMatrixOf<Number>;
  static constexpr int kSlack = kRowSlackOf<Number>;
  static constexpr int kKnownStride = (kMostRightSides + kSlack - 1) / kSlack * kSlack;
  struct Place {
    std::size_t factors = 0;  // of the first pivot's row, in factors_
    int stride = 0;
  };

  /// Columns of an open front.
  struct Piece {
    int begin = 0;
    int length = 0;
  };

  void start(std::span<const Contact> contacts, int grains, int right_sides);
  [[nodiscard]] Matrix open(std::size_t front, double spring, std::span<const double> torques);
  void add_contact(const Matrix& matrix, const Contact& contact, const Equations& added) const;
  void take_child(const Matrix& matrix);
  bool close(std::size_t front, const Matrix& matrix);
  void substitute();

  InstructionSet set_;
  int right_sides_ = 0;
  EliminationPlan plan_;
  std::vector<Place> places_;
  std::vector<Number> factors_;       // fronts one after another, each cut down to the rows of its pivots
  std::vector<Number> passed_;        // stack of the parts that closed fronts leave to their parents
  std::vector<std::size_t> waiting_;  // closed fronts whose parent is not open yet
  std::size_t passed_end_ = 0;
  std::vector<int> local_;  // first row in the open front, by grain
  std::vector<Piece> pieces_;
  std::vector<Number> known_;
  std::vector<double> solution_;
};

using PlaneNetworkSolver = NetworkSolver<kPlaneMotions, 8>;
using SpaceNetworkSolver = NetworkSolver<kSpaceMotions, 24>;
using QuickSpaceNetworkSolver = NetworkSolver<kSpaceMotions, 24, float>;

template <int Motions, int MostRightSides, typename Number>
template <typename EquationsOf>
bool NetworkSolver<Motions, MostRightSides, Number>::solve(std::span<const Contact> contacts, int grains,
                                                           int right_sides, double spring,
                                                           std::span<const double> torques,
                                                           const EquationsOf& equations) {
  start(contacts, grains, right_sides);
  for (std::size_t k = 0; k < plan_.fronts().size(); ++k) {
    const EliminationPlan::Front& front = plan_.fronts()[k];
    const Matrix matrix = open(k, spring, torques);
    for (const int c : plan_.contacts().subspan(front.contacts_begin, front.contacts))
      add_contact(matrix, contacts[c], equations(c));
    for (int child = 0; child < front.children; ++child) take_child(matrix);
    if (!close(k, matrix)) return false;
  }
  substitute();
  return true;
}

extern template class NetworkSolver<kPlaneMotions, 8>;
extern template class NetworkSolver<kSpaceMotions, 24>;
extern template class NetworkSolver<kSpaceMotions, 24, float>;

}  // namespace polargrain::dem
