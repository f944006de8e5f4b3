// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace polargrain::fem {

/// The content of a mesh file, in Gmsh's own numbers: the plain data that the module with Gmsh's library hands to
/// the reader. Both are compiled by the same compiler and know no more than this header of each other.
struct GmshContent {
  struct Node {
    std::size_t tag;
    std::array<double, 3> position;  ///< m
  };
  /// Elements of one kind that make up one entity.
  struct Block {
    int dimension;  ///< 0 points, 1 curves, 2 surfaces, 3 volumes
    int entity;
    int kind;                        ///< number of the element kind in Gmsh's manual, "MSH file format"
    std::size_t nodes_per_element;   ///< in Gmsh's order
    std::vector<std::size_t> nodes;  ///< tags, element by element
  };
  /// A physical group.
  struct Group {
    int dimension;
    std::string name;  ///< its number when it has no name
    std::vector<int> entities;
  };
  std::vector<Node> nodes;
  std::vector<Block> blocks;
  std::vector<Group> groups;
  std::string error;  ///< why the file could not be read; empty when it was
};

/// Name and type of the function that the module offers. Throws nothing.
inline constexpr const char* kGmshReaderName = "polargrain_read_gmsh_file";
using GmshReaderFunction = void (*)(const char* file, GmshContent* content);

}  // namespace polargrain::fem
