// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/elimination_plan.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cstdint>
#include <utility>

namespace polargrain::dem {

namespace {

/// The cost of a front, in multiplications of 3 x 3 blocks: its elimination, the passing on of its border, and
/// a fixed amount. The constants are fitted to measured times (bench/tangent_bench); only speed depends on
/// them.
std::int64_t cost(std::int64_t pivots, std::int64_t border) {
  constexpr std::int64_t kPassing = 2;  // a block of the border
  constexpr std::int64_t kFixed = 50;
  const std::int64_t size = pivots + border;
  const std::int64_t elimination = (size * size * size - border * border * border) / 3;
  return elimination + kPassing * size * size + kFixed;
}

}  // namespace

void EliminationPlan::make(std::span<const Contact> contacts, int grains) {
  find_neighbours(contacts, grains);
  order_by_degree(grains);
  find_nodes(grains);
  place_fronts(grains);
  place_contacts(contacts);
}

/// Each neighbour once, however many periodic images touch, in rising order; every grain is one of its own,
/// as AMDOrdering wants it.
void EliminationPlan::find_neighbours(std::span<const Contact> contacts, int grains) {
  neighbours_begin_.assign(grains + 1, 1);
  for (const Contact& contact : contacts) {
    ++neighbours_begin_[contact.first];
    ++neighbours_begin_[contact.second];
  }
  neighbours_begin_[grains] = 0;
  int sum = 0;
  for (int& begin : neighbours_begin_) begin = sum += begin;
  neighbours_.resize(sum);
  for (int grain = 0; grain < grains; ++grain) neighbours_[--neighbours_begin_[grain]] = grain;
  for (const Contact& contact : contacts) {
    neighbours_[--neighbours_begin_[contact.first]] = contact.second;
    neighbours_[--neighbours_begin_[contact.second]] = contact.first;
  }
  int kept = 0;
  for (int grain = 0; grain < grains; ++grain) {
    const auto begin = neighbours_.begin() + std::exchange(neighbours_begin_[grain], kept);
    const auto end = neighbours_.begin() + neighbours_begin_[grain + 1];
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    kept = static_cast<int>(std::copy(begin, last, neighbours_.begin() + kept) - neighbours_.begin());
  }
  neighbours_begin_[grains] = kept;
}

void EliminationPlan::order_by_degree(int grains) {
  Eigen::SparseMatrix<int> graph(grains, grains);  // its values mean nothing
  graph.resizeNonZeros(neighbours_begin_[grains]);
  std::copy(neighbours_begin_.begin(), neighbours_begin_.end(), graph.outerIndexPtr());
  std::copy_n(neighbours_.begin(), neighbours_begin_[grains], graph.innerIndexPtr());
  std::fill_n(graph.valuePtr(), neighbours_begin_[grains], 1);
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(graph, permutation);
  degree_order_.assign(permutation.indices().data(), permutation.indices().data() + grains);
  rank_.resize(grains);
  for (int rank = 0; rank < grains; ++rank) rank_[degree_order_[rank]] = rank;
}

void EliminationPlan::find_nodes(int grains) {
  nodes_.assign(grains, Node());
  next_pivot_.assign(grains, -1);
  node_borders_.clear();
  mark_.assign(grains, -1);
  for (int rank = 0; rank < grains; ++rank) {
    nodes_[rank].pivots = 1;
    nodes_[rank].first_pivot = nodes_[rank].last_pivot = rank;
    find_border(rank);
    join_children(rank);
  }
}

/// Grains coupled to this one when those before it are eliminated: its own neighbours and the borders of the
/// nodes below. The first of them is the node's parent.
void EliminationPlan::find_border(int node) {
  Node& self = nodes_[node];
  self.border_begin = static_cast<int>(node_borders_.size());
  mark_[node] = node;
  const auto add = [this, node](int rank) {
    if (rank > node && std::exchange(mark_[rank], node) != node) node_borders_.push_back(rank);
  };
  const int grain = degree_order_[node];
  for (int k = neighbours_begin_[grain]; k < neighbours_begin_[grain + 1]; ++k) add(rank_[neighbours_[k]]);
  for (int child = self.first_child; child >= 0; child = nodes_[child].next_sibling)
    for (int k = 0; k < nodes_[child].border; ++k) add(node_borders_[nodes_[child].border_begin + k]);
  self.border = static_cast<int>(node_borders_.size()) - self.border_begin;
  if (self.border == 0) return;
  self.parent = *std::min_element(node_borders_.begin() + self.border_begin, node_borders_.end());
  self.next_sibling = std::exchange(nodes_[self.parent].first_child, node);
}

/// Children are taken into the node's own front where the one dense matrix costs less than the two.
void EliminationPlan::join_children(int node) {
  Node& self = nodes_[node];
  int child = std::exchange(self.first_child, -1);
  while (child >= 0) {
    Node& other = nodes_[child];
    const int next = other.next_sibling;
    if (cost(self.pivots + other.pivots, self.border) <=
        cost(self.pivots, self.border) + cost(other.pivots, other.border)) {
      self.pivots += other.pivots;
      next_pivot_[other.last_pivot] = self.first_pivot;
      self.first_pivot = other.first_pivot;
      for (int grandchild = other.first_child; grandchild >= 0;) {
        const int following = nodes_[grandchild].next_sibling;
        nodes_[grandchild].next_sibling = std::exchange(self.first_child, grandchild);
        grandchild = following;
      }
      other.pivots = 0;
    } else {
      other.next_sibling = std::exchange(self.first_child, child);
    }
    child = next;
  }
}

/// Children before parents, and the fronts of one parent next to each other.
void EliminationPlan::place_fronts(int grains) {
  fronts_.clear();
  order_.clear();
  borders_.clear();
  front_of_.resize(grains);
  for (int root = 0; root < grains; ++root) {
    if (nodes_[root].pivots == 0 || nodes_[root].border > 0) continue;
    stack_.assign(1, root);
    while (!stack_.empty()) {
      Node& node = nodes_[stack_.back()];
      // A node is seen twice: its children come first.
      if (node.first_child >= 0) {
        for (int child = std::exchange(node.first_child, -1); child >= 0;
             child = nodes_[child].next_sibling) {
          stack_.push_back(child);
          ++node.children;
        }
        continue;
      }
      stack_.pop_back();
      Front& front = fronts_.emplace_back();
      front.children = node.children;
      front.pivots_begin = static_cast<int>(order_.size());
      front.pivots = node.pivots;
      for (int pivot = node.first_pivot, k = 0; k < node.pivots; pivot = next_pivot_[pivot], ++k) {
        front_of_[order_.size()] = static_cast<int>(fronts_.size()) - 1;
        order_.push_back(degree_order_[pivot]);
      }
      front.border_begin = static_cast<int>(borders_.size());
      front.border = node.border;
      for (int k = 0; k < node.border; ++k)
        borders_.push_back(degree_order_[node_borders_[node.border_begin + k]]);
    }
  }
  for (int rank = 0; rank < grains; ++rank) rank_[order_[rank]] = rank;
  // Borders in the order of elimination: neighbours in a child's front are mostly neighbours in its parent's.
  for (const Front& front : fronts_)
    std::sort(borders_.begin() + front.border_begin, borders_.begin() + front.border_begin + front.border,
              [this](int a, int b) { return rank_[a] < rank_[b]; });
}

void EliminationPlan::place_contacts(std::span<const Contact> contacts) {
  const auto front = [this](const Contact& contact) -> Front& {
    return fronts_[front_of_[std::min(rank_[contact.first], rank_[contact.second])]];
  };
  for (const Contact& contact : contacts) ++front(contact).contacts;
  int sum = 0;
  for (Front& each : fronts_) {
    each.contacts_begin = sum;
    sum += std::exchange(each.contacts, 0);
  }
  contacts_.resize(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Front& home = front(contacts[c]);
    contacts_[home.contacts_begin + home.contacts++] = static_cast<int>(c);
  }
}

}  // namespace polargrain::dem
