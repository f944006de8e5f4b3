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

/// Reads a mesh with Gmsh's own library, in any version of its .msh format. Named physical groups become
/// regions (surfaces), boundaries (curves) and node sets (points); the region and the node set `all` are
/// added. Where surfaces have physical groups, elements outside them are left out. Clockwise elements are
/// turned round.
/// @param quadrilateral8 the element for quadrilaterals of 8 nodes: "Q8R" or "Q8". Quadrilaterals of 4 nodes become
/// Q4, triangles of 6 nodes T6.
/// @throws InputError when the module with Gmsh's library cannot be loaded, the file cannot be read, has
/// elements of other kinds, leaves the plane z = 0, or a curve of a physical group is not a side of an element.
Mesh<2> read_gmsh(const std::filesystem::path& file, std::string_view quadrilateral8 = "Q8R",
                  const std::vector<std::filesystem::path>& module_places = gmsh_module_places());

/// The mesh that Gmsh's library has read from the file. @throws InputError as read_gmsh
Mesh<2> mesh_of(const std::filesystem::path& file, GmshContent content,
                std::string_view quadrilateral8 = "Q8R");

}  // namespace polargrain::fem
