// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/gmsh.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <utility>

#include "common/error.hpp"
#include "common/regular_file.hpp"
#include "common/trial.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/mesh/gmsh_content.hpp"

namespace polargrain::fem {
namespace {

// Numbers of element kinds in Gmsh's manual, "MSH file format".
enum GmshKind : int {
  kLine2 = 1,
  kTriangle3 = 2,
  kQuadrilateral4 = 3,
  kLine3 = 8,
  kTriangle6 = 9,
  kQuadrilateral9 = 10,
  kPoint = 15,
  kQuadrilateral8 = 16
};

constexpr const char* kModule = "polargrain_gmsh.so";

/// Loads the module once; it stays for the life of the program.
GmshReaderFunction reader_function(const std::filesystem::path& mesh_file,
                                   const std::vector<std::filesystem::path>& places) {
  std::vector<std::string> failures;
  for (const std::filesystem::path& place : places) {
    const std::filesystem::path module = place / kModule;
    std::error_code error;
    if (!std::filesystem::is_regular_file(module, error)) {
      failures.push_back(fmt::format("not in {}", place.string()));
      continue;
    }
    if (void* handle = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
      if (void* function = dlsym(handle, kGmshReaderName)) {
        return reinterpret_cast<GmshReaderFunction>(function);  // NOLINT: what dlsym is for
      }
    }
    failures.emplace_back(dlerror());
  }
  throw InputError(Fault{mesh_file.string(), 0,
                         fmt::format("mesh files need the module {}, which cannot be loaded ({}); install "
                                     "Gmsh's library (Debian: libgmsh-dev) and build again",
                                     kModule, fmt::join(failures, "; "))});
}

class Reader {
 public:
  Reader(std::filesystem::path file, std::string_view quadrilateral8, GmshContent content)
      : file_(std::move(file)),
        quadrilateral8_(element_type<2>(quadrilateral8)),
        content_(std::move(content)) {}

  Mesh<2> read() {
    if (!content_.error.empty()) fail(fmt::format("Gmsh cannot read it: {}", content_.error));
    read_nodes();
    read_surfaces();
    find_sides();
    read_curves();
    read_points();
    drop_unused_nodes();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(Fault{file_.string(), 0, message});
  }

  void read_nodes() {
    for (const auto& [tag, position] : content_.nodes) {
      if (!std::isfinite(position[0]) || !std::isfinite(position[1]))
        fail(fmt::format("node {} has a coordinate that is not finite", tag));
      if (position[2] != 0.0) fail("a node leaves the plane z = 0; plane meshes are needed");
      node_of_tag_[tag] = static_cast<int>(mesh_.nodes.size());
      mesh_.nodes.emplace_back(position[0], position[1]);
    }
  }

  const ElementType<2>& type_of(int kind) const {
    switch (kind) {
      case kQuadrilateral8:
        return quadrilateral8_;
      case kQuadrilateral4:
        return element_type<2>("Q4");
      case kTriangle6:
        return element_type<2>("T6");
      case kTriangle3:
        fail("it has triangles of 3 nodes, too stiff to be offered: set Mesh.ElementOrder = 2");
      case kQuadrilateral9:
        fail("it has quadrilaterals of 9 nodes: set Mesh.SecondOrderIncomplete = 1 to get 8");
      default:
        fail(fmt::format("it has surface elements of Gmsh's kind {}, which is not offered", kind));
    }
  }

  /// Calls visit(kind, nodes of one element) for all elements of an entity.
  template <class Visit>
  void for_each_element(int dimension, int entity, Visit visit) const {
    for (const GmshContent::Block& block : content_.blocks) {
      if (block.dimension != dimension || block.entity != entity) continue;
      const std::size_t least = dimension == 1 ? 2 : 1;  // ends of a curve's piece
      if (block.nodes_per_element < least || block.nodes.size() % block.nodes_per_element != 0)
        fail("it has elements with nodes missing");
      for (std::size_t first = 0; first < block.nodes.size(); first += block.nodes_per_element) {
        std::vector<int> nodes;
        for (std::size_t a = 0; a < block.nodes_per_element; ++a) {
          const auto node = node_of_tag_.find(block.nodes[first + a]);
          if (node == node_of_tag_.end())
            fail(fmt::format("an element has the node {}, which is not there", block.nodes[first + a]));
          nodes.push_back(node->second);
        }
        visit(block.kind, std::move(nodes));
      }
    }
  }

  /// Calls visit(name, entity) for all entities of all physical groups of a dimension.
  template <class Visit>
  void for_each_group(int dimension, Visit visit) const {
    for (const GmshContent::Group& group : content_.groups) {
      if (group.dimension != dimension) continue;
      for (const int entity : group.entities) visit(group.name, entity);
    }
  }

  void read_surfaces() {
    std::map<int, std::vector<int>> elements_of_entity;
    const auto add_entity = [&](int entity) {
      if (elements_of_entity.contains(entity)) return;
      std::vector<int>& numbers = elements_of_entity[entity];
      for_each_element(2, entity, [&](int kind, std::vector<int> nodes) {
        numbers.push_back(static_cast<int>(mesh_.elements.size()));
        const ElementType<2>& type = type_of(kind);
        if (nodes.size() != type.node_positions.size()) fail("it has elements with nodes missing");
        mesh_.elements.push_back({&type, std::move(nodes)});
        turn_counter_clockwise(numbers.back());
      });
    };
    for_each_group(2, [&](const std::string& name, int entity) {
      add_entity(entity);
      std::vector<int>& region = mesh_.regions[name];
      region.insert(region.end(), elements_of_entity[entity].begin(), elements_of_entity[entity].end());
    });
    if (mesh_.regions.empty()) {
      for (const GmshContent::Block& block : content_.blocks) {
        if (block.dimension == 2) add_entity(block.entity);
      }
    }
    if (mesh_.elements.empty())
      fail(
          "it has no surface elements: once the script for Gmsh gives a physical name, Gmsh writes named parts only; "
          "add Physical Surface(\"ground\") = {1}; with the number of the surface, and make the mesh again");
    std::vector<int>& all = mesh_.regions["all"];
    all.resize(mesh_.elements.size());
    std::iota(all.begin(), all.end(), 0);
  }

