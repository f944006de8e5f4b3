// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// In which order the grains of a contact network are eliminated, and in which groups: a function of the
/// graph of the contacts alone, by whole numbers only.
///
/// Grains are ordered by approximate minimum degree. Those that follow one another in the elimination with
/// (nearly) the same neighbours make one front, whose equations are a dense matrix: the grains to eliminate
/// (the pivots), then the grains that they are coupled to by then (the border). The rest of a front after
/// the elimination is added to its parent's: the multifrontal method (Duff, Reid 1983).
class EliminationPlan {
 public:
  struct Front {
    int pivots_begin = 0;    ///< in order()
    int pivots = 0;          ///< grains
    int border_begin = 0;    ///< in borders()
    int border = 0;          ///< grains
    int contacts_begin = 0;  ///< in contacts()
    int contacts = 0;        ///< those whose first eliminated grain is among the pivots
    int children = 0;  ///< fronts that add to this one: the last ones made and not yet taken, as on a stack
  };

  /// @param grains contacts refer to 0 .. grains - 1
  void make(std::span<const Contact> contacts, int grains);

  [[nodiscard]] std::span<const Front> fronts() const { return fronts_; }  ///< children before parents
  [[nodiscard]] std::span<const int> order() const { return order_; }      ///< grains, as they are eliminated
  [[nodiscard]] std::span<const int> borders() const {
    return borders_;
  }  ///< grains, in order of elimination
  [[nodiscard]] std::span<const int> contacts() const { return contacts_; }  ///< by fronts

 private:
  /// A front while fronts are being joined. Lists are chained by indices: -1 ends them.
  struct Node {
    int pivots = 0;
    int border_begin = 0;
    int border = 0;
    int parent = -1;
    int children = 0;  ///< counted when fronts are placed
    int first_child = -1;
    int next_sibling = -1;
    int first_pivot = -1;  ///< in next_pivot_
    int last_pivot = -1;
  };

  void find_neighbours(std::span<const Contact> contacts, int grains);
  void order_by_degree(int grains);
  void find_nodes(int grains);
  void find_border(int node);
  void join_children(int node);
  void place_fronts(int grains);
  void place_contacts(std::span<const Contact> contacts);

  std::vector<int> neighbours_begin_;
  std::vector<int> neighbours_;
  std::vector<int> degree_order_;  // grains
  std::vector<int> rank_;          // of a grain in degree_order_, later in order_
  std::vector<Node> nodes_;        // by rank of the last pivot
  std::vector<int> node_borders_;  // ranks
  std::vector<int> next_pivot_;    // by rank
  std::vector<int> mark_;
  std::vector<int> stack_;
  std::vector<Front> fronts_;
  std::vector<int> order_;
  std::vector<int> borders_;
  std::vector<int> contacts_;
  std::vector<int> front_of_;  // by rank in order_
};

}  // namespace polargrain::dem
