// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "common/archive.hpp"
#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// The body of a run at its end, as another run needs it that starts from there on a mesh of its own.
template <int dim>
struct EndOfRun {
  Mesh<dim> mesh;                              ///< nodes and elements alone, as it was made
  std::vector<std::size_t> region_of_element;  ///< number, in the order of the names
  std::vector<std::size_t> material_of_region;
  std::vector<char> there;  ///< by element: whether it is there at the end

  /// The points of the region's material are numbered through all regions that it has.
  struct Point {
    typename Cosserat<dim>::Place place;  ///< m
    int element;
    std::size_t of_material;  ///< number among the points of its material
  };
  /// In the order of Solver::points.
  [[nodiscard]] std::vector<Point> points() const;
  /// Points that a material has.
  [[nodiscard]] std::size_t points_of_material(std::size_t material) const;
};

template <int dim>
void write_end(ArchiveWriter& archive, const EndOfRun<dim>& end);
/// @throws RunError where the archive holds no body, or one of another dimension
template <int dim>
EndOfRun<dim> read_end(ArchiveReader& archive);

/// Whether both have the same nodes and elements, in the same order.
template <int dim>
bool is_same_mesh(const Mesh<dim>& one, const Mesh<dim>& other);

}  // namespace polargrain::fem
