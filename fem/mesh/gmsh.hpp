// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

struct GmshContent;

/// Where the module with Gmsh's library is looked for, in the order of trial: beside the program, in
/// ../lib/polargrain of the program, and where it was built.
std::vector<std::filesystem::path> gmsh_module_places();

/// The content of the file as Gmsh's library reads it, in any version of the .msh format.
/// @throws InputError when the module with the library cannot be loaded or the file is no mesh
GmshContent read_gmsh_content(const std::filesystem::path& file,
                              const std::vector<std::filesystem::path>& module_places = gmsh_module_places());

/// 3 where it has elements of volumes, else 2.
int dimension_of(const GmshContent& content);

/// The element of quadrilaterals of 8 nodes, and of hexahedra of 20, unless another is asked for.
template <int dim>
inline constexpr std::string_view kSerendipity = dim == 2 ? "Q8R" : "H20R";

/// The one for quadrilaterals of 4 nodes, and for hexahedra of 8, that may be asked for in place of Q4 and H8.
template <int dim>
inline constexpr std::string_view kOnePoint = dim == 2 ? "Q4R" : "H8R";

/// The mesh of the content. Named physical groups become regions (surfaces; in space volumes), boundaries (curves; surfaces)
/// and node sets (points; in space curves too); the region and the node set `all` are added. Where surfaces (volumes) have
/// physical groups, elements outside them are left out. Mirrored elements are turned round. Quadrilaterals of 4 nodes become
/// Q4, triangles of 6 nodes T6; in space hexahedra of 8 nodes H8, tetrahedra of 10 nodes T10, wedges of 15 nodes W15.
/// @param chosen the element for quadrilaterals of 8 nodes, "Q8R" or "Q8"; for hexahedra of 20, "H20R" or "H20"; or kOnePoint
/// @throws InputError when it was not read, has elements of other kinds, leaves the plane z = 0 (dim 2), or a curve (surface)
/// of a physical group is not a side of an element.
template <int dim = 2>
Mesh<dim> mesh_of(const std::filesystem::path& file, GmshContent content,
                  std::string_view chosen = kSerendipity<dim>);

/// Both in one. @throws InputError as they do
template <int dim = 2>
Mesh<dim> read_gmsh(const std::filesystem::path& file, std::string_view chosen = kSerendipity<dim>,
                    const std::vector<std::filesystem::path>& module_places = gmsh_module_places());

}  // namespace polargrain::fem
