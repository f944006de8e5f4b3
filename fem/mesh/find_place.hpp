// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// A place inside of the body: the elements that have it, several on a side, and where it is in them.
template <int dim>
struct Probe {
  struct Inside {
    int element;
    typename Cosserat<dim>::Place reference;  ///< coordinates of the reference element
  };
  std::vector<Inside> elements;  ///< empty: outside of the body
};

/// Finds the elements that have a place.
template <int dim>
class PlaceFinder {
 public:
  /// @param mesh must outlive this object and keep its nodes
  explicit PlaceFinder(const Mesh<dim>& mesh);

  /// @param place m
  [[nodiscard]] Probe<dim> find(const typename Cosserat<dim>::Place& place) const {
    return find(place, kOnSide);
  }
  /// The same with elements that the place is a little outside of, as beside a curved boundary that is meshed otherwise.
  /// @param outside coordinate of the reference element, which is 2 wide (simplices: 1)
  [[nodiscard]] Probe<dim> find(const typename Cosserat<dim>::Place& place, double outside) const;

 private:
  static constexpr double kOnSide = 1e-8;  ///< a place on a side belongs to both elements
  struct Box {
    typename Cosserat<dim>::Place low, high;
  };
  const Mesh<dim>& mesh_;
  std::vector<Box>
      boxes_;  ///< around each element, with some room: curved sides may bulge beyond their nodes
};

/// The sides of a place, on each of which it has one value. Elements are on two sides where an interface parts them: the nodes that
/// carry the place, whose shape functions are not zero there, differ.
/// @param materials numbers of each element, for stresses, which jump from one to another; empty: for displacements
template <int dim>
std::vector<Probe<dim>> sides_at(const Mesh<dim>& mesh, const Probe<dim>& probe,
                                 const std::vector<int>& materials = {});

/// The mean of the middles of the elements of a probe, m: where one of its sides lies.
template <int dim>
typename Cosserat<dim>::Place middle_of(const Mesh<dim>& mesh, const Probe<dim>& probe);

/// Of one place. @param place on the mesh as it was made, m
template <int dim>
Probe<dim> find_place(const Mesh<dim>& mesh, const typename Cosserat<dim>::Place& place) {
  return PlaceFinder<dim>(mesh).find(place);
}

}  // namespace polargrain::fem