  void turn_counter_clockwise(int number) {
    Element<2>& element = mesh_.elements[static_cast<std::size_t>(number)];
    const Eigen::MatrixX2d x = mesh_.element_positions(number).topRows(element.type->corners);
    double twice_area = 0.0;
    for (Eigen::Index a = 0; a < x.rows(); ++a) {
      const Eigen::Index next = (a + 1) % x.rows();
      twice_area += x(a, 0) * x(next, 1) - x(next, 0) * x(a, 1);
    }
    if (twice_area >= 0.0) return;
    // Corners 0 1 2 3 become 0 3 2 1, so the sides 01 12 23 30 come in the order 30 23 12 01.
    const auto corners_end = element.nodes.begin() + element.type->corners;
    std::reverse(element.nodes.begin() + 1, corners_end);
    std::reverse(corners_end, element.nodes.end());
  }

  void find_sides() {
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      for (int side = 0; side < mesh_.elements[e].type->corners; ++side) {
        const BoundarySide edge{static_cast<int>(e), side};
        const std::vector<int> nodes = mesh_.side_nodes(edge);
        side_of_corners_.try_emplace(std::minmax(nodes[0], nodes[1]), edge);
      }
    }
  }

  void read_curves() {
    for_each_group(1, [&](const std::string& name, int entity) {
      std::vector<BoundarySide>& boundary = mesh_.boundaries[name];
      for_each_element(1, entity, [&](int, const std::vector<int>& nodes) {
        const auto side = side_of_corners_.find(std::minmax(nodes[0], nodes[1]));
        if (side == side_of_corners_.end()) {
          fail(fmt::format("the curve '{}' has a piece that is no side of any element", name));
        }
        boundary.push_back(side->second);
      });
    });
  }

  void read_points() {
    for_each_group(0, [&](const std::string& name, int entity) {
      for_each_element(0, entity, [&](int, const std::vector<int>& nodes) {
        mesh_.node_sets[name].push_back(nodes.front());
      });
    });
  }

  /// Gmsh keeps nodes of construction points; an unknown without an element would make the tangent singular.
  void drop_unused_nodes() {
    std::vector<int> number(mesh_.nodes.size(), -1);
    for (const Element<2>& element : mesh_.elements) {
      for (const int node : element.nodes) number[static_cast<std::size_t>(node)] = 0;
    }
    std::vector<Eigen::Vector2d> kept;
    for (std::size_t node = 0; node < number.size(); ++node) {
      if (number[node] < 0) continue;
      number[node] = static_cast<int>(kept.size());
      kept.push_back(mesh_.nodes[node]);
    }
    mesh_.nodes = std::move(kept);
    for (Element<2>& element : mesh_.elements) {
      for (int& node : element.nodes) node = number[static_cast<std::size_t>(node)];
    }
    for (auto& [name, nodes] : mesh_.node_sets) {
      for (int& node : nodes) {
        node = number[static_cast<std::size_t>(node)];
        if (node < 0) fail(fmt::format("the point '{}' belongs to no element", name));
      }
    }
    std::vector<int>& all = mesh_.node_sets["all"];
    all.resize(mesh_.nodes.size());
    std::iota(all.begin(), all.end(), 0);
  }

  std::filesystem::path file_;
  const ElementType<2>& quadrilateral8_;
  GmshContent content_;
  Mesh<2> mesh_;
  std::map<std::size_t, int> node_of_tag_;
  std::map<std::pair<int, int>, BoundarySide> side_of_corners_;
};

/// Whether Gmsh takes the file for a mesh by its content too: what begins in another way it runs as a script, whatever
/// its name.
bool begins_as_a_mesh(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::getline(in, line);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line == "$MeshFormat" || line == "$Comments" || line == "$NOD";
}

}  // namespace

std::vector<std::filesystem::path> gmsh_module_places() {
  std::vector<std::filesystem::path> places;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) {
    places.push_back(program.parent_path());
    places.push_back(program.parent_path().parent_path() / "lib" / "polargrain");
  }
  return places;
}

Mesh<2> read_gmsh(const std::filesystem::path& file, std::string_view quadrilateral8,
                  const std::vector<std::filesystem::path>& module_places) {
  if (const std::string reason = why_no_input(file); !reason.empty())
    throw InputError(Fault{file.string(), 0, reason});
  // Gmsh takes a text of any other name for one of its scripts, and would run it.
  if (file.extension() != ".msh") throw InputError(Fault{file.string(), 0, "expected a mesh file, NAME.msh"});
  if (!begins_as_a_mesh(file))
    throw InputError(
        Fault{file.string(), 0, "this is no mesh that Gmsh has written: its first line is not $MeshFormat"});
  const GmshReaderFunction read = reader_function(file, module_places);
  GmshContent content;
  try {
    try_in_own_process([&] { read(file.c_str(), &content); });
  } catch (const RunError& error) {
    throw InputError(Fault{file.string(), 0, fmt::format("the mesh is damaged: {}", error.what())});
  }
  read(file.c_str(), &content);
  return mesh_of(file, std::move(content), quadrilateral8);
}

Mesh<2> mesh_of(const std::filesystem::path& file, GmshContent content, std::string_view quadrilateral8) {
  return Reader(file, quadrilateral8, std::move(content)).read();
}

}  // namespace polargrain::fem
